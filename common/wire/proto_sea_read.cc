#include <optional>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/default_wind.h"
#include "common/wire/direction.h"
#include "common/wire/proto_sea.h"
#include "common/wire/sea_shorthand.h"

// Reading half of proto_sea.h. What the domain's own validation sees (ranges of numbers) is left to
// it; here stand only what would be lost on the way: enums, array sizes before they are copied,
// directions, shorthands.
namespace onesea::wire {
namespace {

absl::StatusOr<sea::Spreading> ReadSpreading(const v1::Spreading& proto, std::string_view prefix) {
  sea::Spreading spreading;
  if (proto.kind() != v1::Spreading::KIND_UNSPECIFIED) {
    if (!v1::Spreading::Kind_IsValid(proto.kind())) {
      return absl::InvalidArgumentError(
          absl::StrCat(Text(prefix), "spreading.kind: ", static_cast<int>(proto.kind()),
                       " is none of KIND_COSINE_2S (1) to "
                       "KIND_DONELAN_BANNER (4)"));
    }
    spreading.kind = static_cast<sea::SpreadingKind>(proto.kind());
  }
  if (proto.has_exponent_s()) spreading.exponent_s = proto.exponent_s();
  spreading.swell = proto.swell();
  return spreading;
}

absl::StatusOr<std::vector<float>> ReadFloats(const google::protobuf::RepeatedField<float>& proto,
                                              std::string_view prefix, std::string_view field,
                                              std::size_t size_max) {
  ONESEA_RETURN_IF_ERROR(
      CheckSize(prefix, field, static_cast<std::size_t>(proto.size()), size_max));
  return std::vector<float>(proto.begin(), proto.end());
}

absl::StatusOr<sea::PhillipsSystem> Read(const v1::PhillipsSystem& proto, std::string_view prefix) {
  sea::PhillipsSystem s;
  s.wind_speed_m_per_s = proto.wind_speed_m_per_s();
  ONESEA_ASSIGN_OR_RETURN(s.wind_to_rad, DirectionFromProto(proto.wind(), prefix, "wind"));
  if (proto.has_alpha()) s.alpha = proto.alpha();
  s.small_wave_cutoff_m = proto.small_wave_cutoff_m();
  if (proto.has_directional_exponent()) s.directional_exponent = proto.directional_exponent();
  if (proto.has_one_sided()) s.one_sided = proto.one_sided();
  return s;
}

absl::StatusOr<sea::PiersonMoskowitzSystem> Read(const v1::PiersonMoskowitzSystem& proto,
                                                 std::string_view prefix) {
  sea::PiersonMoskowitzSystem s;
  s.wind_speed_19_5_m_per_s = proto.wind_speed_19_5_m_per_s();
  ONESEA_ASSIGN_OR_RETURN(s.wave_to_rad,
                          DirectionFromProto(proto.direction(), prefix, "direction"));
  ONESEA_ASSIGN_OR_RETURN(s.spreading, ReadSpreading(proto.spreading(), prefix));
  return s;
}

// What both JONSWAP systems have.
template <typename Proto, typename System>
absl::Status ReadPeaked(const Proto& proto, std::string_view prefix, System& s) {
  if (proto.has_gamma()) s.gamma = proto.gamma();
  ONESEA_ASSIGN_OR_RETURN(s.wave_to_rad,
                          DirectionFromProto(proto.direction(), prefix, "direction"));
  ONESEA_ASSIGN_OR_RETURN(s.spreading, ReadSpreading(proto.spreading(), prefix));
  s.use_depth = proto.use_depth();
  return absl::OkStatus();
}

absl::StatusOr<sea::JonswapSystem> Read(const v1::JonswapSystem& proto, std::string_view prefix) {
  sea::JonswapSystem s;
  s.hs_m = proto.hs_m();
  s.tp_s = proto.tp_s();
  ONESEA_RETURN_IF_ERROR(ReadPeaked(proto, prefix, s));
  return s;
}

absl::StatusOr<sea::FetchJonswapSystem> Read(const v1::FetchJonswapSystem& proto,
                                             std::string_view prefix) {
  sea::FetchJonswapSystem s;
  s.wind_speed_m_per_s = proto.wind_speed_m_per_s();
  s.fetch_m = proto.fetch_m();
  ONESEA_RETURN_IF_ERROR(ReadPeaked(proto, prefix, s));
  return s;
}

absl::StatusOr<sea::ElfouhailySystem> Read(const v1::ElfouhailySystem& proto,
                                           std::string_view prefix) {
  sea::ElfouhailySystem s;
  s.wind_speed_m_per_s = proto.wind_speed_m_per_s();
  if (proto.has_inverse_wave_age()) s.inverse_wave_age = proto.inverse_wave_age();
  ONESEA_ASSIGN_OR_RETURN(s.wave_to_rad,
                          DirectionFromProto(proto.direction(), prefix, "direction"));
  return s;
}

absl::StatusOr<sea::BuoySpectrum> Read(const v1::BuoySpectrum& proto, std::string_view prefix) {
  constexpr std::size_t kMax = kSpectrumFrequenciesMax;
  sea::BuoySpectrum s;
  ONESEA_ASSIGN_OR_RETURN(s.frequency_hz,
                          ReadFloats(proto.frequency_hz(), prefix, "frequency_hz", kMax));
  ONESEA_ASSIGN_OR_RETURN(s.density_m2_per_hz,
                          ReadFloats(proto.density_m2_per_hz(), prefix, "density_m2_per_hz", kMax));
  ONESEA_ASSIGN_OR_RETURN(s.mean_wave_to_rad,
                          ReadFloats(proto.mean_wave_to_rad(), prefix, "mean_wave_to_rad", kMax));
  ONESEA_ASSIGN_OR_RETURN(s.principal_wave_to_rad, ReadFloats(proto.principal_wave_to_rad(), prefix,
                                                              "principal_wave_to_rad", kMax));
  ONESEA_ASSIGN_OR_RETURN(s.r1, ReadFloats(proto.r1(), prefix, "r1", kMax));
  ONESEA_ASSIGN_OR_RETURN(s.r2, ReadFloats(proto.r2(), prefix, "r2", kMax));
  ONESEA_ASSIGN_OR_RETURN(s.fallback_wave_to_rad, DirectionFromProto(proto.fallback_direction(),
                                                                     prefix, "fallback_direction"));
  ONESEA_ASSIGN_OR_RETURN(s.fallback_spreading, ReadSpreading(proto.fallback_spreading(), prefix));
  s.hs_m = proto.hs_m();
  if (proto.has_add_tail()) s.add_tail = proto.add_tail();
  return s;
}

absl::StatusOr<sea::GridSpectrum> Read(const v1::GridSpectrum& proto, std::string_view prefix) {
  constexpr std::size_t kFrequencies = kSpectrumFrequenciesMax;
  constexpr std::size_t kDirections = kSpectrumDirectionsMax;
  sea::GridSpectrum s;
  ONESEA_ASSIGN_OR_RETURN(s.frequency_hz,
                          ReadFloats(proto.frequency_hz(), prefix, "frequency_hz", kFrequencies));
  ONESEA_ASSIGN_OR_RETURN(s.wave_to_rad,
                          ReadFloats(proto.wave_to_rad(), prefix, "wave_to_rad", kDirections));
  ONESEA_ASSIGN_OR_RETURN(s.density_m2_per_hz_rad,
                          ReadFloats(proto.density_m2_per_hz_rad(), prefix, "density_m2_per_hz_rad",
                                     kFrequencies * kDirections));
  s.hs_m = proto.hs_m();
  if (proto.has_add_tail()) s.add_tail = proto.add_tail();
  return s;
}

// The system goes into place and not through StatusOr<WaveSystem>: gcc 12 sees ghosts in such a
// variant's destructor.
template <typename System>
absl::Status Put(absl::StatusOr<System> system, sea::WaveSystem& out) {
  ONESEA_RETURN_IF_ERROR(system.status());
  out.emplace<System>(*std::move(system));
  return absl::OkStatus();
}

absl::Status ReadSystem(const v1::WaveSystem& proto, const std::string& prefix,
                        const std::string& folder, sea::WaveSystem& out) {
  switch (proto.kind_case()) {
    case v1::WaveSystem::kPhillips:
      return Put(Read(proto.phillips(), prefix + "phillips."), out);
    case v1::WaveSystem::kPiersonMoskowitz:
      return Put(Read(proto.pierson_moskowitz(), prefix + "pierson_moskowitz."), out);
    case v1::WaveSystem::kJonswap:
      return Put(Read(proto.jonswap(), prefix + "jonswap."), out);
    case v1::WaveSystem::kFetchJonswap:
      return Put(Read(proto.fetch_jonswap(), prefix + "fetch_jonswap."), out);
    case v1::WaveSystem::kElfouhaily:
      return Put(Read(proto.elfouhaily(), prefix + "elfouhaily."), out);
    case v1::WaveSystem::kBuoy:
      return Put(Read(proto.buoy(), prefix + "buoy."), out);
    case v1::WaveSystem::kGrid:
      return Put(Read(proto.grid(), prefix + "grid."), out);
    case v1::WaveSystem::kFile:
      return SystemFromFile(proto.file(), prefix + "file.", folder, out);
    case v1::WaveSystem::KIND_NOT_SET:
      break;
  }
  return absl::InvalidArgumentError(prefix + "kind: none is given");
}

absl::Status ReadRegularWaves(const v1::SeaState& proto, std::string_view prefix,
                              sea::SeaState& sea) {
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "regular_waves",
                                   static_cast<std::size_t>(proto.regular_waves_size()),
                                   kRegularWavesMax));
  for (const v1::RegularWave& wave : proto.regular_waves()) {
    const std::string name =
        absl::StrCat("regular_waves[", sea.regular_waves.size(), "].direction");
    ONESEA_ASSIGN_OR_RETURN(const double to_rad,
                            DirectionFromProto(wave.direction(), prefix, name));
    sea.regular_waves.push_back({wave.amplitude_m(), wave.period_s(), to_rad, wave.phase_rad()});
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<sea::SeaState> FromProto(const v1::SeaState& proto, std::string_view prefix,
                                        const std::string& folder) {
  sea::SeaState sea;
  sea.name = proto.name();
  ONESEA_RETURN_IF_ERROR(CheckText(prefix, "name", sea.name, kSeaNameLengthMax));
  ONESEA_RETURN_IF_ERROR(CheckSize(
      prefix, "systems", static_cast<std::size_t>(proto.systems_size()), kWaveSystemsMax));
  sea.systems.resize(static_cast<std::size_t>(proto.systems_size()));
  for (int n = 0; n < proto.systems_size(); ++n) {
    ONESEA_RETURN_IF_ERROR(ReadSystem(proto.systems(n),
                                      absl::StrCat(Text(prefix), "systems[", n, "]."), folder,
                                      sea.systems[static_cast<std::size_t>(n)]));
  }
  ONESEA_RETURN_IF_ERROR(ReadRegularWaves(proto, prefix, sea));
  ONESEA_ASSIGN_OR_RETURN(std::optional<sea::SeaState> shorthand, SeaFromShorthand(proto, prefix));
  if (shorthand) sea.systems = std::move(shorthand->systems);
  // Before the wind is guessed from the systems: the guess relies on their shapes.
  ONESEA_RETURN_IF_ERROR(sea::ValidateSeaState(sea, prefix));
  const Wind wind =
      shorthand ? Wind{shorthand->wind_speed_m_per_s, shorthand->wind_to_rad} : DefaultWind(sea);
  sea.wind_speed_m_per_s =
      proto.has_wind_speed_m_per_s() ? proto.wind_speed_m_per_s() : wind.speed_m_per_s;
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "wind_speed_m_per_s", sea.wind_speed_m_per_s, 0.0, kWindSpeedMaxMPerS));
  ONESEA_ASSIGN_OR_RETURN(sea.wind_to_rad,
                          DirectionFromProto(proto.wind(), prefix, "wind", wind.to_rad));
  return sea;
}

}  // namespace onesea::wire
