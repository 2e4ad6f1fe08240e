#include "tests/e2e/raw_watch.h"

#include <grpc/support/time.h>
#include <gtest/gtest.h>

#include <vector>

#include "onesea/v1/frame.pb.h"

namespace onesea::e2e {
namespace {

void* const kRead = reinterpret_cast<void*>(1);
void* const kOther = reinterpret_cast<void*>(2);

}  // namespace

RawWatch::RawWatch(std::shared_ptr<grpc::Channel> channel, const char* method)
    : channel_(std::move(channel)) {
  grpc::GenericStub stub(channel_);
  stream_ = stub.PrepareCall(&context_, std::string("/onesea.v1.OneSea/") + method, &queue_);
  stream_->StartCall(kOther);
  Await(kOther);
}

RawWatch::~RawWatch() {
  context_.TryCancel();
  Status();
  queue_.Shutdown();
  void* tag = nullptr;
  for (bool ok = false; queue_.Next(&tag, &ok);) {
  }
}

bool RawWatch::Await(void* wanted) {
  for (;;) {
    void* tag = nullptr;
    bool ok = false;
    if (!queue_.Next(&tag, &ok)) return false;
    if (tag == kRead) {
      read_done_ = true;
      read_ok_ = ok;
    }
    if (tag == wanted) return ok;
  }
}

void RawWatch::Send(const std::string& bytes) {
  const grpc::Slice slice(bytes);
  stream_->Write(grpc::ByteBuffer(&slice, 1), kOther);
  Await(kOther);
}

void RawWatch::SendOpen(const std::string& session, int credit, bool every_frame) {
  v1::WatchRequest request;
  request.mutable_open()->set_session(session);
  request.mutable_open()->set_credit(credit);
  request.mutable_open()->set_every_frame(every_frame);
  Send(request.SerializeAsString());
}

void RawWatch::SendAck(std::int64_t sequence, float drift_m) {
  v1::WatchRequest request;
  request.mutable_ack()->set_sequence(sequence);
  request.mutable_ack()->set_drift_m(drift_m);
  Send(request.SerializeAsString());
}

void RawWatch::CloseOurSide() {
  stream_->WritesDone(kOther);
  Await(kOther);
}

std::optional<wire::Frame> RawWatch::Read() { return ReadWithin(20'000); }

std::optional<wire::Frame> RawWatch::ReadWithin(int timeout_ms) {
  if (over_) return std::nullopt;
  if (!reading_) {
    stream_->Read(&received_, kRead);
    reading_ = true;
    read_done_ = false;
  }
  if (!read_done_) {
    void* tag = nullptr;
    if (queue_.AsyncNext(&tag, &read_ok_, gpr_time_from_millis(timeout_ms, GPR_TIMESPAN)) !=
        grpc::CompletionQueue::GOT_EVENT)
      return std::nullopt;
  }
  reading_ = false;
  over_ = !read_ok_;
  if (over_) return std::nullopt;
  std::vector<grpc::Slice> slices;
  EXPECT_TRUE(received_.Dump(&slices).ok());
  std::string bytes;
  for (const grpc::Slice& slice : slices) {
    bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  }
  absl::StatusOr<wire::Frame> frame = wire::DecodeFrame(bytes);
  EXPECT_TRUE(frame.ok()) << frame.status();
  return frame.ok() ? std::optional(*frame) : std::nullopt;
}

grpc::Status RawWatch::Status() {
  if (stream_ == nullptr) return grpc::Status::CANCELLED;
  while (!over_ && Read().has_value()) {
  }
  grpc::Status status;
  stream_->Finish(&status, kOther);
  Await(kOther);
  stream_ = nullptr;
  return status;
}

}  // namespace onesea::e2e
