#include "server/rpc/query_desk.h"

#include "common/base/check.h"

namespace onesea::server {
namespace {

// A synthesis right away would keep a core from those who bring the answer home; the next tick
// leaves time enough.
constexpr std::int64_t kAnswerFirstNs = 1'000'000;

}  // namespace

absl::StatusOr<wire::QueryAnswer> QueryDesk::Answer(const wire::QueryRequest& request) {
  ONESEA_ASSIGN_OR_RETURN(const std::shared_ptr<SessionLoop> session,
                          registry_.Find(request.session));
  return Answer(session, request);
}

absl::StatusOr<wire::QueryAnswer> QueryDesk::Answer(const std::shared_ptr<SessionLoop>& session,
                                                    const wire::QueryRequest& request) {
  const SessionView view = session->View();
  const std::shared_ptr<QueryEngine> engine = EngineOf(session);
  absl::StatusOr<wire::QueryAnswer> answer =
      engine->Answer(view.components, view.tick, request,
                     {.interaction = view.world->interaction.get(),
                      .past = view.world->past.get(),
                      .water_level = session->water_level()});
  const bool asked_for_now = !request.tick && !request.time_s;
  if (answer.ok() && asked_for_now) PrepareNext(session, engine, view.tick, request.detail);
  return answer;
}

void QueryDesk::PrepareNext(const std::shared_ptr<SessionLoop>& session,
                            const std::shared_ptr<QueryEngine>& engine, Tick now,
                            sea::QueryDetail detail) {
  const std::optional<Tick> next = engine->NoteAsked(now);
  if (!next) return;
  const std::int64_t begin_ns = clock_.MonotonicNs() + kAnswerFirstNs;
  ahead_
      .Post([this, session, engine, next = *next, detail, begin_ns] {
        clock_.SleepUntil(begin_ns);
        const SessionView view = session->View();
        if (view.tick < next) engine->SnapshotOf(view.components, next, detail);
      })
      .IgnoreError();  // too busy: the asker makes it
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
