#include "client/net/terrain_fetcher.h"

#include <grpc/support/time.h>
#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <utility>

#include "absl/time/time.h"
#include "client/net/grpc_status.h"
#include "common/base/check.h"
#include "common/wire/terrain_pieces.h"
#include "onesea/v1/onesea.grpc.pb.h"

namespace onesea::client {
namespace {

// The largest terrain over a line of 2 Mbit/s.
constexpr std::int64_t kTimeoutNs = 300'000'000'000;

bool WorthAnotherTry(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kDeadlineExceeded:
    case absl::StatusCode::kCancelled:
    case absl::StatusCode::kResourceExhausted:
    case absl::StatusCode::kUnknown:
    case absl::StatusCode::kInternal:
      return true;
    default:
      return false;
  }
}

}  // namespace

struct TerrainFetcher::Call {
  grpc::ClientContext context;
};

TerrainFetcher::TerrainFetcher(ChannelFactory connect, std::string session, Events events,
                               BackoffOptions backoff, const Clock& clock)
    : connect_(std::move(connect)),
      session_(std::move(session)),
      events_(std::move(events)),
      backoff_(backoff),
      clock_(clock) {}

TerrainFetcher::~TerrainFetcher() { Stop(); }

void TerrainFetcher::Stop() {
  std::thread thread;
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
    wanted_ = 0;
    if (call_ != nullptr) call_->context.TryCancel();
    thread = std::move(thread_);
  }
  if (thread.joinable()) thread.join();
}

void TerrainFetcher::Want(std::uint64_t hash) {
  absl::MutexLock lock(&mutex_);
  if (stopping_ || hash == wanted_) return;
  wanted_ = hash;
  if (call_ != nullptr) call_->context.TryCancel();  // that was another one
  if (hash != 0 && !thread_.joinable()) thread_ = std::thread([this] { Run(); });
}

bool TerrainFetcher::IsWanted(std::uint64_t hash) const {
  absl::MutexLock lock(&mutex_);
  return wanted_ == hash;
}

void TerrainFetcher::Run() {
  while (true) {
    std::uint64_t hash = 0;
    {
      absl::MutexLock lock(&mutex_);
      const auto has_work = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
        return stopping_ || wanted_ != 0;
      };
      mutex_.Await(absl::Condition(&has_work));
      if (stopping_) return;
      hash = wanted_;
    }
    FetchUntilDone(hash);
  }
}

void TerrainFetcher::FetchUntilDone(std::uint64_t hash) {
  Backoff backoff(backoff_, static_cast<std::uint64_t>(clock_.MonotonicNs()) ^ hash);
  while (true) {
    absl::StatusOr<sea::Terrain> terrain = Fetch(hash);
    if (!IsWanted(hash)) return;
    if (terrain.ok()) {
      events_.on_terrain(std::make_shared<const sea::Terrain>(*std::move(terrain)));
    } else if (!WorthAnotherTry(terrain.status())) {
      events_.on_failed(terrain.status());
    } else {
      absl::MutexLock lock(&mutex_);
      const auto other = [this, hash]()
                             ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return wanted_ != hash; };
      mutex_.AwaitWithTimeout(absl::Condition(&other), absl::Nanoseconds(backoff.NextNs()));
      continue;
    }
    absl::MutexLock lock(&mutex_);
    if (wanted_ == hash) wanted_ = 0;
    return;
  }
}

absl::StatusOr<sea::Terrain> TerrainFetcher::Fetch(std::uint64_t hash) {
  Call call;
  call.context.set_deadline(gpr_time_from_nanos(kTimeoutNs, GPR_TIMESPAN));
  {
    absl::MutexLock lock(&mutex_);
    if (wanted_ != hash) return absl::CancelledError("the terrain is no longer wanted");
    call_ = &call;
  }
  v1::GetTerrainRequest request;
  request.set_session(session_);
  const auto stub = v1::OneSea::NewStub(connect_());
  const auto reader = stub->GetTerrain(&call.context, request);
  wire::TerrainPieces pieces(hash);
  absl::Status refused;
  v1::GetTerrainResponse piece;
  while (refused.ok() && reader->Read(&piece)) {
    refused = pieces.Add(
        {.total_bytes = piece.total_bytes(), .hash = piece.hash(), .bytes = piece.piece()});
  }
  if (!refused.ok()) call.context.TryCancel();
  const absl::Status ended = FromGrpc(reader->Finish());
  {
    absl::MutexLock lock(&mutex_);
    call_ = nullptr;
  }
  ONESEA_RETURN_IF_ERROR(refused);
  ONESEA_RETURN_IF_ERROR(ended);
  return pieces.Finish();
}

}  // namespace onesea::client
