#include "tests/render/test_wake.h"

#include <algorithm>
#include <cmath>

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;

double Noise(int i, int j) {
  std::uint32_t h =
      static_cast<std::uint32_t>(i) * 374761393u + static_cast<std::uint32_t>(j) * 668265263u;
  h = (h ^ (h >> 13)) * 1274126177u;
  return static_cast<double>((h ^ (h >> 16)) & 0xffffu) / 65535.0;
}

double SmoothNoise(double x, double y) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double u = x - i, v = y - j;
  return (1 - v) * ((1 - u) * Noise(i, j) + u * Noise(i + 1, j)) +
         v * ((1 - u) * Noise(i, j + 1) + u * Noise(i + 1, j + 1));
}

// `behind` and `aside` [m] of a boat of the given speed.
double WakeHeight(double behind, double aside, double speed, double size) {
  constexpr int kAngles = 240;
  double sum = 0.0;
  for (int n = 0; n < kAngles; ++n) {
    const double angle = kPi * ((n + 0.5) / kAngles - 0.5), c = std::cos(angle);
    const double k = 9.81 / (speed * speed * c * c), damped = 0.5 * k * k * size * size;
    if (damped > 20.0) continue;
    sum += std::exp(-damped) * std::sin(k * (behind * c + aside * std::sin(angle)));
  }
  return sum * kPi / kAngles;
}

}  // namespace

TestWake::TestWake(Vec2d place, double heading, double speed, double size, double amplitude,
                   int cells, double cell)
    : cells_(cells), cell_m_(cell) {
  const double c = std::cos(heading), s = std::sin(heading), reach = 0.5 * cells * cell;
  const Vec2d middle = place - 0.62 * reach * Vec2d{c, s};
  first_m_ = {std::floor((middle.x - reach) / cell) * cell,
              std::floor((middle.y - reach) / cell) * cell};
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const Vec2d off = first_m_ + Vec2d{i * cell, j * cell} - place;
      const double behind = -(c * off.x + s * off.y), aside = -s * off.x + c * off.y;
      const double started = std::clamp(behind / (2.0 * size) + 0.8, 0.0, 1.0);
      const double height =
          started <= 0.0 ? 0.0 : amplitude * started * WakeHeight(behind, aside, speed, size);
      height_m_.push_back(static_cast<float>(height));
      // A churned strip that spreads and thins out, and the bow's own white.
      const double width = 0.55 * size + 0.045 * std::max(behind, 0.0);
      const double across = std::exp(-std::pow(aside / width, 4));
      const double age = behind < 0.3 * size ? 0.0 : std::exp(-behind / (5.5 * speed));
      const double ragged = 0.35 + 0.9 * SmoothNoise(off.x / 1.7, off.y / 1.7);
      double foam = 0.85 * across * age * ragged;
      const double arm = std::abs(std::abs(aside) - 0.33 * (behind + 0.9 * size));
      if (behind > -1.2 * size && behind < 3.5 * size) {
        foam = std::max(foam, 0.8 * ragged * std::exp(-std::pow(arm / 0.35, 2)) *
                                  std::exp(-std::max(behind, 0.0) / (1.5 * size)));
      }
      foam_.push_back(static_cast<float>(std::clamp(foam, 0.0, 1.0)));
    }
  }
}

WaterPatch TestWake::Patch() const {
  return {first_m_, cell_m_, cells_, cells_, 1, height_m_, foam_};
}

double TestWake::HeightAt(Vec2d place) const {
  const int i = static_cast<int>(std::lround((place.x - first_m_.x) / cell_m_));
  const int j = static_cast<int>(std::lround((place.y - first_m_.y) / cell_m_));
  if (i < 0 || j < 0 || i >= cells_ || j >= cells_) return 0.0;
  return static_cast<double>(height_m_[static_cast<std::size_t>(j * cells_ + i)]);
}

std::vector<TestWake> HarbourWakes() {
  std::vector<TestWake> wakes;
  wakes.emplace_back(Vec2d{18, -2}, 0.5, 4.2, 0.9, 0.30);
  wakes.emplace_back(Vec2d{42, 14}, 2.3, 5.0, 1.1, 0.32);
  return wakes;
}

void FillHarbour(TestSea& sea, const std::vector<TestWake>& wakes, RenderFrame& frame) {
  frame.patches.clear();
  for (const TestWake& wake : wakes) frame.patches.push_back(wake.Patch());
  const auto height = [&](Vec2d place) {
    double sum = sea.HeightAt(place);
    for (const TestWake& wake : wakes) sum += wake.HeightAt(place);
    return sum;
  };
  // Rests on the plane through the water at four points.
  const auto afloat = [&](SharedHullMesh mesh, Vec2d place, double heading, double reach,
                          double draught, double bow_up, std::array<float, 3> colour) {
    const Vec2d fore{reach * std::cos(heading), reach * std::sin(heading)}, left{-fore.y, fore.x};
    const double bow = height(place + fore), stern = height(place - fore);
    const double port = height(place + left), starboard = height(place - left);
    const double pitch = -std::atan2(bow - stern, 2 * reach) - bow_up;
    const double roll = std::atan2(port - starboard, 2 * reach);
    const double cy = std::cos(heading / 2), sy = std::sin(heading / 2), cp = std::cos(pitch / 2),
                 sp = std::sin(pitch / 2), cr = std::cos(roll / 2), sr = std::sin(roll / 2);
    frame.hulls.push_back({std::move(mesh),
                           {place.x, place.y, 0.25 * (bow + stern + port + starboard) - draught},
                           {cy * cp * cr + sy * sp * sr, cy * cp * sr - sy * sp * cr,
                            cy * sp * cr + sy * cp * sr, sy * cp * cr - cy * sp * sr},
                           colour});
  };
  frame.hulls.clear();
  const SharedHullMesh boat = BoatModel(6.0, 2.3, 1.0), launch = BoatModel(8.5, 2.9, 1.25);
  afloat(boat, {18, -2}, 0.5, 2.0, 0.42, 0.05, {0.42f, 0.045f, 0.035f});
  afloat(launch, {42, 14}, 2.3, 2.8, 0.5, 0.05, {0.03f, 0.09f, 0.26f});
  afloat(boat, {24, 9}, -0.9, 2.0, 0.42, 0.0, {0.75f, 0.75f, 0.72f});
  afloat(BuoyModel(), {13, 5.5}, 0.3, 0.5, -0.1, 0.0, {0.6f, 0.04f, 0.03f});
  afloat(CrateModel(), {9, 1.8}, 0.7, 0.4, 0.1, 0.1, {1, 1, 1});
  afloat(BarrelModel(), {8, -1.6}, 0.7, 0.3, 0.15, 1.4, {0.03f, 0.13f, 0.4f});
  afloat(BallModel(0.35), {7, -2.6}, 0.7, 0.3, -0.15, 0.3, {0.8f, 0.22f, 0.02f});
  afloat(RaftModel({3, 2.2, 0.4}), {12, -6}, 1.1, 1.0, -0.02, 0.0, {1, 1, 1});
}

}  // namespace onesea::render
