#include "client/app/skipper.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::client {
namespace {

constexpr char kBoatPreset[] = "boat", kCratePreset[] = "crate";
constexpr char kOwner[] = "a viewer";
constexpr double kLaunchAheadM = 15.0;  // of the camera
constexpr double kBerthM = 10.0;        // free of others around a new boat
constexpr double kBoatDepthM = 1.2;     // of water that it needs
constexpr double kCrateAsternM = 6.0, kCrateDepthM = 0.3;
constexpr double kExplosionAheadM = 18.0, kExplosionDepthM = 1.5;
constexpr double kExplosionJ = 4.2e6;  // a kilogram of TNT
constexpr std::int64_t kLineNs = 6'000'000'000;
constexpr std::int64_t kAppearsWithinNs = 5'000'000'000;  // a body that was spawned
constexpr std::int64_t kPartingNs = 500'000'000;

Vec2d Along(Vec2d from, double heading_rad, double metres) {
  return from + metres * Vec2d{std::cos(heading_rad), std::sin(heading_rad)};
}

// So that two viewers' boats are told apart.
std::uint32_t AnyColour() {
  constexpr std::uint32_t kColours[] = {0xC23B22, 0x2A5CA8, 0xE8E4DA, 0xE0A020,
                                        0x2F8F5B, 0x7A4FA3, 0x20A0A8, 0xD0608A};
  return kColours[std::random_device()() % std::size(kColours)];
}

bool IsAfloat(Vec2d place, double depth_m, const WorldView& world, const sea::Terrain* terrain) {
  return terrain == nullptr || world.water_level_m() - terrain->ElevationAt(place) > depth_m;
}

// The nearest place abeam of `wanted` that is free of bodies and deep enough; none: none near.
std::optional<Vec2d> FreePlace(Vec2d wanted, double heading_rad, const WorldView& world,
                               const Skipper::Moment& moment) {
  const auto is_free = [&](Vec2d place) {
    return std::none_of(world.bodies().begin(), world.bodies().end(), [&](const auto& body) {
      const Vec3d other = body.At(moment.now).position_m;
      return Norm(place - Vec2d{other.x, other.y}) < kBerthM;
    });
  };
  for (int n = 0; n < 64; ++n) {
    const double side_m = 0.5 * kBerthM * (n % 2 == 0 ? -(n / 2) : n / 2 + 1);
    const Vec2d place = Along(wanted, heading_rad + 0.5 * std::numbers::pi, side_m);
    if (is_free(place) && IsAfloat(place, kBoatDepthM, world, moment.terrain)) return place;
  }
  return std::nullopt;
}

wire::SpawnBody SpawnOf(const char* preset, Vec2d place, double heading_rad) {
  wire::SpawnBody spawn;
  spawn.body.preset = preset;
  spawn.body.owner = kOwner;
  spawn.start.position_m = {place.x, place.y, 0.0};  // afloat
  spawn.start.turn = TurnBy({0, 0, heading_rad});
  return spawn;
}

}  // namespace

Skipper::Skipper(CommandSender* sender) : sender_(sender), colour_rgb_(AnyColour()) {}

Skipper::~Skipper() {
  if (boat_ == nullptr) return;
  Send(Kind::kOther, wire::DriveBody{boat_->id, {0.0}, {0.0}}, true);
  sender_->AwaitAll(kPartingNs);  // the lease goes after the order that needs it
  Send(Kind::kOther, wire::ReleaseLease{boat_->id}, true);
  sender_->AwaitAll(kPartingNs);
}

void Skipper::Say(std::string line) {
  line_ = std::move(line);
  line_until_ns_ = now_ns_ + kLineNs;
}

void Skipper::Send(Kind kind, wire::WorldCommand command, bool with_lease) {
  const std::int64_t number =
      sender_->Send(std::move(command), with_lease ? boat_->lease : std::string());
  under_way_[number] = kind;
}

