#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"

namespace onesea::sea {

/// The same transform as StripTransform by FFTW (single precision): its oracle and alternative.
/// Without ONESEA_WITH_FFTW nothing here may be called but Available().
///
/// Plans come from stored wisdom (UseWisdom), else from FFTW_ESTIMATE: never from a timing at
/// start-up, so that the same program with the same wisdom makes the same plans. Not thread-safe,
/// except that objects may be made on several threads.
class FftwTransform {
 public:
  static bool Available();
  /// Library version and hash of the wisdom: "fftw-3.3.10-sse2-avx wisdom 0123456789abcdef", or
  /// "... estimate".
  static std::string Name();

  /// Finds the best plans for grids up to `grid_size_max` by timing them (FFTW_PATIENT) and returns
  /// them as text, to be stored. Seconds up to 256, about a minute up to 1024.
  static std::string MeasureWisdom(int grid_size_max);
  /// Plans of transforms made from now on come from this text where it has them. Call it before the
  /// first is made. InvalidArgument if it is of another library or damaged.
  static absl::Status UseWisdom(const std::string& wisdom);

  FftwTransform(int grid_size, int index_max);
  ~FftwTransform();
  /// See StripTransform::Inverse().
  void Inverse(const float* spectrum_re, const float* spectrum_im, float* out_re, float* out_im);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::sea
