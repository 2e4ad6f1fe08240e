#include "server/session/registry.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/attenuation.h"
#include "common/wire/bounds.h"

namespace onesea::server {

Registry::Registry(const Clock& clock, sea::TransformKind transform)
    : clock_(clock), transform_(transform) {}

Registry::~Registry() { CloseAll("the server stops"); }

absl::Status Registry::Reserve(const std::string& name) {
  absl::MutexLock lock(&mutex_);
  if (sessions_.contains(name)) {
    return absl::AlreadyExistsError(absl::StrCat("name: a session '", name, "' exists already"));
  }
  if (sessions_.size() >= kSessionsMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the server has its ", kSessionsMax, " sessions; delete one first"));
  }
  sessions_.emplace(name, nullptr);
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<SessionLoop>> Registry::Create(SessionSpec spec) {
  ONESEA_RETURN_IF_ERROR(ValidateSessionSpec(spec));
  ONESEA_RETURN_IF_ERROR(Reserve(spec.name));
  const std::string name = spec.name;
  auto components = sea::BuildComponents(spec.recipe);
  auto world = MakeWorld(spec, transform_);
  if (!components.ok() || !world.ok()) {
    absl::MutexLock lock(&mutex_);
    sessions_.erase(name);
    return components.ok() ? world.status() : components.status();
  }
  if (spec.epoch_utc_ns == 0) spec.epoch_utc_ns = clock_.UtcNs();
  auto over_terrain = sea::OverTerrain(*std::move(components), (*world)->terrain());
  auto session = std::make_shared<SessionLoop>(std::move(spec), std::move(over_terrain), clock_,
                                               transform_, *std::move(world));
  absl::MutexLock lock(&mutex_);
  sessions_[name] = session;
  return session;
}

absl::Status Registry::Delete(std::string_view name, std::string_view reason) {
  ONESEA_ASSIGN_OR_RETURN(std::shared_ptr<SessionLoop> session, Find(name));
  {
    absl::MutexLock lock(&mutex_);
    const auto found = sessions_.find(name);
    // Somebody else may have deleted it, and even created another, since Find.
    if (found != sessions_.end() && found->second == session) sessions_.erase(found);
  }
  session->Close(reason);
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<SessionLoop>> Registry::Find(std::string_view name) const {
  absl::MutexLock lock(&mutex_);
  const auto found = sessions_.find(name);
  if (found != sessions_.end() && found->second != nullptr) return found->second;
  const auto append_name = [](std::string* out, const auto& entry) { out->append(entry.first); };
  return absl::NotFoundError(
      absl::StrCat("session: '", wire::Printable(name, kSessionNameLengthMax),
                   "' is not here; there are: ", absl::StrJoin(sessions_, ", ", append_name)));
}

std::vector<std::shared_ptr<SessionLoop>> Registry::List() const {
  absl::MutexLock lock(&mutex_);
  std::vector<std::shared_ptr<SessionLoop>> sessions;
  for (const auto& [name, session] : sessions_) {
    if (session != nullptr) sessions.push_back(session);
  }
  return sessions;
}

void Registry::CloseAll(std::string_view reason) {
  for (const std::shared_ptr<SessionLoop>& session : List()) {
    Delete(session->name(), reason).IgnoreError();
  }
}

}  // namespace onesea::server
