#include "common/wire/body_codec.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/byte_reader.h"

namespace onesea::wire {
namespace {

constexpr double kPerM = 1000.0, kPerMPerS = 1000.0, kPerRadPerS = 1000.0;
constexpr int kTurnBytes = 6;
constexpr int kTurnBits = 15;
constexpr std::int64_t kTurnZero = 1 << (kTurnBits - 1);
// The three smaller components of a unit quaternion are at most 1/√2.
constexpr double kTurnScale = (kTurnZero - 1) * 1.4142135623730951;
constexpr std::int64_t kAnchorMaxM = static_cast<std::int64_t>(kQueryCoordinateMaxM);

struct WholeVec {
  std::int64_t x = 0, y = 0, z = 0;
};

WholeVec Whole(Vec3d v, double per_unit) {
  return {std::llround(v.x * per_unit), std::llround(v.y * per_unit), std::llround(v.z * per_unit)};
}

Vec3d Scaled(WholeVec v, double per_unit) {
  return {static_cast<double>(v.x) / per_unit, static_cast<double>(v.y) / per_unit,
          static_cast<double>(v.z) / per_unit};
}

Vec3d Limited(Vec3d v, double max) {
  return {std::clamp(v.x, -max, max), std::clamp(v.y, -max, max), std::clamp(v.z, -max, max)};
}

WholeVec WholeSpeed(const BodyState& state) {
  return Whole(Limited(state.velocity_m_per_s, kBodySpeedMaxMPerS), kPerMPerS);
}
WholeVec WholeSpin(const BodyState& state) {
  return Whole(Limited(state.spin_rad_per_s, kBodySpinMaxRadPerS), kPerRadPerS);
}

// Which component is left out, and the three others as fractions of what they can be.
std::uint64_t PackTurn(const Quaternion& turn) {
  const Quaternion unit = Normalised(turn);
  const std::array<double, 4> parts = {unit.w, unit.x, unit.y, unit.z};
  std::size_t largest = 0;
  for (std::size_t n = 1; n < 4; ++n) {
    if (std::fabs(parts[n]) > std::fabs(parts[largest])) largest = n;
  }
  const double sign = parts[largest] < 0.0 ? -1.0 : 1.0;
  std::uint64_t packed = largest;
  int shift = 2;
  for (std::size_t n = 0; n < 4; ++n) {
    if (n == largest) continue;
    const std::int64_t steps = std::llround(sign * parts[n] * kTurnScale);
    packed |= static_cast<std::uint64_t>(steps + kTurnZero) << shift;
    shift += kTurnBits;
  }
  return packed;
}

// Any word gives a unit quaternion.
Quaternion UnpackTurn(std::uint64_t packed) {
  const std::size_t largest = packed & 3;
  std::array<double, 4> parts{};
  double rest = 1.0;
  int shift = 2;
  for (std::size_t n = 0; n < 4; ++n) {
    if (n == largest) continue;
    const auto steps = static_cast<std::int64_t>(packed >> shift & ((1 << kTurnBits) - 1));
    parts[n] = static_cast<double>(steps - kTurnZero) / kTurnScale;
    rest -= parts[n] * parts[n];
    shift += kTurnBits;
  }
  parts[largest] = std::sqrt(std::max(rest, 0.0));
  return Normalised({parts[0], parts[1], parts[2], parts[3]});
}

void AppendWhole(WholeVec v, std::string& out) {
  AppendSigned(v.x, out);
  AppendSigned(v.y, out);
  AppendSigned(v.z, out);
}

WholeVec ReadWhole(ByteReader& reader) {
  const std::int64_t x = reader.Signed(), y = reader.Signed(), z = reader.Signed();
  return {x, y, z};
}

absl::Status CheckWhole(std::string_view field, WholeVec v, std::int64_t max) {
  for (const std::int64_t part : {v.x, v.y, v.z}) {
    ONESEA_RETURN_IF_ERROR(CheckInteger("bodies: ", field, part, -max, max));
  }
  return absl::OkStatus();
}

absl::StatusOr<SentBody> ReadBody(ByteReader& reader, WholeVec anchor_m) {
  const std::uint64_t id = reader.Varint();
  SentBody body;
  body.state.flags = reader.Byte();
  const std::uint64_t age_ticks = reader.Varint();
  const WholeVec offset = ReadWhole(reader);
  body.state.turn = UnpackTurn(reader.Word(kTurnBytes));
  const WholeVec speed = ReadWhole(reader), spin = ReadWhole(reader);
  if (!reader.ok()) return absl::InvalidArgumentError("bodies: the bytes end within a body");
  if (id == 0 || id > UINT32_MAX) return absl::InvalidArgumentError("bodies: no such id");
  if (age_ticks > kBodyAgeTicksMax) {
    return absl::InvalidArgumentError(
        absl::StrCat("bodies: age_ticks: ", age_ticks, " is above ", kBodyAgeTicksMax));
  }
  const auto mm = static_cast<std::int64_t>(kPerM);
  ONESEA_RETURN_IF_ERROR(CheckWhole("offset_mm", offset, 2 * kAnchorMaxM * mm));
  ONESEA_RETURN_IF_ERROR(CheckWhole("velocity_mm_per_s", speed,
                                    static_cast<std::int64_t>(kBodySpeedMaxMPerS * kPerMPerS)));
  ONESEA_RETURN_IF_ERROR(CheckWhole("spin_mrad_per_s", spin,
                                    static_cast<std::int64_t>(kBodySpinMaxRadPerS * kPerRadPerS)));
  body.state.id = static_cast<std::uint32_t>(id);
  body.age_ticks = static_cast<Tick>(age_ticks);
  const WholeVec place{anchor_m.x * mm + offset.x, anchor_m.y * mm + offset.y,
                       anchor_m.z * mm + offset.z};
  ONESEA_RETURN_IF_ERROR(CheckWhole("position_mm", place, kAnchorMaxM * mm));
  body.state.position_m = Scaled(place, kPerM);
  body.state.velocity_m_per_s = Scaled(speed, kPerMPerS);
  body.state.spin_rad_per_s = Scaled(spin, kPerRadPerS);
  return body;
}

}  // namespace

BodyState Quantised(const BodyState& state) {
  BodyState quantised = state;
  quantised.position_m = Scaled(Whole(state.position_m, kPerM), kPerM);
  quantised.turn = UnpackTurn(PackTurn(state.turn));
  quantised.velocity_m_per_s = Scaled(WholeSpeed(state), kPerMPerS);
  quantised.spin_rad_per_s = Scaled(WholeSpin(state), kPerRadPerS);
  return quantised;
}

void AppendBodies(std::span<const SentBody> bodies, std::string& out) {
  if (bodies.empty()) return;
  const WholeVec anchor_m = Whole(bodies.front().state.position_m, 1.0);
  AppendWhole(anchor_m, out);
  for (const SentBody& body : bodies) {
    const WholeVec place = Whole(body.state.position_m, kPerM);
    const auto mm = static_cast<std::int64_t>(kPerM);
    AppendVarint(body.state.id, out);
    out.push_back(static_cast<char>(body.state.flags));
    AppendVarint(static_cast<std::uint64_t>(body.age_ticks), out);
    AppendWhole({place.x - anchor_m.x * mm, place.y - anchor_m.y * mm, place.z - anchor_m.z * mm},
                out);
    const std::uint64_t turn = PackTurn(body.state.turn);
    for (int n = 0; n < kTurnBytes; ++n) out.push_back(static_cast<char>(turn >> (8 * n)));
    AppendWhole(WholeSpeed(body.state), out);
    AppendWhole(WholeSpin(body.state), out);
  }
}

absl::StatusOr<std::vector<SentBody>> ReadBodies(std::string_view bytes) {
  std::vector<SentBody> bodies;
  if (bytes.empty()) return bodies;
  ByteReader reader(bytes);
  const WholeVec anchor_m = ReadWhole(reader);
  if (!reader.ok()) return absl::InvalidArgumentError("bodies: the bytes end within the anchor");
  ONESEA_RETURN_IF_ERROR(CheckWhole("anchor_m", anchor_m, kAnchorMaxM));
  while (!reader.rest().empty()) {
    ONESEA_RETURN_IF_ERROR(CheckSize("", "bodies", bodies.size() + 1, kBodiesMax));
    ONESEA_ASSIGN_OR_RETURN(SentBody body, ReadBody(reader, anchor_m));
    // Ascending, so that nobody has to search for doubles.
    if (!bodies.empty() && body.state.id <= bodies.back().state.id) {
      return absl::InvalidArgumentError(
          absl::StrCat("bodies: id ", body.state.id, " after ", bodies.back().state.id));
    }
    bodies.push_back(body);
  }
  return bodies;
}

BodyState Interpolate(const BodyState& a, const BodyState& b, double seconds, double share) {
  const double s = share, r = 1.0 - share;
  BodyState between = b;
  // Hermite's cubic and its slope.
  between.position_m =
      (r * r * (1.0 + 2.0 * s)) * a.position_m + (s * s * (3.0 - 2.0 * s)) * b.position_m +
      (s * r * r * seconds) * a.velocity_m_per_s - (s * s * r * seconds) * b.velocity_m_per_s;
  between.velocity_m_per_s = r * a.velocity_m_per_s + s * b.velocity_m_per_s;
  between.spin_rad_per_s = r * a.spin_rad_per_s + s * b.spin_rad_per_s;
  const double sign = Dot(a.turn, b.turn) < 0.0 ? -1.0 : 1.0;
  between.turn =
      Normalised({r * a.turn.w + sign * s * b.turn.w, r * a.turn.x + sign * s * b.turn.x,
                  r * a.turn.y + sign * s * b.turn.y, r * a.turn.z + sign * s * b.turn.z});
  return between;
}

}  // namespace onesea::wire
