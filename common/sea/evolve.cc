#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/evolve.cc"
#include "hwy/foreach_target.h"
//
#include <cstddef>
#include <cstdint>

#include "common/sea/evolve.h"
#include "common/sea/fft_strip.h"
#include "common/sea/sincos-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kStripLanes>;
using V = hn::Vec<D>;

void EvolveDense(Evolver::Dense& dense) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  for (std::size_t n = 0; n < dense.count; n += hn::Lanes(d)) {
    V sine_plus, cosine_plus, sine_minus, cosine_minus;
    SinCosTurns(d, hn::Load(du, dense.turns.get() + n), sine_plus, cosine_plus);
    SinCosTurns(d, hn::Load(du, dense.turns.get() + dense.count + n), sine_minus, cosine_minus);
    const V plus = hn::Load(d, dense.half_amplitude.get() + n);
    const V minus = hn::Load(d, dense.half_amplitude.get() + dense.count + n);
    const V plus_re = hn::Mul(plus, cosine_plus), plus_im = hn::Mul(plus, sine_plus);
    const V minus_re = hn::Mul(minus, cosine_minus), minus_im = hn::Mul(minus, sine_minus);
    hn::Store(hn::Add(plus_re, minus_re), d, dense.even_re.get() + n);
    hn::Store(hn::Sub(plus_im, minus_im), d, dense.even_im.get() + n);
    if (dense.needs_odd) {
      hn::Store(hn::Sub(plus_re, minus_re), d, dense.odd_re.get() + n);
      hn::Store(hn::Add(plus_im, minus_im), d, dense.odd_im.get() + n);
    }
  }
}

HWY_INLINE void LoadField(const Evolver::FieldSource& source, std::size_t n, V& re, V& im) {
  const D d;
  if (source.factor == nullptr) {
    re = im = hn::Zero(d);
    return;
  }
  const V c = hn::Load(d, source.factor + n);
  const V a = hn::Mul(c, hn::Load(d, source.re + n));
  const V b = hn::Mul(c, hn::Load(d, source.im + n));
  re = source.imaginary ? hn::Neg(b) : a;
  im = source.imaginary ? a : b;
}

