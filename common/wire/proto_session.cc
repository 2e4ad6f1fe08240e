#include "common/wire/proto_session.h"

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_world.h"

namespace onesea::wire {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
// 1678 to 2262: what fits into 64 bits of nanoseconds.
constexpr std::int64_t kEpochSecondsMax = 9'223'372'035;

void SetTimestamp(std::int64_t utc_ns, google::protobuf::Timestamp* out) {
  std::int64_t seconds = utc_ns / kNsPerSecond;
  std::int64_t nanos = utc_ns % kNsPerSecond;
  if (nanos < 0) {
    nanos += kNsPerSecond;
    --seconds;
  }
  out->set_seconds(seconds);
  out->set_nanos(static_cast<std::int32_t>(nanos));
}

absl::StatusOr<std::int64_t> TimestampNs(const google::protobuf::Timestamp& time) {
  ONESEA_RETURN_IF_ERROR(
      CheckInteger("epoch_time.", "seconds", time.seconds(), -kEpochSecondsMax, kEpochSecondsMax));
  ONESEA_RETURN_IF_ERROR(CheckInteger("epoch_time.", "nanos", time.nanos(), 0, kNsPerSecond - 1));
  return time.seconds() * kNsPerSecond + time.nanos();
}

template <typename Repeated>
absl::StatusOr<std::vector<Vec2d>> ReadProbes(const Repeated& proto) {
  ONESEA_RETURN_IF_ERROR(
      CheckSize("", "probes", static_cast<std::size_t>(proto.size()), kProbesMax));
  std::vector<Vec2d> probes_m;
  for (const v1::Probe& probe : proto) probes_m.push_back({probe.x_m(), probe.y_m()});
  return probes_m;
}

template <typename Proto>
void SetProbes(const std::vector<Vec2d>& probes_m, Proto* out) {
  for (Vec2d probe : probes_m) {
    auto* p = out->add_probes();
    p->set_x_m(probe.x);
    p->set_y_m(probe.y);
  }
}

// The recipe that a session begins with.
absl::StatusOr<sea::Recipe> ReadRecipe(const v1::SessionSpec& proto, const std::string& folder) {
  sea::Recipe recipe;
  if (proto.has_seed()) recipe.seed = proto.seed();
  if (proto.tick_rate_hz() != 0) recipe.tick_rate_hz = proto.tick_rate_hz();
  if (proto.has_choppiness()) recipe.choppiness = proto.choppiness();
  ONESEA_RETURN_IF_ERROR(ReadWaters(proto, recipe));
  if (recipe.cascades.empty()) recipe.cascades = sea::DefaultCascades();
  if (!proto.has_sea()) return absl::InvalidArgumentError("sea: is missing");
  ONESEA_ASSIGN_OR_RETURN(sea::SeaState sea, FromProto(proto.sea(), "sea.", folder));
  recipe.timeline.push_back({0, 0, std::move(sea)});
  return recipe;
}

}  // namespace

v1::Pace ToProto(Pace pace) { return static_cast<v1::Pace>(pace); }

absl::StatusOr<Pace> FromProto(v1::Pace pace) {
  if (pace == v1::PACE_UNSPECIFIED) return Pace::kRealTime;
  if (v1::Pace_IsValid(pace)) return static_cast<Pace>(pace);
  return absl::InvalidArgumentError(
      absl::StrCat("pace: ", static_cast<int>(pace),
                   " is none of PACE_REAL_TIME (1), PACE_HELD (2), PACE_LOCK_STEP (3)"));
}

void ToProto(const SessionSpec& spec, v1::SessionSpec* out) {
  out->set_name(spec.name);
  const sea::Recipe& recipe = spec.recipe;
  if (!recipe.timeline.empty()) ToProto(recipe.timeline.front().sea, out->mutable_sea());
  WriteWaters(recipe, out);
  out->set_stream_rate_hz(spec.stream_rate_hz);
  if (spec.epoch_utc_ns != 0) SetTimestamp(spec.epoch_utc_ns, out->mutable_epoch_time());
  if (spec.latitude_deg) out->set_latitude_deg(*spec.latitude_deg);
  if (spec.longitude_deg) out->set_longitude_deg(*spec.longitude_deg);
  out->set_pace(ToProto(spec.pace));
  out->set_speed(spec.speed);
  SetProbes(spec.probes_m, out);
  out->set_lock_step_participants(spec.lock_step_participants);
  out->set_lock_step_deadline_s(spec.lock_step_deadline_s);
  if (!spec.world.empty()) ToProto(spec.world, out->mutable_world());
}

