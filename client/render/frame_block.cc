#include "client/render/frame_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "client/render/foam_texture.h"
#include "client/render/water_optics.h"
#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kCloudMapM = 21'000.0;

double Fraction(double value) { return value - std::floor(value); }

glm::vec4 Pack(const glm::vec3& rgb, double w) { return glm::vec4(rgb, static_cast<float>(w)); }

glm::vec4 Pack(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
          static_cast<float>(w)};
}

// Offset in turns of a tile of `length_m`, turned by `rotation_rad`, under the eye.
glm::vec4 TileMap(Vec2d eye, double length_m, double rotation_rad, double texel_m) {
  const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
  return Pack(Fraction((c * eye.x + s * eye.y) / length_m),
              Fraction((-s * eye.x + c * eye.y) / length_m), 1.0 / length_m, std::log2(texel_m));
}

// Share of the sea that is white [-]. Source: Monahan & O'Muircheartaigh 1980.
double WhitecapCover(double wind_speed_m_per_s) {
  if (!(wind_speed_m_per_s > 3.5)) return 0.0;
  return std::min(0.5, 3.84e-6 * std::pow(wind_speed_m_per_s, 3.41));
}

// The z with 0.5 erfc(z / √2) = share: how many deviations below its mean the folding must lie.
double DeviationsExceededBy(double share) {
  double low = 0.0, high = 6.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > share ? low : high) = middle;
  }
  return low;
}

void FillView(const RenderFrame& frame, int width, int height, FrameBlock& block) {
  const Camera& camera = frame.camera;
  const double cy = std::cos(camera.yaw_rad), sy = std::sin(camera.yaw_rad);
  const double cp = std::cos(camera.pitch_rad), sp = std::sin(camera.pitch_rad);
  const double cr = std::cos(camera.roll_rad), sr = std::sin(camera.roll_rad);
  const glm::dvec3 forward(cp * cy, cp * sy, sp);
  const glm::dvec3 level_right(sy, -cy, 0.0);
  const glm::dvec3 level_up = glm::cross(level_right, forward);
  const glm::dvec3 right = cr * level_right - sr * level_up;
  const glm::dvec3 up = sr * level_right + cr * level_up;
  const double tangent = std::tan(0.5 * camera.vertical_fov_rad);
  const double aspect = static_cast<double>(width) / height;

  // Rows: picture x, y, depth unused, w = distance along the view. Depth is set by the shader.
  const glm::dvec3 x_row = right / (tangent * aspect), y_row = up / tangent;
  const double eye_m = camera.position_m.z - frame.water_level_m;
  const glm::dvec3 eye(0.0, 0.0, eye_m);
  glm::dmat4 matrix(0.0);
  for (int i = 0; i < 3; ++i) {
    matrix[i][0] = x_row[i];
    matrix[i][1] = y_row[i];
    matrix[i][3] = forward[i];
  }
  matrix[3][0] = -glm::dot(x_row, eye);
  matrix[3][1] = -glm::dot(y_row, eye);
  matrix[3][3] = -glm::dot(forward, eye);
  block.clip_from_world = glm::mat4(matrix);
  block.ray_forward = Pack(glm::vec3(forward), 2.0 * tangent / height);
  block.ray_right = Pack(glm::vec3(right * tangent * aspect), width);
  block.ray_up = Pack(glm::vec3(up * tangent), height);
  block.eye = Pack(0.0, 0.0, eye_m, std::fmod(frame.time_s, 3600.0));
}

void FillLight(const RenderFrame& frame, const SkyLight& light, FrameBlock& block) {
  const double elevation = frame.sun.elevation_rad, azimuth = frame.sun.azimuth_rad;
  block.sun_direction = Pack(std::cos(elevation) * std::cos(azimuth),
                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation), azimuth);
  const double exposure = light.exposure * std::exp2(frame.exposure_stops);
  block.sun_irradiance = Pack(light.sun_irradiance, exposure);
  block.sky_irradiance = Pack(light.sky_irradiance, frame.weather.cloud_cover);
  const float sine = static_cast<float>(std::max(0.0, std::sin(elevation)));
  const glm::vec3 down = light.sun_irradiance * (0.96f * sine) + light.sky_irradiance * 0.93f;
  const WaterOptics& optics = OpticsOf(frame.water);
  block.water_leaving = Pack(WaterLeavingRadiance(optics, down), frame.choppiness);
  const glm::vec3 bubbly = BubblyReflectance(optics, 0.02f);
  block.foam_irradiance =
      Pack(BubblyReflectance(optics, 0.10f) * (0.54f / 4.0f) * down, frame.time_s * 1e-5);
  block.crest_radiance =
      Pack(bubbly * light.sun_irradiance * (1.0f / static_cast<float>(kPi)), 0.0);
  // Transmission both ways over n², as in WaterLeavingRadiance().
  block.bottom_irradiance = Pack(down * (0.54f / static_cast<float>(kPi)), 0.0);
  block.water_kd = Pack(optics.kd, 0.0);
  block.haze = Pack(light.extinction_per_m, 0.0);
  block.cloud_radiance = Pack(light.cloud_radiance, 1.0 / kCloudMapM);
}

