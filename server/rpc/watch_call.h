#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/async_stream.h>
#include <grpcpp/support/byte_buffer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "server/rpc/watch_messages.h"
#include "server/rpc/watch_methods.h"
#include "server/stream/hub.h"
#include "server/stream/subscriber.h"

namespace onesea::server {

class WatchCall;
class WatchShard;
struct WatchGroup;

enum class WatchOp : std::uint8_t { kAccepted, kRead, kWritten, kFinished, kGone };
inline constexpr int kWatchOps = 5;

/// What a completion queue hands back.
struct WatchTag {
  WatchCall* call = nullptr;
  WatchOp op = WatchOp::kAccepted;
};

/// A viewer this far off at a probe [m] draws another sea; the drift of a sound one is micrometres.
inline constexpr float kDriftWarnM = 0.01f;

/// A viewer that says nothing is not kept.
inline constexpr std::int64_t kOpenTimeoutNs = 5'000'000'000;

/// One viewer's call. Lives on one shard's thread from its acceptance on, and ends itself.
///
///   state      meaning                                  left by
///   Requested  gRPC may give it a call                  kAccepted -> Opening, or Over
///   Opening    waits for the first message              a good one -> Watching, else -> Finishing
///   Watching   Subscriber decides what is written       farewell, error, stall, gone -> Finishing
///   Finishing  the status is on its way                 kFinished -> Over
///   Over       deleted when no operation is pending
class WatchCall {
 public:
  WatchCall(WatchShard& shard, WatchMethods& methods);
  virtual ~WatchCall() = default;
  WatchCall(const WatchCall&) = delete;
  WatchCall& operator=(const WatchCall&) = delete;

  /// Asks gRPC for one call of this method. Any thread; everything else only on the shard's.
  virtual void Request() = 0;

  /// Watch or WatchStamps?
  virtual bool bidi() const = 0;

  void OnOp(WatchOp op, bool ok, std::int64_t now_ns);
  /// Writes what there is to write.
  void Drive(std::int64_t now_ns);
  /// Ends those who never opened and those who take nothing.
  void CheckPatience(std::int64_t now_ns);

  /// Every operation is back and the call is over: delete it.
  bool Deletable() const { return state_ == State::kOver && pending_ == 0; }

  // Kept by the shard: where this call stands in its lists.
  std::size_t index_in_shard = 0;
  std::size_t index_in_group = 0;
  WatchGroup* group = nullptr;
  int load = 0;

 protected:
  enum class State : std::uint8_t { kRequested, kOpening, kWatching, kFinishing, kOver };

  // Counts an operation as pending; the tag to give to gRPC.
  void* Begin(WatchOp op);
  void Watch(absl::StatusOr<OpenMessage> open, std::int64_t now_ns);

  virtual void OnAccepted(std::int64_t now_ns) = 0;
  virtual void OnRead(std::int64_t) {}
  // Something was sent, or `idle`: nothing was for a while.
  virtual void ReadIfDue(bool /*idle*/) {}
  virtual void StartWrite(const grpc::ByteBuffer& bytes) = 0;
  virtual void StartFinish(const grpc::Status& status) = 0;
  // The farewell and the end in one.
  virtual void StartLastWrite(const grpc::ByteBuffer& bytes) = 0;

  // Ends the call with `status` as soon as no write is in flight.
  void Finish(const absl::Status& status, std::int64_t now_ns);

  WatchShard& shard_;
  WatchMethods& methods_;
  grpc::ServerContext context_;
  State state_ = State::kRequested;
  std::optional<Subscriber> subscriber_;
  OpenMessage viewer_;

 private:
  void OnWritten(bool ok, std::int64_t now_ns);

  std::array<WatchTag, kWatchOps> tags_;
  int pending_ = 0;
  bool writing_ = false;
  std::int64_t sent_ns_ = 0;  // when the last write began
  std::int64_t state_since_ns_ = 0;
  std::optional<grpc::Status> owed_status_;  // Finishing, but a write is still in flight
  Seat seat_;
};

/// Watch: the viewer acknowledges.
///
/// A message that finds nobody reading waits in gRPC until somebody does; one that is waited for
/// wakes the shard's thread. So while frames flow an acknowledgement is read only when one must
/// have come since: one wake-up less for each, 21 -> 18.5 µs of CPU a frame.
class BidiWatchCall final : public WatchCall {
 public:
  using WatchCall::WatchCall;
  void Request() override;
  bool bidi() const override { return true; }

 private:
  void OnAccepted(std::int64_t now_ns) override;
  void OnRead(std::int64_t now_ns) override;
  void ReadIfDue(bool idle) override;
  void StartWrite(const grpc::ByteBuffer& bytes) override;
  void StartFinish(const grpc::Status& status) override;
  void StartLastWrite(const grpc::ByteBuffer& bytes) override;
  void Read();
  void OnAck(const AckMessage& ack, std::int64_t now_ns);

  grpc::ServerAsyncReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer> stream_{&context_};
  grpc::ByteBuffer received_;
  bool reading_ = false;
  bool warned_of_drift_ = false;
};

/// WatchStamps: a plain server stream.
class StampsWatchCall final : public WatchCall {
 public:
  using WatchCall::WatchCall;
  void Request() override;
  bool bidi() const override { return false; }

 private:
  void OnAccepted(std::int64_t now_ns) override;
  void StartWrite(const grpc::ByteBuffer& bytes) override;
  void StartFinish(const grpc::Status& status) override;
  void StartLastWrite(const grpc::ByteBuffer& bytes) override;

  grpc::ByteBuffer request_;
  grpc::ServerAsyncWriter<grpc::ByteBuffer> stream_{&context_};
};

}  // namespace onesea::server
