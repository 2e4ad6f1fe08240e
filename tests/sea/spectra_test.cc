// Every family against its closed form or a number integrated by another program (tests/oracle/).

#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/constants.h"
#include "common/sea/dispersion.h"
#include "common/sea/spectrum_elfouhaily.h"
#include "common/sea/spectrum_jonswap.h"
#include "common/sea/spectrum_phillips.h"
#include "common/sea/spectrum_pierson_moskowitz.h"
#include "common/sea/spectrum_tma.h"
#include "common/sea/wave_spectrum.h"

namespace onesea::sea {
namespace {

double HsOf(const WaveSpectrum& spectrum) {
  return 4.0 * std::sqrt(RadialMoment(spectrum, 1e-4, spectrum.EndRadPerM(), 0));
}

// ∫ ω^n S dω through wavenumber: the change of variables is part of what is tested.
double FrequencyMoment(const WaveSpectrum& spectrum, int n, double k_end) {
  double sum = 0.0;
  for (double k = 1e-4; k < k_end; k *= 1.0 + 1e-4) {
    const double middle = k * (1.0 + 0.5e-4);
    sum +=
        std::pow(IntrinsicFrequency(middle, 0.0), n) * spectrum.Omnidirectional(middle) * 1e-4 * k;
  }
  return sum;
}

TEST(PiersonMoskowitz, HasItsPublishedHeightAndPeriods) {
  struct Row {
    double wind, hs, tp, tm01, tm02;
  };
  for (const Row& row : {Row{10.0, 2.13298, 7.30181, 5.63533, 5.18699},
                         Row{15.0, 4.79921, 10.9527, 8.45299, 7.78049},
                         Row{20.0, 8.53194, 14.6036, 11.2707, 10.374}}) {
    const PiersonMoskowitzSystem system{row.wind, 0.0, {}};
    const JonswapShape shape = PiersonMoskowitzShape(system);
    EXPECT_NEAR(4.0 * std::sqrt(shape.Variance()) / row.hs, 1.0, 1e-5);
    EXPECT_NEAR(2.0 * kPi / shape.omega_p_rad_per_s / row.tp, 1.0, 1e-5);
    const auto spectrum = MakePiersonMoskowitzSpectrum(system, 0.0);
    EXPECT_NEAR(HsOf(*spectrum) / row.hs, 1.0, 1e-4);
    const double m0 = FrequencyMoment(*spectrum, 0, 364.0);
    const double m1 = FrequencyMoment(*spectrum, 1, 364.0);
    EXPECT_NEAR(2.0 * kPi * m0 / m1 / row.tm01, 1.0, 1e-3);
    // m2 falls as 1/ω² beyond 364 rad/m, which leaves 4e-4 of it out.
    const double m2 = FrequencyMoment(*spectrum, 2, 364.0);
    EXPECT_NEAR(2.0 * kPi * std::sqrt(m0 / m2) / row.tm02, 1.0, 2e-3);
  }
}

TEST(Jonswap, FetchLawsGiveTheIntegratedHeights) {
  struct Row {
    double wind, fetch_km, hs, tp, h10, h20, h50;
  };
  for (const Row& row : {Row{10, 10, 0.567365, 2.82822, 0.566143, 0.567086, 0.567092},
                         Row{10, 100, 2.01309, 6.04663, 1.60349, 1.90429, 2.01106},
                         Row{15, 100, 2.89964, 6.9404, 2.10027, 2.59798, 2.88642},
                         Row{17, 300, 5.93859, 10.4068, 3.09561, 4.11834, 5.44673},
                         Row{20, 300, 6.87395, 10.998, 3.41251, 4.56837, 6.15252}}) {
    FetchJonswapSystem system;
    system.wind_speed_m_per_s = row.wind;
    system.fetch_m = row.fetch_km * 1000.0;
    const JonswapShape shape = FetchJonswapShape(system);
    EXPECT_NEAR(2.0 * kPi / shape.omega_p_rad_per_s / row.tp, 1.0, 1e-5);
    EXPECT_NEAR(4.0 * std::sqrt(shape.Variance()) / row.hs, 1.0, 1e-4);
    system.use_depth = true;
    for (const auto& [depth, hs] : {std::pair{10.0, row.h10}, {20.0, row.h20}, {50.0, row.h50}}) {
      // The table's heights leave out capillarity and what lies above 12 rad/s.
      EXPECT_NEAR(HsOf(*MakeFetchJonswapSpectrum(system, depth)) / hs, 1.0, 1e-3) << depth;
    }
  }
}

TEST(Jonswap, PeakEnhancementRaisesTheVariance) {
  const double base = JonswapShape{0.0081, 1.0, 1.0, 0.0}.Variance();
  EXPECT_NEAR(base, 0.0081 * kGravity * kGravity / 5.0, 1e-6 * base);
  for (const auto& [gamma, ratio] :
       {std::pair{2.0, 1.24562}, {3.3, 1.52495}, {5.0, 1.85843}, {7.0, 2.22517}}) {
    EXPECT_NEAR((JonswapShape{0.0081, 1.0, gamma, 0.0}.Variance() / base), ratio, 2e-5);
  }
}

TEST(Jonswap, ByHeightIsExactWithAndWithoutDepth) {
  for (const double depth : {0.0, 8.0, 40.0}) {
    JonswapSystem system;
    system.hs_m = 3.7;
    system.tp_s = 11.0;
    system.use_depth = true;
    EXPECT_NEAR(4.0 * std::sqrt(JonswapShapeOf(system, depth).Variance()), 3.7, 1e-9);
    EXPECT_NEAR(HsOf(*MakeJonswapSpectrum(system, depth)), 3.7, 2e-3) << depth;
  }
}

// Wave age from steepness is the fetch laws turned round.
TEST(Jonswap, WaveAgeFollowsFromAlpha) {
  FetchJonswapSystem system;
  system.wind_speed_m_per_s = 12.0;
  system.fetch_m = 80e3;
  const JonswapShape shape = FetchJonswapShape(system);
  EXPECT_NEAR(InverseWaveAgeOfAlpha(shape.alpha), 12.0 * shape.omega_p_rad_per_s / kGravity, 1e-9);
  EXPECT_EQ(InverseWaveAgeOfAlpha(1e-5), 0.84);
  EXPECT_EQ(InverseWaveAgeOfAlpha(1.0), 5.0);
}

TEST(Tma, DepthFactorHasItsValues) {
  constexpr double kDepthM = 10.0;
  for (const auto& [x, phi] : {std::pair{0.25, 0.03125},
                               {0.5, 0.12480},
                               {1.0, 0.48277},
                               {1.5, 0.87853},
                               {2.0, 0.99336},
                               {2.5, 0.99989}}) {
    const double k = WavenumberOf(x / std::sqrt(kDepthM / kGravity), kDepthM);
    EXPECT_NEAR(TmaDepthFactor(k, kDepthM), phi, 1.1e-4) << x;
  }
  EXPECT_EQ(TmaDepthFactor(0.1, 0.0), 1.0);
}

TEST(Phillips, IntegratesToItsClosedForm) {
  for (const auto& [wind, hs] : {std::pair{5.0, 0.458716}, {10.0, 1.83486}, {20.0, 7.33945}}) {
    PhillipsSystem system;
    system.wind_speed_m_per_s = wind;
    system.one_sided = false;
    EXPECT_NEAR(HsOf(*MakePhillipsSpectrum(system)) / hs, 1.0, 1e-4);
    system.one_sided = true;
    EXPECT_NEAR(HsOf(*MakePhillipsSpectrum(system)) / hs, std::sqrt(0.5), 1e-4);
  }
}

// The angular integral in closed form against a sum, for exponents that are no integers too.
TEST(Phillips, OmnidirectionalIsTheIntegralOverDirection) {
  for (const double exponent : {0.0, 1.0, 2.0, 3.5, 32.0}) {
    PhillipsSystem system;
    system.directional_exponent = exponent;
    system.wind_to_rad = 1.0;
    const auto spectrum = MakePhillipsSpectrum(system);
    const WaveSpectrum::Node node = spectrum->NodeAt(0.1);
    double sum = 0.0;
    constexpr int kSteps = 100000;
    for (int n = 0; n < kSteps; ++n) {
      const double theta = 2.0 * kPi * (n + 0.5) / kSteps;
      sum += node.radial * spectrum->Shape(node, {std::cos(theta), std::sin(theta)});
    }
    EXPECT_NEAR(sum * 2.0 * kPi / kSteps * 0.1 / spectrum->Omnidirectional(0.1), 1.0, 1e-4);
  }
}

TEST(Phillips, SmallWavesAreSuppressed) {
  PhillipsSystem system;
  const double k = 5.0;
  const double before = MakePhillipsSpectrum(system)->Omnidirectional(k);
  system.small_wave_cutoff_m = 0.2;
  EXPECT_NEAR(MakePhillipsSpectrum(system)->Omnidirectional(k) / before, std::exp(-1.0), 1e-12);
}

TEST(Elfouhaily, HasItsHeightAndSlopes) {
  struct Row {
    double wind, hs, mss, up, cross;
  };
  for (const Row& row :
       {Row{5, 0.6501, 0.03359, 0.02005, 0.01354}, Row{10, 2.6332, 0.06031, 0.03551, 0.02480},
        Row{15, 5.9228, 0.07956, 0.04723, 0.03232}, Row{20, 10.5017, 0.09324, 0.05606, 0.03718}}) {
    const auto spectrum = MakeElfouhailySpectrum({row.wind, 0.84, 0.0});
    EXPECT_NEAR(HsOf(*spectrum) / row.hs, 1.0, 1e-3);
    EXPECT_NEAR(RadialMoment(*spectrum, 1e-4, 2e4, 2) / row.mss, 1.0, 1e-3);
    double up = 0.0;
    double cross = 0.0;
    constexpr int kDirections = 180;
    for (double k = 1e-3; k < 2e4; k *= 1.005) {
      const WaveSpectrum::Node node = spectrum->NodeAt(k);
      for (int n = 0; n < kDirections; ++n) {
        const double theta = 2.0 * kPi * (n + 0.5) / kDirections;
        const double c = std::cos(theta);
        const double s = std::sin(theta);
        const double energy =
            node.radial * spectrum->Shape(node, {c, s}) * k * (0.005 * k) * 2.0 * kPi / kDirections;
        up += energy * k * k * c * c;
        cross += energy * k * k * s * s;
      }
    }
    EXPECT_NEAR(up / row.up, 1.0, 0.01);
    EXPECT_NEAR(cross / row.cross, 1.0, 0.01);
  }
}

}  // namespace
}  // namespace onesea::sea