// How the window's foam is shown: what spectral folding calls foam depends on the shortest waves
// that a recipe resolves, so the picture keeps the freshest of it, what this wind makes white.
glm::vec4 FoamLevel(const FoamCells& foam, double cover) {
  std::array<int, 256> counts{};
  for (std::uint8_t cell : foam.cells) ++counts[cell];
  const double total = static_cast<double>(foam.cells.size());
  constexpr double kGainMax = 1.6;
  for (int threshold = 0; threshold < 230; threshold += 5) {
    double sum = 0.0;
    for (int value = threshold; value < 256; ++value) {
      sum += counts[static_cast<std::size_t>(value)] * (value - threshold) / (255.0 - threshold);
    }
    const double mean = sum / total, start = threshold / 255.0;
    if (mean > cover) continue;
    const double gain = std::min(kGainMax, cover / std::max(mean, 1e-9));
    return Pack(start, gain / (1.0 - start), 0, 0);
  }
  return Pack(0.9, 10.0, 0, 0);
}

void FillFoam(const RenderFrame& frame, double slope_variance, FrameBlock& block) {
  const Vec2d eye{frame.camera.position_m.x, frame.camera.position_m.y};
  const double cover = WhitecapCover(frame.weather.wind_speed_m_per_s);
  const double folding_deviation = frame.choppiness * std::sqrt(std::max(slope_variance, 1e-8));
  const double threshold =
      cover > 0.0 ? 1.0 - DeviationsExceededBy(cover) * folding_deviation : -99.0;
  block.wind = Pack(std::cos(frame.weather.wind_to_rad), std::sin(frame.weather.wind_to_rad), 0.0,
                    threshold);
  block.foam_detail = Pack(Fraction(eye.x / kFoamTextureM), Fraction(eye.y / kFoamTextureM),
                           1.0 / kFoamTextureM, std::log2(kFoamTextureSize / kFoamTextureM));
  if (frame.foam.cells.empty()) return;
  block.foam_level = FoamLevel(frame.foam, cover);
  block.foam_level.z = static_cast<float>(-std::log2(frame.foam.cell_m));
  const double extent = frame.foam.side * frame.foam.cell_m;
  block.foam_window =
      Pack(Fraction((eye.x - frame.foam.origin_m.x) / extent),
           Fraction((eye.y - frame.foam.origin_m.y) / extent), 1.0 / extent, 0.5 * extent);
}

void FillWaves(const RenderFrame& frame, const std::vector<SlopeStats>& stats, FrameBlock& block) {
  const Vec2d eye{frame.camera.position_m.x, frame.camera.position_m.y};
  double slopes = 1e-12, heights_m2 = 0.0;
  for (const SlopeStats& s : stats) {
    slopes += s.xx + s.yy;
    heights_m2 += s.height_variance_m2;
  }
  block.water_kd.w = static_cast<float>(4.0 * std::sqrt(heights_m2));
  for (std::size_t c = 0; c < frame.cascades.size(); ++c) {
    const CascadePlanes& planes = frame.cascades[c];
    block.cascade_map[c] =
        TileMap(eye, planes.length_m, planes.rotation_rad, planes.length_m / planes.grid_size);
    block.cascade_turn[c] = Pack(std::cos(planes.rotation_rad), std::sin(planes.rotation_rad),
                                 stats[c].height_variance_m2, 0);
    const SlopeStats& s = stats[c];
    const double trace = std::max(s.xx + s.yy, 1e-12);
    block.cascade_share[c] = Pack(s.xx / trace, s.yy / trace, s.xy / trace, trace / slopes);
  }
  const std::size_t regular =
      std::min<std::size_t>(frame.regular_waves.size(), kRenderRegularWavesMax);
  for (std::size_t n = 0; n < regular; ++n) {
    const RegularWaveNow& wave = frame.regular_waves[n];
    const double phase = wave.phase_rad + wave.kx_rad_per_m * eye.x + wave.ky_rad_per_m * eye.y;
    block.regular[n] = Pack(wave.kx_rad_per_m, wave.ky_rad_per_m, wave.amplitude_m,
                            2.0 * kPi * Fraction(phase / (2.0 * kPi)));
  }
  block.counts = Pack(static_cast<double>(frame.cascades.size()), static_cast<double>(regular),
                      frame.cascades.empty() ? 1.0 : frame.cascades[0].grid_size, 0.0);
}

}  // namespace