// Z(k) = F(k) + iG(k) into the row of i, Z(-k) = conj F(k) + i conj G(k) into the row of -i,
// backwards. The backward stores of a row's padding lanes fall into the padding of the row before
// it; they are zeros on zeros.
void PackDense(const Evolver::FieldSource& f, const Evolver::FieldSource& g, int index_max,
               std::size_t pitch, float* re, float* im) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  for (int i = 0; i <= index_max; ++i) {
    float* row_re = re + static_cast<std::size_t>(index_max + i) * pitch;
    float* row_im = im + static_cast<std::size_t>(index_max + i) * pitch;
    float* mirror_re = re + static_cast<std::size_t>(index_max - i) * pitch;
    float* mirror_im = im + static_cast<std::size_t>(index_max - i) * pitch;
    for (std::size_t l = 0; l < pitch; l += lanes) {
      V f_re, f_im, g_re, g_im;
      const std::size_t n = static_cast<std::size_t>(i) * pitch + l;
      LoadField(f, n, f_re, f_im);
      LoadField(g, n, g_re, g_im);
      hn::Store(hn::Sub(f_re, g_im), d, row_re + l);
      hn::Store(hn::Add(f_im, g_re), d, row_im + l);
      if (i == 0) continue;  // the row of i = 0 is its own mirror and already complete
      const std::ptrdiff_t at = 2 * index_max - static_cast<std::ptrdiff_t>(l + lanes - 1);
      hn::StoreU(hn::Reverse(d, hn::Add(f_re, g_im)), d, mirror_re + at);
      hn::StoreU(hn::Reverse(d, hn::Sub(g_re, f_im)), d, mirror_im + at);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/check.h"
#include "common/sea/spline.h"
#include "common/sea/wave_frame.h"

namespace onesea::sea {
HWY_EXPORT(EvolveDense);
HWY_EXPORT(PackDense);

namespace {

constexpr FieldSet kOddFields = kVelocityFields;
constexpr FieldSet kImaginaryFields = Bit(Field::kDisplacementX) | Bit(Field::kDisplacementY) |
                                      Bit(Field::kSlopeX) | Bit(Field::kSlopeY) |
                                      Bit(Field::kVelocityZ);

// The real number c or c/i of a field on the wave (kx, ky); see the class comment.
double FieldFactor(Field field, double kx, double ky, double sigma, double choppiness,
                   double coth) {
  const double k = std::sqrt(kx * kx + ky * ky);
  switch (field) {
    case Field::kHeight:
      return 1.0;
    case Field::kDisplacementX:
      return choppiness * (kx / k);
    case Field::kDisplacementY:
      return choppiness * (ky / k);
    case Field::kSlopeX:
      return kx;
    case Field::kSlopeY:
      return ky;
    case Field::kJacobianXX:
      return -choppiness * (kx * (kx / k));
    case Field::kJacobianYY:
      return -choppiness * (ky * (ky / k));
    case Field::kJacobianXY:
      return -choppiness * (kx * (ky / k));
    case Field::kVelocityX:
      return sigma * coth * (kx / k);
    case Field::kVelocityY:
      return sigma * coth * (ky / k);
    case Field::kVelocityZ:
      return -sigma;
  }
  ONESEA_CHECK(false) << "field " << static_cast<int>(field);
  return 0.0;
}

}  // namespace

Evolver::Evolver(std::shared_ptr<const Components> components, int cascade, int grid_size,
                 FieldSet fields, PlaneKind planes)
    : components_(std::move(components)), waves_(components_->cascades[cascade]) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t n = 0; n < waves_.i.size(); ++n) {
    const int index = std::max(std::abs(int{waves_.i[n]}), std::abs(int{waves_.j[n]}));
    if (index < grid_size / 2) {
      kept.push_back(n);
      index_max_ = std::max(index_max_, index);
    } else {
      omitted_.push_back(n);
    }
  }
  pitch_ = StripTransform::PitchFor(index_max_);
  dense_.count = static_cast<std::size_t>(index_max_ + 1) * static_cast<std::size_t>(pitch_);
  for (FloatArray* array : {&dense_.even_re, &dense_.even_im, &dense_.odd_re, &dense_.odd_im}) {
    *array = AllocateZeros<float>(dense_.count);
  }
  dense_.half_amplitude = AllocateZeros<float>(2 * dense_.count);
  dense_.turns = AllocateZeros<std::uint32_t>(2 * dense_.count);
  dense_.needs_odd = (fields & kOddFields) != 0;
  for (int f = 0; f < kFieldCount; ++f) {
    if ((fields >> f & 1) != 0) factors_[f] = AllocateZeros<float>(dense_.count);
  }
  for (std::uint32_t n : kept) {
    const double gain = planes == PlaneKind::kSamples
                            ? 1.0
                            : 1.0 / (SplineResponse(waves_.i[n], grid_size) *
                                     SplineResponse(waves_.j[n], grid_size));
    if (waves_.i[n] >= 0) AddEntry(n, +1, gain);
    if (waves_.i[n] <= 0) AddEntry(n, -1, gain);
  }
  weights_.assign(components_->recipe.timeline.size(), -1.0);
  new_weights_ = weights_;
}

void Evolver::AddEntry(std::uint32_t wave, int sign, double gain) {
  const std::size_t element =
      static_cast<std::size_t>(sign * waves_.i[wave] * pitch_ + sign * waves_.j[wave] + index_max_);
  entries_.push_back(
      {.turns_per_flick = waves_.turns_per_flick[wave],
       .phase = std::uint64_t{waves_.phase_turns[wave]} << 32,
       .wave = wave,
       .slot = static_cast<std::uint32_t>(sign > 0 ? element : element + dense_.count)});
  const double kx = sign * double{waves_.kx_rad_per_m[wave]};
  const double ky = sign * double{waves_.ky_rad_per_m[wave]};
  const double decay = DepthDecay(std::sqrt(kx * kx + ky * ky), components_->recipe.depth_m);
  const double coth = (1.0 + decay) / (1.0 - decay);
  for (int f = 0; f < kFieldCount; ++f) {
    if (!factors_[f]) continue;
    factors_[f][element] = static_cast<float>(
        gain * FieldFactor(static_cast<Field>(f), kx, ky, waves_.intrinsic_rad_per_s[wave],
                           components_->recipe.choppiness, coth));
  }
}

void Evolver::UpdateAmplitudes() {
  for (const Entry& entry : entries_) {
    double variance_m2 = 0.0;
    for (std::size_t m = 0; m < weights_.size(); ++m)
      variance_m2 += weights_[m] * waves_.variance_m2[m][entry.wave];
    dense_.half_amplitude[entry.slot] = static_cast<float>(0.5 * std::sqrt(2.0 * variance_m2));
  }
}

void Evolver::SetTime(SimTime time) {
  WeatherWeights(components_->recipe, time, new_weights_);
  if (new_weights_ != weights_) {
    std::swap(weights_, new_weights_);
    UpdateAmplitudes();
  }
  const auto flicks = static_cast<std::uint64_t>(time.flicks);
  for (const Entry& entry : entries_) {
    const std::uint64_t turns =
        entry.phase - entry.turns_per_flick * flicks;  // wraps: whole turns fall away
    dense_.turns[entry.slot] = static_cast<std::uint32_t>(turns >> 32);
  }
  HWY_DYNAMIC_DISPATCH(EvolveDense)(dense_);
}

void Evolver::Pack(Field f, std::optional<Field> g, float* re, float* im) {
  const auto source = [this](Field field) {
    const FieldSet bit = Bit(field);
    const float* factor = factors_[static_cast<int>(field)].get();
    ONESEA_CHECK(factor != nullptr) << "field " << static_cast<int>(field) << " was not asked for";
    const bool odd = (bit & kOddFields) != 0;
    return FieldSource{.re = (odd ? dense_.odd_re : dense_.even_re).get(),
                       .im = (odd ? dense_.odd_im : dense_.even_im).get(),
                       .factor = factor,
                       .imaginary = (bit & kImaginaryFields) != 0};
  };
  HWY_DYNAMIC_DISPATCH(PackDense)
  (source(f), g.has_value() ? source(*g) : FieldSource{}, index_max_,
   static_cast<std::size_t>(pitch_), re, im);
}

double Evolver::OmittedVariance(SimTime time) const {
  std::vector<double> weights(weights_.size());
  WeatherWeights(components_->recipe, time, weights);
  double sum_m2 = 0.0;
  for (std::uint32_t n : omitted_) {
    for (std::size_t m = 0; m < weights.size(); ++m)
      sum_m2 += weights[m] * waves_.variance_m2[m][n];
  }
  return sum_m2;
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
