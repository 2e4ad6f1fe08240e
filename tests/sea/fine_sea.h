#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "common/sea/components.h"
#include "common/sea/surface.h"

/// A fast oracle for point queries: planes of 1024² (tested against the direct sum in surface_test)
/// read by cubic convolution. Waves have at least 32 samples here, so that it differs from the
/// direct sum by less than 1e-4 of their amplitude; it shares no interpolation with
/// the queries.
namespace onesea::sea {

struct FinePoint {
  double height_m = 0, dx_m = 0, dy_m = 0;
  double jxx = 0, jyy = 0, jxy = 0;
};

class FineSea {
 public:
  FineSea(std::shared_ptr<const Components> sea, SimTime time) : sea_(std::move(sea)) {
    for (std::size_t c = 0; c < sea_->cascades.size(); ++c) {
      Synthesiser synthesiser(sea_, static_cast<int>(c), kN, kFields);
      CascadeFields fields(kN, kFields);
      synthesiser.Evaluate(time, fields);
      // One array of points, so that a read touches few cache lines.
      std::vector<float>& points = points_.emplace_back(std::size_t{6} * kN * kN);
      for (int f = 0; f < 6; ++f) {
        const auto plane = fields.Plane(kList[f]);
        for (std::size_t n = 0; n < plane.size(); ++n) points[6 * n + f] = plane[n];
      }
    }
  }

  FinePoint At(double x, double y) const {
    FinePoint sum;
    for (std::size_t c = 0; c < points_.size(); ++c) {
      const Cascade& cascade = sea_->cascades[c].cascade;
      const double co = std::cos(cascade.rotation_rad), si = std::sin(cascade.rotation_rad);
      const double u = (co * x + si * y) / cascade.length_m * kN;
      const double v = (co * y - si * x) / cascade.length_m * kN;
      double wu[4], wv[4];
      const std::int64_t iu = static_cast<std::int64_t>(std::floor(u)) - 1;
      const std::int64_t iv = static_cast<std::int64_t>(std::floor(v)) - 1;
      Cubic(u - std::floor(u), wu);
      Cubic(v - std::floor(v), wv);
      double value[6] = {};
      for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 4; ++a) {
          const std::size_t at = ((iv + b) & (kN - 1)) * kN + ((iu + a) & (kN - 1));
          const double w = wu[a] * wv[b];
          for (int f = 0; f < 6; ++f) value[f] += w * points_[c][6 * at + f];
        }
      }
      sum.height_m += value[0];
      sum.dx_m += value[1];
      sum.dy_m += value[2];
      sum.jxx += value[3];
      sum.jyy += value[4];
      sum.jxy += value[5];
    }
    return sum;
  }

  /// Newton from (px, py); returns the miss.
  double Invert(double x, double y, double& px, double& py, FinePoint& at) const {
    double miss = 0;
    for (int n = 0; n < 12; ++n) {
      at = At(px, py);
      const double mx = px + at.dx_m - x, my = py + at.dy_m - y;
      miss = std::hypot(mx, my);
      if (miss < 1e-7) break;
      const double a = 1 + at.jxx, d = 1 + at.jyy, det = a * d - at.jxy * at.jxy;
      px -= (d * mx - at.jxy * my) / det;
      py -= (a * my - at.jxy * mx) / det;
    }
    return miss;
  }

 private:
  static constexpr int kN = 1024;
  static constexpr FieldSet kFields =
      kQueryFields | Bit(Field::kJacobianXX) | Bit(Field::kJacobianYY) | Bit(Field::kJacobianXY);
  static constexpr Field kList[6] = {Field::kHeight,        Field::kDisplacementX,
                                     Field::kDisplacementY, Field::kJacobianXX,
                                     Field::kJacobianYY,    Field::kJacobianXY};
  static void Cubic(double f, double (&w)[4]) {  // Lagrange through four points
    w[0] = -f * (f - 1) * (f - 2) / 6;
    w[1] = (f + 1) * (f - 1) * (f - 2) / 2;
    w[2] = -(f + 1) * f * (f - 2) / 2;
    w[3] = (f + 1) * f * (f - 1) / 6;
  }
  std::shared_ptr<const Components> sea_;
  std::vector<std::vector<float>> points_;
};

}  // namespace onesea::sea