SlopeStats MeasureSlopes(const CascadePlanes& planes) {
  // Every third point in each direction: 3 shares no factor with N, and waves span 8 points.
  SlopeStats stats;
  int count = 0;
  const int n = planes.grid_size;
  for (int y = 0; y < n; y += 3) {
    for (int x = 0; x < n; x += 3, ++count) {
      const std::size_t at = static_cast<std::size_t>(y * n + x);
      const double sx = planes.slope_x[at], sy = planes.slope_y[at], h = planes.height[at];
      stats.xx += sx * sx;
      stats.yy += sy * sy;
      stats.xy += sx * sy;
      stats.height_variance_m2 += h * h;
    }
  }
  const double scale = 1.0 / std::max(count, 1);
  return {stats.xx * scale, stats.yy * scale, stats.xy * scale, stats.height_variance_m2 * scale};
}

double UnresolvedSlopeVariance(const RenderFrame& frame, const std::vector<SlopeStats>& stats) {
  double resolved = 0.0;
  for (const SlopeStats& s : stats) resolved += s.xx + s.yy;
  const double clean_sea = 0.003 + 0.00512 * frame.weather.wind_speed_m_per_s;
  return std::clamp(clean_sea - resolved, frame.unresolved_mss,
                    std::max(frame.unresolved_mss, 0.05));
}

FrameBlock MakeFrameBlock(const RenderFrame& frame, const SkyLight& light, const OceanGrid& grid,
                          const std::vector<SlopeStats>& stats, const SlopeStats& ripples,
                          double ripple_length_m, int width, int height) {
  ONESEA_CHECK(frame.cascades.size() == stats.size() && stats.size() <= kRenderCascadesMax);
  FrameBlock block{};
  FillView(frame, width, height, block);
  FillLight(frame, light, block);
  FillWaves(frame, stats, block);
  double slope_variance = 0.0;
  for (const SlopeStats& s : stats) slope_variance += s.xx + s.yy;
  FillFoam(frame, slope_variance, block);

  const Vec2d eye{frame.camera.position_m.x, frame.camera.position_m.y};
  constexpr double kRippleRotationRad = 0.0;
  block.ripple_map = TileMap(eye, ripple_length_m, kRippleRotationRad, ripple_length_m / 128.0);
  block.ripple_stats = Pack(ripples.xx, ripples.yy, ripples.xy, frame.quality.ripples ? 1.0 : 0.0);
  // What is left, split along and across the wind after Cox & Munk: 0.00316 U : 0.003 + 0.00192 U.
  const double held = frame.quality.ripples ? ripples.xx + ripples.yy : 0.0;
  const double rest = std::max(4e-4, UnresolvedSlopeVariance(frame, stats) - held);
  const double wind = std::max(1.0, frame.weather.wind_speed_m_per_s);
  const double along = rest * 0.00316 * wind / (0.003 + 0.00508 * wind), across = rest - along;
  const double c = std::cos(frame.weather.wind_to_rad), s = std::sin(frame.weather.wind_to_rad);
  block.fine_variance = Pack(along * c * c + across * s * s, along * s * s + across * c * c,
                             (along - across) * c * s, 0.0);
  block.grid =
      Pack(grid.columns, grid.first_azimuth_rad, grid.azimuth_step_rad, grid.log_radius_step);
  block.grid_rows = Pack(grid.first_log_radius, grid.has_nadir ? 1.0 : 0.0, grid.rows, 0.0);
  return block;
}

}  // namespace onesea::render