void Skipper::Update(const SkipperInput& input, const Outlook& outlook, const WorldView& world,
                     const Moment& moment) {
  now_ns_ = moment.now_ns;
  if (sender_ == nullptr) {
    if (input.spawn || input.crate || input.explode || input.remove) {
      Say("a session file has no boats: join a server");
    }
    return;
  }
  TakeOutcomes(moment);
  Follow(world, moment);
  ObeyKeys(input, outlook, world, moment);
  own_.reset();
  if (boat_ == nullptr) return;
  Steer(input.helm, moment);
  if (boat_->predictor.ready()) {
    own_ = boat_->predictor.At(moment.now);
    own_->id = boat_->id;
  }
}

void Skipper::TakeOutcomes(const Moment& moment) {
  for (const CommandSender::Outcome& outcome : sender_->Take()) {
    const auto found = under_way_.find(outcome.number);
    if (found == under_way_.end()) continue;
    const Kind kind = found->second;
    under_way_.erase(found);
    if (outcome.answer.ok()) {
      Done(kind, outcome.number, *outcome.answer, moment);
    } else {
      Refused(kind, outcome.number, outcome.answer.status());
    }
  }
}

void Skipper::Done(Kind kind, std::int64_t number, const CommandAnswer& answer,
                   const Moment& moment) {
  if (kind == Kind::kSpawn) {
    launching_ = false;
    boat_ = std::make_unique<Boat>(
        Boat{.id = answer.id,
             .lease = answer.lease,
             .predictor = BoatPredictor(answer.body ? FiguresOf(*answer.body) : BoatFigures{}),
             .launched_ns = moment.now_ns});
    wire::RegionSpec region;  // so that it leaves a wake
    region.follow_body_id = answer.id;
    region.rest_after_s = wire::kRestAfterS;
    Send(Kind::kRegion, wire::AddRegion{region});
    return Say(absl::StrCat("boat ", answer.id, ": the arrow keys drive it"));
  }
  if (boat_ == nullptr) return;
  if (kind == Kind::kRegion) boat_->region = answer.id;
  if (kind == Kind::kLease) {
    boat_->lease = answer.lease;
    boat_->asks_for_lease = false;
    boat_->timer.SendAgain();
  }
  if (kind == Kind::kRemove) {
    if (boat_->region != 0) Send(Kind::kOther, wire::RemoveRegion{boat_->region});
    Say(absl::StrCat("boat ", boat_->id, " is gone"));
    boat_.reset();
    return;
  }
  if (kind != Kind::kOrder) return;
  // The first tick that shows it is the one after the moment from which it acts.
  boat_->predictor.Confirm(number, TimeOfTick(answer.tick - 1, moment.tick_rate_hz));
  const bool newer = number > boat_->done_number;
  // An older order that acted after a newer one has undone it.
  if (!newer && answer.tick >= boat_->done_tick) boat_->timer.SendAgain();
  if (newer) boat_->done_number = number;
  boat_->done_tick = std::max(boat_->done_tick, answer.tick);
}

void Skipper::Refused(Kind kind, std::int64_t number, const absl::Status& status) {
  if (kind == Kind::kSpawn) launching_ = false;
  if (kind == Kind::kLease && boat_ != nullptr) boat_->asks_for_lease = false;
  if (kind == Kind::kOrder && boat_ != nullptr) {
    boat_->predictor.Withdraw(number);
    if (absl::IsCancelled(status)) return;  // a newer one went instead
    if (absl::IsPermissionDenied(status)) return AskForLease();
    if (absl::IsUnavailable(status)) boat_->timer.SendAgain();
  }
  constexpr const char* kWhat[] = {"no boat",
                                   "no wake",
                                   "the boat doesn't obey",
                                   "the boat doesn't obey",
                                   "no crate",
                                   "no explosion",
                                   "still here",
                                   "refused"};
  Say(absl::StrCat(kWhat[static_cast<std::size_t>(kind)], ": ", status.message()));
}

