#pragma once

#include <cmath>

namespace onesea::sea {

/// The horizontal map p -> p + D(p) at a point: eigenvalues of its symmetric Jacobian I + ∇D, total
/// over cascades.
///
///   J± = ½(Jxx + Jyy) ± ½√((Jxx - Jyy)² + 4 Jxy²),   least and greatest stretch
///
/// The surface folds over itself where `least` < 0, along `direction`. (Two negative eigenvalues
/// give a positive determinant: test the eigenvalue, not the determinant.)
/// Source: Tessendorf 2001, eq. 45-49, where eq. 48-49 print the eigenvector with a wrong divisor;
/// for the eigenvalue J- it is (Jxy, J- - Jxx) or (J- - Jyy, Jxy), whichever is longer, and any
/// axis when Jxy = 0 = Jxx - Jyy.
struct FoldState {
  double least = 1.0;
  double greatest = 1.0;
  double direction_x = 1.0;  ///< unit vector, sign free
  double direction_y = 0.0;
};

/// `xx`, `yy`, `xy`: ∂D_x/∂x, ∂D_y/∂y, ∂D_x/∂y, without the identity. Exact bits on every machine.
inline FoldState FoldOf(double xx, double yy, double xy) {
  const double mean = 1.0 + 0.5 * (xx + yy);
  const double half_difference = 0.5 * (xx - yy);
  const double radius = std::sqrt(half_difference * half_difference + xy * xy);
  FoldState fold{mean - radius, mean + radius, 1.0, 0.0};
  // Of the two forms of the eigenvector the one without cancellation.
  const double ax = half_difference > 0.0 ? xy : -(radius - half_difference);
  const double ay = half_difference > 0.0 ? -(radius + half_difference) : xy;
  const double norm = std::sqrt(ax * ax + ay * ay);
  if (norm > 0.0) {
    fold.direction_x = ax / norm;
    fold.direction_y = ay / norm;
  }
  return fold;
}

}  // namespace onesea::sea
