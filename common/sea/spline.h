#pragma once

#include "common/base/real_math.h"
#include "common/sea/constants.h"

/// The uniform cubic B-spline, by which point queries read between the samples of a plane.
///
/// A plane of coefficients c gives the field Σ_m c_m β(u - m) per axis. At the samples a wave of
/// phase step a comes out (4 + 2 cos a)/6 times as high as in c; dividing its amplitude by that
/// before the transform makes the spline pass through the samples without a filter.
/// Source: Unser, "Splines: a perfect fit for signal and image processing", IEEE SPM 16(6), 1999.
namespace onesea::sea {

/// Response of the spline at the samples to the wave of lattice index `index` of a grid of
/// `grid_size`.
inline double SplineResponse(int index, int grid_size) {
  return (4.0 + 2.0 * real::Cos(2.0 * kPi * index / grid_size)) / 6.0;
}

/// Greatest relative error of the spline through a wave's samples, at the centre between two: the
/// wave's images from beyond the sampling rate, 2 (a / (2π - a))⁴ and smaller ones.
inline double SplineError(int index, int grid_size) {
  const double half_step_rad = kPi * index / grid_size;
  const double centre = (23.0 * real::Cos(half_step_rad) + real::Cos(3.0 * half_step_rad)) / 24.0;
  return 1.0 - centre / SplineResponse(index, grid_size);
}

/// Weights of the four coefficients around a point, `t` cells after the second of them, and their
/// derivatives.
struct SplineWeights {
  explicit SplineWeights(double t)
      : value{(1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0, (4.0 + t * t * (3.0 * t - 6.0)) / 6.0,
              (1.0 + t * (3.0 + t * (3.0 - 3.0 * t))) / 6.0, t * t * t / 6.0},
        slope{-0.5 * (1.0 - t) * (1.0 - t), 0.5 * t * (3.0 * t - 4.0),
              0.5 * (1.0 + t * (2.0 - 3.0 * t)), 0.5 * t * t} {}
  double value[4];
  double slope[4];
};

}  // namespace onesea::sea
