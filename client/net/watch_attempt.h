#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/completion_queue.h>
#include <grpcpp/generic/generic_stub.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "absl/status/status.h"
#include "client/net/clock_sync.h"
#include "client/net/session_client.h"
#include "onesea/v1/onesea.grpc.pb.h"

// The private half of session_client.h.

namespace onesea::client {

/// One connection of a SessionClient, from the first byte to its end, on the caller's thread with
/// one completion queue. The clock exchanges run beside the stream over the same connection.
class WatchAttempt {
 public:
  explicit WatchAttempt(SessionClient& client);

  /// Runs until the link ends; the reason, never OK.
  absl::Status Run();
  /// Any thread: ends Run() soon.
  void Cancel() { context_.TryCancel(); }
  bool was_live() const { return live_; }
  bool said_farewell() const { return !farewell_.empty(); }

 private:
  enum class Op : std::uint8_t { kStarted, kRead, kWritten, kFinished, kExchanged };
  // The queue hands back a pointer: to an element that says what it stands for.
  static constexpr Op kOps[] = {Op::kStarted, Op::kRead, Op::kWritten, Op::kFinished,
                                Op::kExchanged};
  static void* Tag(Op op) { return const_cast<Op*>(&kOps[static_cast<std::size_t>(op)]); }

  void OnEvent(Op op, bool ok);
  void OnRead(bool ok);
  absl::Status Accept(const wire::Frame& frame);
  void Acknowledge();
  void StartExchange();
  void OnExchanged(std::int64_t now_ns);
  // Hands the clock and the newest stamp over to the client, once this connection's clock is good
  // enough.
  void UseClock(std::int64_t now_ns);
  void Send(const v1::WatchRequest& request);
  void Give(const absl::Status& status);
  void OnTime(std::int64_t now_ns);
  absl::Status Outcome() const;

  SessionClient& client_;
  const Clock& clock_;
  std::shared_ptr<grpc::Channel> channel_;
  grpc::CompletionQueue queue_;
  int pending_ = 0;

  // The stream is read as bytes: wire::DecodeFrame is the one place that understands them.
  grpc::ClientContext context_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
  grpc::ByteBuffer received_;
  grpc::Status stream_status_;
  absl::Status given_;  // why we ended it ourselves
  std::string farewell_;
  bool live_ = false, writing_ = false, finishing_ = false, ack_owed_ = false;
  std::int64_t last_sequence_ = -1;
  int unacknowledged_ = 0;
  std::int64_t last_news_ns_ = 0;

  int tick_rate_hz_ = 60;
  std::optional<wire::Stamp> stamp_;  // newest
  std::unique_ptr<v1::OneSea::Stub> stub_;
  ClockSync sync_;
  bool clock_in_use_ = false;
  std::unique_ptr<grpc::ClientContext> exchange_context_;
  std::unique_ptr<grpc::ClientAsyncResponseReader<v1::SyncClockResponse>> exchange_;
  v1::SyncClockResponse exchange_response_;
  grpc::Status exchange_status_;
  std::int64_t exchange_sent_ns_ = 0;
  std::int64_t next_exchange_ns_ = INT64_MAX;
};

}  // namespace onesea::client
