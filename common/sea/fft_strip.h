#pragma once

#include <cstdint>
#include <vector>

#include "common/sea/aligned.h"

/// The own two-dimensional transform: pruned, in strips, with the same bits on every machine.
namespace onesea::sea {

/// Floats in a strip: one cache line, the widest vector in use. Strips are this wide on every SIMD
/// target.
inline constexpr int kStripLanes = 16;

/// One axis of the transform z[y] = Σ_n x[n] e^{2πi n y / size}, n = -index_max..index_max, y =
/// 0..size-1.
///
/// Since few inputs are non-zero, y = q + (size / sub) p splits it into size / sub transforms of
/// `sub` points, the smallest power of two >= 2 index_max: the inputs of the q-th are x[n] e^{2πi n
/// q / size}.
struct StripAxis {
  StripAxis(int size, int index_max);

  int size = 0;
  int index_max = 0;
  int sub = 0;                  ///< points of a sub-transform, 16..1024
  bool folds = false;           ///< n = +sub/2 and n = -sub/2 meet in one input
  std::vector<int> radices;     ///< 8 or 4 each, product sub, at least two
  std::vector<int> source_row;  ///< (sub) n + index_max, or -1 where the input is zero
  std::vector<float>
      load_twiddles;  ///< (size / sub x 2 index_max + 1 x 2) e^{2πi n q / size}, re and im
  std::vector<std::vector<float>>
      stage_twiddles;             ///< per stage but the last: (length / radix x radix - 1 x 2)
  std::vector<int> output_index;  ///< (sub / last radix) p of the first output of each last block
};

/// Inverse transform of one packed pair of real fields on an N x N grid, for spectra with |index|
/// <= index_max.
///
/// Shape: input re and im are ((2 index_max + 1) x Pitch()) row-major, row i + index_max, column j
/// + index_max;
///   columns beyond 2 index_max are ignored. Output re and im are (N x N) row-major [y * N + x]:
///   z(x, y) = Σ_ij Z(i, j) e^{2πi (i x + j y) / N}, no scale.
/// Cost:  N = 256, index_max = 32: about 45 µs with AVX-512. Allocates nothing after construction.
/// Not thread-safe. Bits:  every lane is its own column; additions and products come in one fixed
/// order and are never fused, so the
///   result is the same for every SIMD target.
class StripTransform {
 public:
  StripTransform(int grid_size, int index_max);

  int grid_size() const { return axis_.size; }
  int index_max() const { return axis_.index_max; }
  /// Floats from one input row to the next; a multiple of kStripLanes.
  int Pitch() const { return PitchFor(axis_.index_max); }
  static int PitchFor(int index_max) {
    return (2 * index_max + 1 + kStripLanes - 1) / kStripLanes * kStripLanes;
  }

  void Inverse(const float* spectrum_re, const float* spectrum_im, float* out_re, float* out_im);

  /// Scratch of one transform, in floats; the transposed block has padded rows (power-of-two
  /// strides share L1 sets).
  struct Scratch {
    FloatArray butterflies;  ///< (2 x sub x kStripLanes)
    FloatArray columns;      ///< (2 x N x kStripLanes) output of one strip of the first pass
    FloatArray rows;         ///< (2 x 2 index_max + 1 x row_pitch) between the passes
    int row_pitch = 0;
  };

 private:
  StripAxis axis_;
  Scratch scratch_;
};

}  // namespace onesea::sea
