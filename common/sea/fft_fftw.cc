#include "common/sea/fft_fftw.h"

#include "common/base/check.h"

#ifdef ONESEA_WITH_FFTW
#include <fftw3.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "common/base/hash.h"
#include "common/sea/fft_strip.h"

namespace onesea::sea {

namespace {

// FFTW's planner has global state. A flag, since this room knows no threads; it is held for
// microseconds.
class PlannerLock {
 public:
  PlannerLock() {
    while (Flag().test_and_set(std::memory_order_acquire)) Flag().wait(true);
  }
  ~PlannerLock() {
    Flag().clear(std::memory_order_release);
    Flag().notify_one();
  }
  PlannerLock(const PlannerLock&) = delete;
  PlannerLock& operator=(const PlannerLock&) = delete;

 private:
  static std::atomic_flag& Flag() {
    static std::atomic_flag flag;
    return flag;
  }
};

// Powers of two as row strides share few cache sets: FFTW is 20-30 % faster on padded rows.
constexpr int kRowPadding = 8;

}  // namespace

struct FftwTransform::Impl {
  int grid_size;
  int index_max;
  int pitch;
  fftwf_complex* grid;
  fftwf_plan plan;
};

bool FftwTransform::Available() { return true; }

std::string FftwTransform::Name() {
  // No wisdom is stored: what FFTW_ESTIMATE chooses depends on the library and the instruction set
  // alone. The exported wisdom stands for both.
  PlannerLock lock;
  char* wisdom = fftwf_export_wisdom_to_string();
  Hash64 hash;
  if (wisdom != nullptr) hash.Add(std::string_view(wisdom));
  std::free(wisdom);
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return std::string(fftwf_version) + " wisdom " + text;
}

FftwTransform::FftwTransform(int grid_size, int index_max) : impl_(std::make_unique<Impl>()) {
  PlannerLock lock;
  const int pitch = grid_size + kRowPadding;
  fftwf_complex* grid = fftwf_alloc_complex(static_cast<std::size_t>(grid_size) * pitch);
  ONESEA_CHECK(grid != nullptr) << "out of memory";
  const int sizes[2] = {grid_size, grid_size};
  const int padded[2] = {grid_size, pitch};
  fftwf_plan plan = fftwf_plan_many_dft(2, sizes, 1, grid, padded, 1, 0, grid, padded, 1, 0,
                                        FFTW_BACKWARD, FFTW_ESTIMATE);
  ONESEA_CHECK(plan != nullptr) << "FFTW made no plan for " << grid_size;
  *impl_ = {grid_size, index_max, pitch, grid, plan};
}

FftwTransform::~FftwTransform() {
  PlannerLock lock;
  fftwf_destroy_plan(impl_->plan);
  fftwf_free(impl_->grid);
}

void FftwTransform::Inverse(const float* spectrum_re, const float* spectrum_im, float* out_re,
                            float* out_im) {
  const Impl& impl = *impl_;
  const int n = impl.grid_size;
  float* grid = &impl.grid[0][0];
  std::fill_n(grid, 2 * static_cast<std::size_t>(n) * impl.pitch, 0.0f);
  const int pitch_in = StripTransform::PitchFor(impl.index_max);
  for (int i = -impl.index_max; i <= impl.index_max; ++i) {
    for (int j = -impl.index_max; j <= impl.index_max; ++j) {
      const std::size_t from =
          static_cast<std::size_t>(i + impl.index_max) * pitch_in + (j + impl.index_max);
      const std::size_t to = static_cast<std::size_t>(j & (n - 1)) * impl.pitch + (i & (n - 1));
      grid[2 * to] = spectrum_re[from];
      grid[2 * to + 1] = spectrum_im[from];
    }
  }
  fftwf_execute(impl.plan);
  for (int y = 0; y < n; ++y) {
    const float* row = grid + 2 * static_cast<std::size_t>(y) * impl.pitch;
    for (int x = 0; x < n; ++x) {
      out_re[static_cast<std::size_t>(y) * n + x] = row[2 * x];
      out_im[static_cast<std::size_t>(y) * n + x] = row[2 * x + 1];
    }
  }
}

}  // namespace onesea::sea

#else

namespace onesea::sea {

struct FftwTransform::Impl {};

bool FftwTransform::Available() { return false; }
std::string FftwTransform::Name() { return {}; }
FftwTransform::FftwTransform(int, int) { ONESEA_CHECK(false) << "built without ONESEA_WITH_FFTW"; }
FftwTransform::~FftwTransform() = default;
void FftwTransform::Inverse(const float*, const float*, float*, float*) {}

}  // namespace onesea::sea

#endif
