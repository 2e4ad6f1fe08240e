#include "server/world/iwave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "tests/world/grid_waves.h"

namespace onesea::world {
namespace {

constexpr double kPi = sea::kPi;

// Frequency of a signal sampled every step_s, from its falling zeros.
class ZeroCounter {
 public:
  explicit ZeroCounter(double step_s) : step_s_(step_s) {}
  void Add(double value) {
    if (n_ > 0 && before_ > 0.0 && value <= 0.0) {
      last_s_ = (n_ - 1 + before_ / (before_ - value)) * step_s_;
      if (falls_++ == 0) first_s_ = last_s_;
    }
    before_ = value;
    ++n_;
  }
  int periods() const { return falls_ - 1; }
  double Omega() const { return 2.0 * kPi * periods() / (last_s_ - first_s_); }

 private:
  double step_s_, before_ = 0.0, first_s_ = 0.0, last_s_ = 0.0;
  int n_ = 0, falls_ = 0;
};

// Oracle: ω² = g k tanh(kd), time step included: a standing wave over the whole region swings in
// its middle as water does until the region's ends are heard there.
TEST(Iwave, SwingsAtTheFrequencyOfWater) {
  for (const double cell_m : {0.1, 0.5, 4.0}) {
    for (const double depth_cells : {0.5, 3.0, 0.0}) {
      SolverSpec spec = Region(SolverKind::kIwave, 192, 192, cell_m, depth_cells * cell_m);
      spec.step_s = cell_m > 1.0 ? 1.0 / 15.0 : 1.0 / 60.0;
      const auto solver = Solver(spec);
      for (const double cells : {20.0, 6.3, 2.7}) {
        const double k = 2.0 * kPi / cells, kx = k * std::cos(0.4), ky = k * std::sin(0.4);
        SetWaves(
            *solver,
            [&](double x, double y) { return std::cos(kx * (x - 96.0) + ky * (y - 96.0)); },
            Nothing());
        ZeroCounter zeros(spec.step_s);
        for (int n = 0; n < 3600 && zeros.periods() < 3; ++n) {
          zeros.Add(At(*solver, 96, 96));
          solver->Step({});
        }
        const double tanh = depth_cells > 0.0 ? std::tanh(k * depth_cells) : 1.0;
        const double water = std::sqrt(sea::kGravity * k / cell_m * tanh);
        EXPECT_NEAR(zeros.Omega() / water, 1.0, 0.01)
            << "cell " << cell_m << " m, depth " << depth_cells << " cells, " << cells
            << " cells a wave";
      }
    }
  }
}

// The record's Fourier component of this frequency. Each frequency of a train obeys the theory by
// itself, so a whole train need not keep its form.
std::complex<double> Component(const std::vector<float>& record, double omega_step) {
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < record.size(); ++n) {
    sum += static_cast<double>(record[n]) * std::polar(1.0, -omega_step * static_cast<double>(n));
  }
  return sum;
}

// depth(x) of a plane slope between two flats; x in metres.
struct Slope {
  double from_m, to_m, deep_m, shallow_m;
  double At(double x) const {
    const double t = std::clamp((x - from_m) / (to_m - from_m), 0.0, 1.0);
    return deep_m + t * (shallow_m - deep_m);
  }
};

std::shared_ptr<const sea::Terrain> SlopedBottom(const Slope& slope, double length_m) {
  auto terrain = std::make_shared<sea::Terrain>();
  terrain->cell_m = 1.0;
  terrain->columns = static_cast<int>(length_m) + 2;
  terrain->rows = 2;
  for (int n = 0; n < 2 * terrain->columns; ++n) {
    terrain->elevation_m.push_back(static_cast<float>(-slope.At(n % terrain->columns)));
  }
  return terrain;
}

// Oracle: linear shoaling, a² c_g constant: a wave of 4 s is 0.955375 of its deep-water height on
// 8 m of water, 0.920437 on 3 m and 1.064117 on 1 m (Ks of the linear theory).
TEST(Iwave, WavesShoalByLinearTheory) {
  const double omega = 2.0 * kPi / 4.0;
  for (const auto& [shallow_m, coefficient] :
       {std::pair(3.0, 0.920437), std::pair(1.0, 1.064117)}) {
    const Slope slope{.from_m = 110.0, .to_m = 290.0, .deep_m = 8.0, .shallow_m = shallow_m};
    SolverSpec spec = Region(SolverKind::kIwave, 192, 192, 2.0, 0.0);
    spec.step_s = 1.0 / 15.0;
    spec.terrain = SlopedBottom(slope, 384.0);
    const auto solver = Solver(spec);
    // A paddle of pressure near the west border makes a train of 40 s, a beam with a Gaussian
    // profile of 100 m: it fades by 0.6 % on its way, and the side borders don't matter.
    std::vector<float> head(spec.cells.cells()), deep, shallow;
    const int steps = static_cast<int>(132.0 / spec.step_s);
    for (int n = 0; n < steps; ++n) {
      const double t = n * spec.step_s;
      const double ramp = std::min(t / 8.0, 1.0) * std::clamp((40.0 - t) / 8.0, 0.0, 1.0);
      for (std::size_t at = 0; at < head.size(); ++at) {
        const double x = 2.0 * static_cast<double>(at % 192) - 50.0;
        const double y = 2.0 * (static_cast<double>(at / 192) - 96.0);
        head[at] = static_cast<float>(0.1 * ramp * std::exp(-x * x / 64.0 - y * y / 1e4) *
                                      std::sin(omega * t));
      }
      solver->Step({.pressure_head_m = head});
      deep.push_back(At(*solver, 48, 96));
      shallow.push_back(At(*solver, 152, 96));
    }
    const double ratio = std::abs(Component(shallow, omega * spec.step_s)) /
                         std::abs(Component(deep, omega * spec.step_s));
    const double theory = coefficient / 0.955375;
    std::printf("8 m to %.0f m: %.4f, theory %.4f\n", shallow_m, ratio, theory);
    EXPECT_NEAR(ratio, theory, 0.02);
  }
}

// Oracle: Snell. A wave of 4 s that runs at 28.98° to the slope over 8 m (30° in deep water) turns
// to 18.95° over 2 m, where it is 16.23 m long. Directions and lengths are read from the phases of
// neighbouring cells.
TEST(Iwave, WavesTurnTowardsTheShoreBySnell) {
  const double omega = 2.0 * kPi / 4.0, ky = 0.2595528 * std::sin(28.98129 * kPi / 180.0);
  const Slope slope{.from_m = 120.0, .to_m = 280.0, .deep_m = 8.0, .shallow_m = 2.0};
  SolverSpec spec = Region(SolverKind::kIwave, 192, 256, 2.0, 0.0);
  spec.step_s = 1.0 / 15.0;
  spec.terrain = SlopedBottom(slope, 384.0);
  const auto solver = Solver(spec);
  std::vector<float> head(spec.cells.cells());
  std::vector<float> records[6];
  const int steps = static_cast<int>(110.0 / spec.step_s);
  for (int n = 0; n < steps; ++n) {
    const double t = n * spec.step_s;
    const double ramp = std::min(t / 8.0, 1.0) * std::clamp((40.0 - t) / 8.0, 0.0, 1.0);
    for (std::size_t at = 0; at < head.size() && ramp >= 0.0; ++at) {
      const double x = 2.0 * static_cast<double>(at % 192) - 50.0;
      const double y = 2.0 * (static_cast<double>(at / 192) - 98.0);
      if (std::abs(x) > 32.0) continue;
      head[at] = static_cast<float>(0.1 * ramp * std::exp(-x * x / 64.0 - y * y / 6400.0) *
                                    std::sin(omega * t - ky * y));
    }
    solver->Step({.pressure_head_m = head});
    const int places[6][2] = {{48, 110}, {49, 110}, {48, 111}, {150, 148}, {151, 148}, {150, 149}};
    for (int m = 0; m < 6; ++m) records[m].push_back(At(*solver, places[m][0], places[m][1]));
  }
  const auto wave = [&](int first) {
    std::complex<double> parts[3];
    for (int m = 0; m < 3; ++m) parts[m] = Component(records[first + m], omega * spec.step_s);
    return Vec2d{-std::arg(parts[1] / parts[0]) / 2.0, -std::arg(parts[2] / parts[0]) / 2.0};
  };
  const Vec2d deep = wave(0), shallow = wave(3);
  const auto degrees = [](Vec2d k) { return std::atan2(k.y, k.x) * 180.0 / kPi; };
  std::printf("8 m: %.2f degrees, %.2f m; 2 m: %.2f degrees, %.2f m\n", degrees(deep),
              2.0 * kPi / Norm(deep), degrees(shallow), 2.0 * kPi / Norm(shallow));
  EXPECT_NEAR(degrees(deep), 28.98, 1.0);
  EXPECT_NEAR(degrees(shallow), 18.95, 1.0);
  EXPECT_NEAR(2.0 * kPi / Norm(shallow), 16.2257, 0.03 * 16.2257);
}

}  // namespace
}  // namespace onesea::world
