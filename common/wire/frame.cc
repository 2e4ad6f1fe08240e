#include "common/wire/frame.h"

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_session.h"
#include "common/wire/proto_update.h"
#include "common/wire/proto_world.h"
#include "onesea/v1/frame.pb.h"

namespace onesea::wire {
namespace {

void SetStamp(const Stamp& stamp, v1::Stamp* out) {
  out->set_tick(stamp.tick);
  out->set_server_monotonic_ns(stamp.server_monotonic_ns);
  out->set_speed(stamp.speed);
  out->set_pace(ToProto(stamp.pace));
  out->set_actual_speed(stamp.actual_speed);
}

absl::StatusOr<Stamp> ReadStamp(const v1::Stamp& proto) {
  ONESEA_RETURN_IF_ERROR(CheckInteger("stamp.", "tick", proto.tick(), -kTickMax, kTickMax));
  ONESEA_RETURN_IF_ERROR(CheckReal("stamp.", "speed", proto.speed(), 0.0, kSpeedMax));
  ONESEA_RETURN_IF_ERROR(
      CheckReal("stamp.", "actual_speed", proto.actual_speed(), 0.0, kActualSpeedMax));
  ONESEA_ASSIGN_OR_RETURN(const Pace pace, FromProto(proto.pace()));
  return Stamp{.tick = proto.tick(),
               .server_monotonic_ns = proto.server_monotonic_ns(),
               .speed = proto.speed(),
               .pace = pace,
               .actual_speed = proto.actual_speed()};
}

absl::StatusOr<ProbeHeights> ReadProbes(const v1::ProbeHeights& proto) {
  ONESEA_RETURN_IF_ERROR(CheckInteger("probes.", "tick", proto.tick(), -kTickMax, kTickMax));
  ONESEA_RETURN_IF_ERROR(CheckSize("probes.", "height_m",
                                   static_cast<std::size_t>(proto.height_m_size()), kProbesMax));
  for (float height_m : proto.height_m()) {
    ONESEA_RETURN_IF_ERROR(
        CheckReal("probes.", "height_m", static_cast<double>(height_m), -kHeightMaxM, kHeightMaxM));
  }
  return ProbeHeights{proto.tick(), {proto.height_m().begin(), proto.height_m().end()}};
}

void SetWelcome(const Welcome& welcome, v1::Welcome* out) {
  ToProto(welcome.recipe, out->mutable_recipe());
  out->set_component_hash(welcome.component_hash);
  ToProto(welcome.session, out->mutable_session());
  for (const WaterLevel& level : welcome.water_level) ToProto(level, out->add_water_level());
}

absl::StatusOr<Welcome> ReadWelcome(const v1::Welcome& proto) {
  Welcome welcome;
  ONESEA_ASSIGN_OR_RETURN(welcome.recipe, FromProto(proto.recipe()));
  welcome.component_hash = proto.component_hash();
  ONESEA_ASSIGN_OR_RETURN(welcome.session, FromProto(proto.session()));
  if (welcome.session.tick_rate_hz != welcome.recipe.tick_rate_hz) {
    return absl::InvalidArgumentError("welcome.session.tick_rate_hz: differs from the recipe's");
  }
  for (const v1::WaterLevel& level : proto.water_level()) {
    welcome.water_level.push_back(FromProto(level));
  }
  ONESEA_RETURN_IF_ERROR(ValidateWaterLevel("welcome.", welcome.water_level));
  return welcome;
}

}  // namespace

std::string EncodeFrame(const Frame& frame) {
  v1::WatchResponse proto;
  proto.set_sequence(frame.sequence);
  proto.set_keyframe(frame.keyframe);
  if (frame.stamp) SetStamp(*frame.stamp, proto.mutable_stamp());
  if (frame.probes) {
    proto.mutable_probes()->set_tick(frame.probes->tick);
    proto.mutable_probes()->mutable_height_m()->Assign(frame.probes->height_m.begin(),
                                                       frame.probes->height_m.end());
  }
  if (frame.welcome) SetWelcome(*frame.welcome, proto.mutable_welcome());
  if (frame.farewell) proto.mutable_farewell()->set_reason(*frame.farewell);
  if (frame.world) ToProto(*frame.world, proto.mutable_world());
  return proto.SerializeAsString();
}

absl::StatusOr<Frame> DecodeFrame(std::string_view bytes) {
  v1::WatchResponse proto;
  if (!proto.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return absl::DataLossError("frame: the bytes are not an onesea.v1.WatchResponse");
  }
  Frame frame;
  frame.sequence = proto.sequence();
  frame.keyframe = proto.keyframe();
  if (proto.has_stamp()) {
    ONESEA_ASSIGN_OR_RETURN(frame.stamp, ReadStamp(proto.stamp()));
  }
  if (proto.has_probes()) {
    ONESEA_ASSIGN_OR_RETURN(frame.probes, ReadProbes(proto.probes()));
  }
  if (proto.has_welcome()) {
    ONESEA_ASSIGN_OR_RETURN(frame.welcome, ReadWelcome(proto.welcome()));
  }
  if (proto.has_farewell()) frame.farewell = Printable(proto.farewell().reason(), kErrorLengthMax);
  if (proto.has_world()) {
    ONESEA_ASSIGN_OR_RETURN(frame.world, FromProto(proto.world()));
  }
  return frame;
}

}  // namespace onesea::wire
