#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/completion_queue.h>
#include <grpcpp/generic/generic_stub.h>

#include <memory>
#include <optional>
#include <string>

#include "common/wire/frame.h"

namespace onesea::e2e {

/// A viewer that does only what it is told: any bytes, no acknowledgement of its own. Blocking, one
/// thread.
class RawWatch {
 public:
  explicit RawWatch(std::shared_ptr<grpc::Channel> channel, const char* method = "Watch");
  ~RawWatch();

  void Send(const std::string& bytes);
  void SendOpen(const std::string& session, int credit, bool every_frame);
  void SendAck(std::int64_t sequence, float drift_m = -1.0f);
  void CloseOurSide();

  /// The next frame; nothing if the stream is over.
  std::optional<wire::Frame> Read();
  /// Like Read(), but nothing also when `timeout_ms` passes; the read stays under way for the next
  /// call.
  std::optional<wire::Frame> ReadWithin(int timeout_ms);
  /// Reads to the end and answers the status.
  grpc::Status Status();

 private:
  bool Await(void* tag);

  std::shared_ptr<grpc::Channel> channel_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
  grpc::ByteBuffer received_;
  bool reading_ = false, read_done_ = false, read_ok_ = false, over_ = false;
};

}  // namespace onesea::e2e
