#include "common/sea/fft_fftw.h"

#include "common/base/check.h"

#ifdef ONESEA_WITH_FFTW
#include <fftw3.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "common/base/hash.h"
#include "common/base/limits.h"
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

// Hash of the wisdom in use, 0: none. Written before the first plan (UseWisdom's contract).
std::atomic<std::uint64_t> wisdom_hash = 0;

// Powers of two as row strides share few cache sets: FFTW is 20-30 % faster on padded rows.
constexpr int kRowPadding = 8;

int PitchFor(int grid_size) { return grid_size + kRowPadding; }

fftwf_complex* AllocateGrid(int grid_size) {
  fftwf_complex* grid =
      fftwf_alloc_complex(static_cast<std::size_t>(grid_size) * PitchFor(grid_size));
  ONESEA_CHECK(grid != nullptr) << "out of memory";
  return grid;
}

// Null if `flags` ask for wisdom that is not there.
fftwf_plan MakePlan(int grid_size, fftwf_complex* grid, unsigned flags) {
  const int sizes[2] = {grid_size, grid_size};
  const int padded[2] = {grid_size, PitchFor(grid_size)};
  return fftwf_plan_many_dft(2, sizes, 1, grid, padded, 1, 0, grid, padded, 1, 0, FFTW_BACKWARD,
                             flags);
}

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
  const std::uint64_t hash = wisdom_hash.load();
  if (hash == 0) return std::string(fftwf_version) + " estimate";
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return std::string(fftwf_version) + " wisdom " + text;
}

std::string FftwTransform::MeasureWisdom(int grid_size_max) {
  PlannerLock lock;
  for (int n = kGridSizeMin; n <= grid_size_max; n *= 2) {
    fftwf_complex* grid = AllocateGrid(n);
    fftwf_destroy_plan(MakePlan(n, grid, FFTW_PATIENT));
    fftwf_free(grid);
  }
  char* wisdom = fftwf_export_wisdom_to_string();
  ONESEA_CHECK(wisdom != nullptr) << "out of memory";
  std::string text = wisdom;
  std::free(wisdom);
  return text;
}

absl::Status FftwTransform::UseWisdom(const std::string& wisdom) {
  PlannerLock lock;
  if (fftwf_import_wisdom_from_string(wisdom.c_str()) == 0) {
    return absl::InvalidArgumentError(std::string("is no wisdom of ") + fftwf_version +
                                      "; measure it anew on this machine");
  }
  Hash64 hash;
  hash.Add(std::string_view(wisdom));
  wisdom_hash = hash.value();
  return absl::OkStatus();
}

FftwTransform::FftwTransform(int grid_size, int index_max) : impl_(std::make_unique<Impl>()) {
  PlannerLock lock;
  fftwf_complex* grid = AllocateGrid(grid_size);
  fftwf_plan plan = MakePlan(grid_size, grid, FFTW_PATIENT | FFTW_WISDOM_ONLY);
  if (plan == nullptr) plan = MakePlan(grid_size, grid, FFTW_ESTIMATE);
  ONESEA_CHECK(plan != nullptr) << "FFTW made no plan for " << grid_size;
  *impl_ = {grid_size, index_max, PitchFor(grid_size), grid, plan};
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
std::string FftwTransform::MeasureWisdom(int) { return {}; }
absl::Status FftwTransform::UseWisdom(const std::string&) {
  return absl::UnimplementedError("this program was built without FFTW");
}
FftwTransform::FftwTransform(int, int) { ONESEA_CHECK(false) << "built without ONESEA_WITH_FFTW"; }
FftwTransform::~FftwTransform() = default;
void FftwTransform::Inverse(const float*, const float*, float*, float*) {}

}  // namespace onesea::sea

#endif
