#include "common/wire/proto_sea.h"

#include <optional>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/default_wind.h"
#include "common/wire/direction.h"

namespace onesea::wire {
namespace {

void SetDirection(double to_rad, v1::Direction* out) { out->set_to_rad(to_rad); }

void SetSpreading(const sea::Spreading& spreading, v1::Spreading* out) {
  out->set_kind(static_cast<v1::Spreading::Kind>(spreading.kind));
  out->set_exponent_s(spreading.exponent_s);
  out->set_swell(spreading.swell);
}

void AssignFloats(const std::vector<float>& from, google::protobuf::RepeatedField<float>* to) {
  to->Assign(from.begin(), from.end());
}

struct SystemToProto {
  v1::WaveSystem* out;

  void operator()(const sea::PhillipsSystem& s) const {
    auto* p = out->mutable_phillips();
    p->set_wind_speed_m_per_s(s.wind_speed_m_per_s);
    SetDirection(s.wind_to_rad, p->mutable_wind());
    p->set_alpha(s.alpha);
    p->set_small_wave_cutoff_m(s.small_wave_cutoff_m);
    p->set_directional_exponent(s.directional_exponent);
    p->set_one_sided(s.one_sided);
  }
  void operator()(const sea::PiersonMoskowitzSystem& s) const {
    auto* p = out->mutable_pierson_moskowitz();
    p->set_wind_speed_19_5_m_per_s(s.wind_speed_19_5_m_per_s);
    SetDirection(s.wave_to_rad, p->mutable_direction());
    SetSpreading(s.spreading, p->mutable_spreading());
  }
  void operator()(const sea::JonswapSystem& s) const {
    auto* p = out->mutable_jonswap();
    p->set_hs_m(s.hs_m);
    p->set_tp_s(s.tp_s);
    p->set_gamma(s.gamma);
    SetDirection(s.wave_to_rad, p->mutable_direction());
    SetSpreading(s.spreading, p->mutable_spreading());
    p->set_use_depth(s.use_depth);
  }
  void operator()(const sea::FetchJonswapSystem& s) const {
    auto* p = out->mutable_fetch_jonswap();
    p->set_wind_speed_m_per_s(s.wind_speed_m_per_s);
    p->set_fetch_m(s.fetch_m);
    p->set_gamma(s.gamma);
    SetDirection(s.wave_to_rad, p->mutable_direction());
    SetSpreading(s.spreading, p->mutable_spreading());
    p->set_use_depth(s.use_depth);
  }
  void operator()(const sea::ElfouhailySystem& s) const {
    auto* p = out->mutable_elfouhaily();
    p->set_wind_speed_m_per_s(s.wind_speed_m_per_s);
    p->set_inverse_wave_age(s.inverse_wave_age);
    SetDirection(s.wave_to_rad, p->mutable_direction());
  }
  void operator()(const sea::BuoySpectrum& s) const {
    auto* p = out->mutable_buoy();
    AssignFloats(s.frequency_hz, p->mutable_frequency_hz());
    AssignFloats(s.density_m2_per_hz, p->mutable_density_m2_per_hz());
    AssignFloats(s.mean_wave_to_rad, p->mutable_mean_wave_to_rad());
    AssignFloats(s.principal_wave_to_rad, p->mutable_principal_wave_to_rad());
    AssignFloats(s.r1, p->mutable_r1());
    AssignFloats(s.r2, p->mutable_r2());
    SetDirection(s.fallback_wave_to_rad, p->mutable_fallback_direction());
    SetSpreading(s.fallback_spreading, p->mutable_fallback_spreading());
    p->set_hs_m(s.hs_m);
    p->set_add_tail(s.add_tail);
  }
  void operator()(const sea::GridSpectrum& s) const {
    auto* p = out->mutable_grid();
    AssignFloats(s.frequency_hz, p->mutable_frequency_hz());
    AssignFloats(s.wave_to_rad, p->mutable_wave_to_rad());
    AssignFloats(s.density_m2_per_hz_rad, p->mutable_density_m2_per_hz_rad());
    p->set_hs_m(s.hs_m);
    p->set_add_tail(s.add_tail);
  }
};

}  // namespace

void ToProto(const sea::SeaState& sea, v1::SeaState* out) {
  out->set_name(sea.name);
  for (const sea::WaveSystem& system : sea.systems) {
    std::visit(SystemToProto{out->add_systems()}, system);
  }
  for (const sea::RegularWave& wave : sea.regular_waves) {
    auto* p = out->add_regular_waves();
    p->set_amplitude_m(wave.amplitude_m);
    p->set_period_s(wave.period_s);
    SetDirection(wave.wave_to_rad, p->mutable_direction());
    p->set_phase_rad(wave.phase_rad);
  }
  out->set_wind_speed_m_per_s(sea.wind_speed_m_per_s);
  SetDirection(sea.wind_to_rad, out->mutable_wind());
}

void ToProto(const sea::Recipe& recipe, v1::Recipe* out) {
  out->set_sea_model_version(recipe.sea_model_version);
  WriteWaters(recipe, out);
  for (const sea::WeatherEntry& entry : recipe.timeline) {
    auto* p = out->add_timeline();
    p->set_start_tick(entry.start_tick);
    p->set_span_ticks(entry.span_ticks);
    ToProto(entry.sea, p->mutable_sea());
  }
}

void ToProto(const sea::Cascade& cascade, v1::Cascade* out) {
  out->set_length_m(cascade.length_m);
  out->set_rotation_rad(cascade.rotation_rad);
  out->set_wavenumber_min_rad_per_m(cascade.wavenumber_min_rad_per_m);
  out->set_wavenumber_max_rad_per_m(cascade.wavenumber_max_rad_per_m);
  out->set_query_grid_size(cascade.query_grid_size);
}

}  // namespace onesea::wire
