#pragma once

#include <memory>
#include <string>

namespace onesea::sea {

/// The same transform as StripTransform by FFTW (single precision): its oracle and alternative.
/// Without ONESEA_WITH_FFTW nothing here may be called but Available().
///
/// Plans come from the wisdom in the binary, else from FFTW_ESTIMATE: never from a timing at
/// start-up, so that the same binary makes the same plans. Not thread-safe, except that objects may
/// be made on several threads.
class FftwTransform {
 public:
  static bool Available();
  /// Library version and hash of the wisdom: "fftw 3.3.10 wisdom 0123456789abcdef".
  static std::string Name();

  FftwTransform(int grid_size, int index_max);
  ~FftwTransform();
  /// See StripTransform::Inverse().
  void Inverse(const float* spectrum_re, const float* spectrum_im, float* out_re, float* out_im);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::sea
