#include "server/rpc/watch_server.h"

#include <algorithm>
#include <thread>

#include "absl/strings/str_cat.h"

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

void WatchServer::Stop() {
  for (const std::unique_ptr<WatchShard>& shard : shards_) shard->Stop();
}

WatchShard& WatchServer::LeastLoaded() {
  return **std::min_element(shards_.begin(), shards_.end(),
                            [](const auto& a, const auto& b) { return a->load() < b->load(); });
}

void WatchServer::AcceptNext(bool bidi) {
  WatchShard& shard = LeastLoaded();
  WatchCall* call = bidi ? static_cast<WatchCall*>(new BidiWatchCall(shard, methods_))
                         : new StampsWatchCall(shard, methods_);
  call->Request();  // it deletes itself when it is over
}

WatchStats WatchServer::stats() const {
  WatchStats sum;
  for (const std::unique_ptr<WatchShard>& shard : shards_) {
    const WatchStats one = shard->stats();
    sum.frames += one.frames;
    sum.keyframes += one.keyframes;
    sum.calls += one.calls;
  }
  return sum;
}

}  // namespace onesea::server