absl::StatusOr<SessionSpec> FromProto(const v1::SessionSpec& proto, const std::string& folder) {
  SessionSpec spec;
  spec.name = proto.name();
  ONESEA_ASSIGN_OR_RETURN(spec.recipe, ReadRecipe(proto, folder));
  if (proto.stream_rate_hz() != 0) spec.stream_rate_hz = proto.stream_rate_hz();
  if (proto.has_epoch_time()) {
    ONESEA_ASSIGN_OR_RETURN(spec.epoch_utc_ns, TimestampNs(proto.epoch_time()));
  }
  if (proto.has_latitude_deg()) spec.latitude_deg = proto.latitude_deg();
  if (proto.has_longitude_deg()) spec.longitude_deg = proto.longitude_deg();
  ONESEA_ASSIGN_OR_RETURN(spec.pace, FromProto(proto.pace()));
  if (proto.has_speed()) spec.speed = proto.speed();
  ONESEA_ASSIGN_OR_RETURN(spec.probes_m, ReadProbes(proto.probes()));
  if (spec.probes_m.empty()) spec.probes_m = DefaultProbes();
  if (proto.lock_step_participants() != 0) {
    spec.lock_step_participants = proto.lock_step_participants();
  }
  // Not `!= 0`: NaN must go on to the validation, which refuses it.
  if (!(proto.lock_step_deadline_s() == 0.0)) {
    spec.lock_step_deadline_s = proto.lock_step_deadline_s();
  }
  ONESEA_ASSIGN_OR_RETURN(spec.world, FromProto(proto.world(), folder));
  ONESEA_RETURN_IF_ERROR(ValidateSessionSpec(spec));
  return spec;
}

void ToProto(const SessionInfo& info, v1::SessionInfo* out) {
  out->set_name(info.name);
  out->set_pace(ToProto(info.pace));
  out->set_speed(info.speed);
  out->set_actual_speed(info.actual_speed);
  out->set_tick(info.tick);
  out->set_tick_rate_hz(info.tick_rate_hz);
  out->set_stream_rate_hz(info.stream_rate_hz);
  SetTimestamp(info.epoch_utc_ns, out->mutable_epoch_time());
  if (info.latitude_deg) out->set_latitude_deg(*info.latitude_deg);
  if (info.longitude_deg) out->set_longitude_deg(*info.longitude_deg);
  out->set_viewer_count(info.viewer_count);
  out->set_hs_m(info.hs_m);
  out->set_component_hash(info.component_hash);
  out->set_sea_name(info.sea_name);
  SetProbes(info.probes_m, out);
  out->set_transform(info.transform);
  out->set_terrain_hash(info.terrain_hash);
}

absl::StatusOr<SessionInfo> FromProto(const v1::SessionInfo& proto) {
  SessionInfo info;
  info.name = Printable(proto.name(), kSessionNameLengthMax);
  ONESEA_ASSIGN_OR_RETURN(info.pace, FromProto(proto.pace()));
  info.speed = proto.speed();
  info.actual_speed = proto.actual_speed();
  ONESEA_RETURN_IF_ERROR(CheckReal("session.", "speed", info.speed, 0.0, kSpeedMax));
  ONESEA_RETURN_IF_ERROR(
      CheckReal("session.", "actual_speed", info.actual_speed, 0.0, kActualSpeedMax));
  info.tick_rate_hz = proto.tick_rate_hz();
  if (!IsTickRateExact(info.tick_rate_hz) || info.tick_rate_hz > kTickRateMaxHz) {
    return absl::InvalidArgumentError(absl::StrCat("session.tick_rate_hz: ", info.tick_rate_hz,
                                                   " does not divide ", kFlicksPerSecond,
                                                   " or exceeds ", kTickRateMaxHz));
  }
  info.tick = proto.tick();
  if (!IsTickInRange(info.tick, info.tick_rate_hz)) {
    return absl::InvalidArgumentError(absl::StrCat("session.tick: ", info.tick,
                                                   " is more than a century from tick 0 at ",
                                                   info.tick_rate_hz, " Hz"));
  }
  info.stream_rate_hz = proto.stream_rate_hz();
  ONESEA_RETURN_IF_ERROR(
      CheckInteger("session.", "stream_rate_hz", info.stream_rate_hz, 1, info.tick_rate_hz));
  ONESEA_ASSIGN_OR_RETURN(info.epoch_utc_ns, TimestampNs(proto.epoch_time()));
  if (proto.has_latitude_deg()) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal("session.", "latitude_deg", proto.latitude_deg(), -90.0, 90.0));
    info.latitude_deg = proto.latitude_deg();
  }
  if (proto.has_longitude_deg()) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal("session.", "longitude_deg", proto.longitude_deg(), -180.0, 360.0));
    info.longitude_deg = proto.longitude_deg();
  }
  info.viewer_count = proto.viewer_count();
  info.hs_m = proto.hs_m();
  ONESEA_RETURN_IF_ERROR(CheckReal("session.", "hs_m", info.hs_m, 0.0, kHeightMaxM));
  info.component_hash = proto.component_hash();
  info.sea_name = Printable(proto.sea_name(), kSeaNameLengthMax);
  ONESEA_ASSIGN_OR_RETURN(info.probes_m, ReadProbes(proto.probes()));
  for (Vec2d probe : info.probes_m) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal("session.", "probes.x_m", probe.x, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
    ONESEA_RETURN_IF_ERROR(
        CheckReal("session.", "probes.y_m", probe.y, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  }
  info.transform = Printable(proto.transform(), kSessionNameLengthMax);
  info.terrain_hash = proto.terrain_hash();
  return info;
}

}  // namespace onesea::wire
