#include "client/net/connection.h"

#include <grpc/support/time.h>
#include <grpcpp/channel.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::client {
namespace {

constexpr char kWatchMethod[] = "/onesea.v1.OneSea/Watch";
constexpr std::int64_t kSyncTimeoutMs = 5'000;
constexpr std::int64_t kNsPerMs = 1'000'000;

gpr_timespec InMilliseconds(std::int64_t milliseconds) {
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC),
                      gpr_time_from_millis(milliseconds, GPR_TIMESPAN));
}

std::string Flatten(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  std::string bytes;
  if (!buffer.Dump(&slices).ok()) return bytes;
  bytes.reserve(buffer.Length());
  for (const grpc::Slice& slice : slices) {
    bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  }
  return bytes;
}

}  // namespace

SessionClient::Connection::Connection(std::shared_ptr<grpc::Channel> channel, std::string address,
                                      const SessionClientOptions& options,
                                      const std::atomic<float>& drift_m, const Clock& clock,
                                      Events events)
    : address_(std::move(address)),
      options_(options),
      drift_m_(drift_m),
      clock_(clock),
      events_(std::move(events)),
      generic_stub_(channel),
      stub_(v1::OneSea::NewStub(channel)) {}

void SessionClient::Connection::Cancel() { watch_context_.TryCancel(); }

absl::Status SessionClient::Connection::Run() {
  stream_ = generic_stub_.PrepareCall(&watch_context_, kWatchMethod, &queue_);
  stream_->StartCall(reinterpret_cast<void*>(kStart));
  while (!finished_) {
    StartSync();
    const std::int64_t wait_ns =
        sync_context_ || ending_ ? kSyncPeriodNs : next_sync_ns_ - clock_.MonotonicNs();
    void* tag = nullptr;
    bool ok = false;
    const auto event =
        queue_.AsyncNext(&tag, &ok, InMilliseconds(std::max<std::int64_t>(1, wait_ns / kNsPerMs)));
    if (event == grpc::CompletionQueue::GOT_EVENT) {
      Handle(static_cast<Tag>(reinterpret_cast<std::intptr_t>(tag)), ok);
    }
  }
  if (sync_context_) sync_context_->TryCancel();
  queue_.Shutdown();
  void* tag = nullptr;
  bool ok = false;
  while (queue_.Next(&tag, &ok)) {
  }
  if (!protocol_error_.ok()) return protocol_error_;
  if (watch_status_.ok()) return absl::UnavailableError("the server ended the stream");
  return ToAbsl(watch_status_, address_);
}

void SessionClient::Connection::Handle(Tag tag, bool ok) {
  switch (tag) {
    case kStart:
      return OnStarted(ok);
    case kRead:
      return OnRead(ok);
    case kWrite:
      return OnWritten(ok);
    case kSync:
      return OnSynced(ok);
    case kFinish:
      finished_ = true;
      return;
  }
}

void SessionClient::Connection::OnStarted(bool ok) {
  if (!ok) return End();
  v1::WatchRequest request;
  request.mutable_open()->set_session(options_.session);
  request.mutable_open()->set_credit(options_.credit);
  request.mutable_open()->set_every_frame(options_.every_frame);
  request.mutable_open()->set_client_name(options_.client_name);
  Send(request);
  stream_->Read(&incoming_, reinterpret_cast<void*>(kRead));
}

void SessionClient::Connection::OnRead(bool ok) {
  if (!ok) return End();
  const std::string bytes = Flatten(incoming_);
  absl::StatusOr<wire::Frame> frame = wire::DecodeFrame(bytes);
  if (!frame.ok()) {
    // Not something that trying again mends: this server speaks another language.
    protocol_error_ = absl::FailedPreconditionError(
        absl::StrCat("the server's frame can't be read: ", frame.status().message()));
    watch_context_.TryCancel();
    return End();
  }
  sequence_ = frame->sequence;
  ++unacknowledged_;
  events_.on_frame(*std::move(frame), bytes.size());
  Acknowledge();
  stream_->Read(&incoming_, reinterpret_cast<void*>(kRead));
}

void SessionClient::Connection::OnWritten(bool ok) {
  writing_ = false;
  if (ok) Acknowledge();
}

void SessionClient::Connection::Send(const v1::WatchRequest& request) {
  const std::string bytes = request.SerializeAsString();
  const grpc::Slice slice(bytes);
  writing_ = true;
  stream_->Write(grpc::ByteBuffer(&slice, 1), reinterpret_cast<void*>(kWrite));
}

// The welcome is acknowledged at once, so that the credit is whole again after the slow part of
// joining; then every kFramesPerAck-th frame, or less when less credit was asked for.
void SessionClient::Connection::Acknowledge() {
  const int due = acknowledged_ == 0 ? 1 : std::min(kFramesPerAck, options_.credit);
  if (writing_ || ending_ || unacknowledged_ < due) return;
  v1::WatchRequest request;
  request.mutable_ack()->set_sequence(sequence_);
  request.mutable_ack()->set_drift_m(drift_m_);
  unacknowledged_ = 0;
  acknowledged_ = std::max<std::int64_t>(sequence_, 1);
  Send(request);
}

void SessionClient::Connection::StartSync() {
  const std::int64_t now_ns = clock_.MonotonicNs();
  if (sync_context_ || ending_ || now_ns < next_sync_ns_) return;
  const bool in_a_hurry = sync_.exchange_count() < kExchangesToTrust;
  next_sync_ns_ = now_ns + (in_a_hurry ? kSyncPeriodNs / 100 : kSyncPeriodNs);
  sync_context_ = std::make_unique<grpc::ClientContext>();
  sync_context_->set_deadline(InMilliseconds(kSyncTimeoutMs));
  sync_sent_ns_ = now_ns;
  sync_call_ = stub_->AsyncSyncClock(sync_context_.get(), v1::SyncClockRequest(), &queue_);
  sync_call_->Finish(&sync_response_, &sync_status_, reinterpret_cast<void*>(kSync));
}

void SessionClient::Connection::OnSynced(bool) {
  const std::int64_t received_ns = clock_.MonotonicNs();
  sync_context_.reset();
  if (!sync_status_.ok()) return;
  sync_.Add(sync_sent_ns_, sync_response_.server_monotonic_ns(), received_ns);
  events_.on_exchange(sync_);
  // The first ones follow each other at once.
  if (sync_.exchange_count() < kExchangesToTrust) next_sync_ns_ = 0;
}

void SessionClient::Connection::End() {
  if (ending_) return;
  ending_ = true;
  stream_->Finish(&watch_status_, reinterpret_cast<void*>(kFinish));
}

}  // namespace onesea::client
