#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/completion_queue.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "client/net/clock_sync.h"
#include "client/net/session_client.h"
#include "onesea/v1/onesea.grpc.pb.h"

namespace onesea::client {

/// One Watch stream and the clock exchanges beside it, on one completion queue and one thread.
/// Internal to SessionClient.
class SessionClient::Connection {
 public:
  struct Events {
    std::function<void(wire::Frame frame, std::size_t bytes)> on_frame;
    std::function<void(const ClockSync&)> on_exchange;
  };

  Connection(std::shared_ptr<grpc::Channel> channel, std::string address,
             const SessionClientOptions& options, const std::atomic<float>& drift_m,
             const Clock& clock, Events events);

  /// Follows the stream to its end and says why it ended; an end that the server meant well
  /// (OK, e.g. it shuts down) is Unavailable.
  absl::Status Run();

  /// Makes Run() return soon. Thread-safe.
  void Cancel();

 private:
  enum Tag : std::intptr_t { kStart = 1, kRead, kWrite, kFinish, kSync };

  void Handle(Tag tag, bool ok);
  void OnStarted(bool ok);
  void OnRead(bool ok);
  void OnWritten(bool ok);
  void OnSynced(bool ok);
  void Send(const v1::WatchRequest& request);
  void Acknowledge();
  void StartSync();
  void End();

  const std::string address_;
  const SessionClientOptions& options_;
  const std::atomic<float>& drift_m_;
  const Clock& clock_;
  const Events events_;

  grpc::CompletionQueue queue_;
  grpc::GenericStub generic_stub_;
  std::unique_ptr<v1::OneSea::Stub> stub_;

  grpc::ClientContext watch_context_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
  grpc::ByteBuffer incoming_;
  grpc::Status watch_status_;
  absl::Status protocol_error_;
  bool writing_ = false;
  bool ending_ = false;
  bool finished_ = false;
  std::int64_t sequence_ = 0;
  std::int64_t acknowledged_ = 0;
  int unacknowledged_ = 0;

  // One exchange of clocks at a time.
  std::unique_ptr<grpc::ClientContext> sync_context_;
  std::unique_ptr<grpc::ClientAsyncResponseReader<v1::SyncClockResponse>> sync_call_;
  v1::SyncClockResponse sync_response_;
  grpc::Status sync_status_;
  std::int64_t sync_sent_ns_ = 0;
  std::int64_t next_sync_ns_ = 0;
  ClockSync sync_;
};

}  // namespace onesea::client
