#include "server/rpc/query_desk.h"

#include "common/base/check.h"

namespace onesea::server {

absl::StatusOr<wire::QueryAnswer> QueryDesk::Answer(const wire::QueryRequest& request) {
  ONESEA_ASSIGN_OR_RETURN(const std::shared_ptr<SessionLoop> session,
                          registry_.Find(request.session));
  return Answer(session, request);
}

absl::StatusOr<wire::QueryAnswer> QueryDesk::Answer(const std::shared_ptr<SessionLoop>& session,
                                                    const wire::QueryRequest& request) {
  const SessionView view = session->View();
  return EngineOf(session)->Answer(view.components, view.tick, request);
}

bool QueryDesk::IsHeavy(const wire::QueryRequest& request) {
  return request.depth_m.size() > 64 || request.points_m.size() > 20'000;
}

void QueryDesk::Prune() {
  absl::MutexLock lock(&mutex_);
  std::erase_if(engines_, [](const auto& entry) { return entry.first.expired(); });
}

std::shared_ptr<QueryEngine> QueryDesk::EngineOf(const std::shared_ptr<SessionLoop>& session) {
  absl::MutexLock lock(&mutex_);
  const auto found = engines_.find(session);
  if (found != engines_.end()) return found->second;
  std::erase_if(engines_, [](const auto& entry) { return entry.first.expired(); });
  auto engine = std::make_shared<QueryEngine>(transform_);
  engines_.emplace(session, engine);
  return engine;
}

}  // namespace onesea::server