// The link was lost for longer than the lease lasts.
void Skipper::AskForLease() {
  if (std::exchange(boat_->asks_for_lease, true)) return;
  Send(Kind::kLease, wire::TakeLease{.body_id = boat_->id, .holder = kOwner});
}

void Skipper::Follow(const WorldView& world, const Moment& moment) {
  if (boat_ == nullptr) return;
  const wire::BodyTable::Body* body = world.FindBody(boat_->id);
  if (body != nullptr) {
    boat_->seen = true;
    boat_->predictor.Learn(world.time(), body->At(world.time()));
  } else if (boat_->seen || moment.now_ns - boat_->launched_ns > kAppearsWithinNs) {
    Say(absl::StrCat("boat ", boat_->id, " is no longer there"));
    boat_.reset();
  }
}

void Skipper::ObeyKeys(const SkipperInput& input, const Outlook& outlook, const WorldView& world,
                       const Moment& moment) {
  Vec2d place = outlook.place_m;
  double heading_rad = outlook.heading_rad;
  const bool aboard = boat_ != nullptr && own_.has_value();
  if (aboard) {
    place = {own_->position_m.x, own_->position_m.y};
    heading_rad = HeadingOf(own_->turn);
  }
  if (input.spawn) {
    if (boat_ == nullptr && !launching_) {
      Launch(outlook, world, moment);
    } else {
      Say("you have a boat; Delete takes it out of the water");
    }
  }
  if (input.crate) {
    const double ahead_m = aboard ? -kCrateAsternM : kLaunchAheadM;
    const Vec2d there = Along(place, heading_rad, ahead_m);
    if (IsAfloat(there, kCrateDepthM, world, moment.terrain)) {
      Send(Kind::kCrate, SpawnOf(kCratePreset, there, heading_rad));
    } else {
      Say("no crate: there is no water");
    }
  }
  if (input.explode) {
    const Vec2d there = Along(place, heading_rad, kExplosionAheadM);
    Send(Kind::kExplosion, wire::Explode{{there.x, there.y, -kExplosionDepthM}, kExplosionJ});
  }
  if (input.remove) {
    if (boat_ != nullptr) {
      Send(Kind::kRemove, wire::RemoveBody{boat_->id}, true);
    } else {
      Say("you have no boat; B launches one");
    }
  }
}

void Skipper::Launch(const Outlook& outlook, const WorldView& world, const Moment& moment) {
  const std::optional<Vec2d> place =
      FreePlace(Along(outlook.place_m, outlook.heading_rad, kLaunchAheadM), outlook.heading_rad,
                world, moment);
  if (!place) return Say("no boat: there is no free water ahead");
  wire::SpawnBody spawn = SpawnOf(kBoatPreset, *place, outlook.heading_rad);
  spawn.body.colour_rgb = colour_rgb_;
  Send(Kind::kSpawn, std::move(spawn));
  launching_ = true;
  Say("launching a boat");
}

void Skipper::Steer(const HelmKeys& keys, const Moment& moment) {
  boat_->helm.Advance(keys, moment.seconds);
  const HelmOrder& order = boat_->helm.order();
  if (!boat_->timer.MustSend(order, moment.now_ns)) return;
  const std::int64_t number =
      sender_->Send(wire::DriveBody{boat_->id, {order.throttle}, {order.rudder}}, boat_->lease);
  under_way_[number] = Kind::kOrder;
  boat_->predictor.Give(number, moment.now, order);
}

HelmReport Skipper::report() const {
  HelmReport report;
  if (now_ns_ < line_until_ns_) report.line = line_;
  if (sender_ != nullptr) {
    if (const std::string trouble = sender_->trouble(); !trouble.empty()) report.line = trouble;
  }
  if (boat_ == nullptr) return report;
  report.aboard = true;
  report.boat = boat_->id;
  report.throttle = boat_->helm.order().throttle;
  report.rudder = boat_->helm.order().rudder;
  if (own_) report.speed_m_per_s = PlaneMotionOf(*own_).ahead;
  return report;
}

}  // namespace onesea::client
