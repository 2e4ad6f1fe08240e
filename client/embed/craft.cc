#include "client/embed/craft.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"

namespace onesea::client {
namespace {

constexpr char kNotYet[] = "the server has not answered yet";
constexpr std::size_t kImpulsesWaitingMax = 16;

}  // namespace

Craft::Craft(Send send, wire::SpawnBody spawn, bool wake)
    : send_(std::move(send)),
      holder_(spawn.body.owner),
      wake_(wake),
      status_(absl::UnavailableError(kNotYet)) {
  Order(Kind::kSpawn, std::move(spawn));
}

Craft::Craft(Send send, std::uint32_t id, std::string holder)
    : send_(std::move(send)),
      holder_(std::move(holder)),
      wake_(false),
      id_(id),
      status_(absl::UnavailableError(kNotYet)) {
  AskForLease();
}

void Craft::Order(Kind kind, wire::WorldCommand command) {
  under_way_[send_(std::move(command), lease_)] = kind;
}

bool Craft::IsUnderWay(Kind kind) const {
  return std::any_of(under_way_.begin(), under_way_.end(),
                     [&](const auto& entry) { return entry.second == kind; });
}

void Craft::Impulse(Vec3d impulse_n_s) {
  if (impulses_n_s_.size() < kImpulsesWaitingMax) impulses_n_s_.push_back(impulse_n_s);
}

void Craft::Advance(std::int64_t now_ns, const WorldView& world) {
  if (!held_ || over_) return;
  const bool is_there = world.FindBody(id_) != nullptr;
  if (seen_ && !is_there) {
    return End(absl::NotFoundError(absl::StrCat("body ", id_, " is no longer there")));
  }
  seen_ = seen_ || is_there;
  if (IsUnderWay(Kind::kLease) || IsUnderWay(Kind::kRemove)) return;
  if (remove_) return Order(Kind::kRemove, wire::RemoveBody{id_});
  for (const Vec3d impulse : std::exchange(impulses_n_s_, {})) {
    Order(Kind::kImpulse, wire::ApplyImpulse{id_, impulse, std::nullopt});
  }
  if (parting_) return Part();
  if (!renewed_ns_) renewed_ns_ = now_ns;
  if (order_) {
    if (!timer_.MustSend(*order_, now_ns)) return;
    Order(Kind::kOrder, wire::DriveBody{id_, {order_->throttle}, {order_->rudder}});
  } else if (now_ns - *renewed_ns_ >= OrderTimer::kReminderNs) {
    AskForLease();
  } else {
    return;
  }
  renewed_ns_ = now_ns;
}

// The lease goes after the order that needs it.
void Craft::Part() {
  const bool runs = order_ && *order_ != HelmOrder{};
  if (runs && !std::exchange(stopped_, true)) {
    return Order(Kind::kOrder, wire::DriveBody{id_, {0.0}, {0.0}});
  }
  if (IsUnderWay(Kind::kOrder) || IsUnderWay(Kind::kImpulse) || IsUnderWay(Kind::kRelease)) return;
  Order(Kind::kRelease, wire::ReleaseLease{id_});
}

// With the running lease shown it is prolonged.
void Craft::AskForLease() {
  if (IsUnderWay(Kind::kLease)) return;
  Order(Kind::kLease, wire::TakeLease{.body_id = id_, .holder = holder_});
}

bool Craft::Take(const CommandSender::Outcome& outcome) {
  const auto found = under_way_.find(outcome.number);
  if (found == under_way_.end()) return false;
  const Kind kind = found->second;
  under_way_.erase(found);
  if (outcome.answer.ok()) {
    Done(kind, outcome.number, *outcome.answer);
  } else {
    Refused(kind, outcome.answer.status());
  }
  return true;
}

void Craft::Done(Kind kind, std::int64_t number, const CommandAnswer& answer) {
  if (over_) {
    // Too late: the body is gone, and its wake goes with it.
    if (kind == Kind::kRegion) Order(Kind::kOther, wire::RemoveRegion{answer.id});
    return;
  }
  switch (kind) {
    case Kind::kSpawn:
      id_ = answer.id;
      if (wake_) {
        wire::RegionSpec region;
        region.follow_body_id = id_;
        region.rest_after_s = wire::kRestAfterS;
        Order(Kind::kRegion, wire::AddRegion{region});
      }
      [[fallthrough]];
    case Kind::kLease:
      if (kind == Kind::kLease && lease_ != answer.lease) timer_.SendAgain();
      lease_ = answer.lease;
      held_ = true;
      status_ = absl::OkStatus();
      return;
    case Kind::kRegion:
      region_ = answer.id;
      return;
    case Kind::kOrder:
      // An older order that acted after a newer one has undone it.
      if (number < done_number_ && answer.tick >= done_tick_) timer_.SendAgain();
      done_number_ = std::max(done_number_, number);
      done_tick_ = std::max(done_tick_, answer.tick);
      status_ = absl::OkStatus();
      return;
    case Kind::kRemove:
      if (region_ != 0) Order(Kind::kOther, wire::RemoveRegion{region_});
      return End(absl::NotFoundError(absl::StrCat("body ", id_, " was removed")));
    case Kind::kRelease:
      return End(absl::CancelledError(absl::StrCat("body ", id_, " was let go")));
    default:
      return;
  }
}

void Craft::Refused(Kind kind, const absl::Status& status) {
  if (over_ || absl::IsCancelled(status)) return;  // of orders: a newer one went instead
  const bool is_gone = absl::IsNotFound(status) && kind != Kind::kRegion;
  if (!held_ || is_gone || kind == Kind::kRelease) return End(status);
  status_ = status;
  if (kind == Kind::kLease && !absl::IsUnavailable(status)) {
    // Somebody else has it: what waits for it is void.
    remove_ = false;
    impulses_n_s_.clear();
    if (parting_) End(status);
  } else if (absl::IsPermissionDenied(status)) {  // the link was lost for longer than it lasts
    lease_.clear();
    AskForLease();
  } else if (kind == Kind::kOrder && absl::IsUnavailable(status)) {
    timer_.SendAgain();
  } else if (kind == Kind::kRemove && !absl::IsUnavailable(status)) {
    remove_ = false;
  }
}

void Craft::End(absl::Status status) {
  over_ = true;
  held_ = false;
  status_ = std::move(status);
}

}  // namespace onesea::client
