#include "server/rpc/watch_server.h"

#include <algorithm>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"

namespace onesea::server {

WatchServer::WatchServer(Hub& hub, WatchMethods& methods, grpc::ServerBuilder& builder,
                         WatchOptions options, const Clock& clock)
    : hub_(hub), methods_(methods) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const int shards = options.shards > 0 ? options.shards : std::max(1, cores - 1);
  for (int n = 0; n < shards; ++n) {
    shards_.push_back(std::make_unique<WatchShard>(hub, clock, builder.AddCompletionQueue()));
  }
  hub.SetWake([this] {
    for (const std::unique_ptr<WatchShard>& shard : shards_) shard->Wake();
  });
}

WatchServer::~WatchServer() {
  hub_.SetWake(nullptr);
  Stop();
}

void WatchServer::Start() {
  for (std::size_t n = 0; n < shards_.size(); ++n) {
    shards_[n]->Start(absl::StrCat("watch-", n), [this](bool bidi) { AcceptNext(bidi); });
  }
  AcceptNext(true);
  AcceptNext(false);
}

void WatchServer::AwaitFarewells(double grace_s) const {
  for (int ms = 0; ms < grace_s * 1e3 && stats().viewers > 0; ++ms) {
    absl::SleepFor(absl::Milliseconds(1));
  }
}

void WatchServer::Stop() {
  {
    absl::MutexLock lock(&accept_mutex_);
    stopping_ = true;
  }
  for (const std::unique_ptr<WatchShard>& shard : shards_) shard->Stop();
}

WatchShard& WatchServer::LeastLoaded() {
  return **std::min_element(shards_.begin(), shards_.end(),
                            [](const auto& a, const auto& b) { return a->load() < b->load(); });
}

void WatchServer::AcceptNext(bool bidi) {
  absl::MutexLock lock(&accept_mutex_);
  if (stopping_) return;  // the queue may be down
  WatchShard& shard = LeastLoaded();
  WatchCall* call = bidi ? static_cast<WatchCall*>(new BidiWatchCall(shard, methods_))
                         : new StampsWatchCall(shard, methods_);
  shard.CountRequested();
  call->Request();  // it deletes itself when it is over
}

WatchStats WatchServer::stats() const {
  WatchStats sum;
  for (const std::unique_ptr<WatchShard>& shard : shards_) {
    const WatchStats one = shard->stats();
    sum.frames += one.frames;
    sum.keyframes += one.keyframes;
    sum.viewers += one.viewers;
  }
  return sum;
}

}  // namespace onesea::server
