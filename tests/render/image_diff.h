#pragma once

#include <cstdint>
#include <string>

#include "tests/render/gl_fixture.h"

namespace onesea::render {

/// How alike two pictures of one size look.
///
///   rmse  root of the mean squared difference of 8-bit values, over all channels [0, 255]
///   ssim  mean over 8 x 8 blocks of luma of the structural similarity (Wang et al. 2004),
///         (2 μ_a μ_b + C1)(2 σ_ab + C2) / ((μ_a² + μ_b² + C1)(σ_a² + σ_b² + C2)); 1 = equal
struct Likeness {
  double rmse = 0.0;
  double ssim = 1.0;
};
Likeness Compare(const Picture& a, const Picture& b);

/// An empty picture if the file can't be read.
Picture ReadPng(const std::string& path);

}  // namespace onesea::render
