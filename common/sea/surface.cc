#include "common/sea/surface.h"

#include <bit>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/evolve.h"
#include "common/sea/fft_fftw.h"
#include "common/sea/fft_strip.h"

namespace onesea::sea {

CascadeFields::CascadeFields(int grid_size, FieldSet fields)
    : grid_size_(grid_size), fields_(fields) {
  ONESEA_CHECK(grid_size >= kGridSizeMin && grid_size <= kGridSizeMax &&
               std::has_single_bit(unsigned(grid_size)))
      << "grid size " << grid_size;
  ONESEA_CHECK(fields != 0 && fields >> kFieldCount == 0) << "fields " << fields;
  planes_ = AllocateZeros<float>(plane_floats() * static_cast<std::size_t>(std::popcount(fields)));
}

std::span<const float> CascadeFields::Plane(Field field) const {
  ONESEA_CHECK(Has(field)) << "field " << static_cast<int>(field);
  const int before = std::popcount(fields_ & (Bit(field) - 1));
  return {planes_.get() + before * plane_floats(), plane_floats()};
}

std::span<float> CascadeFields::MutablePlane(Field field) {
  const std::span<const float> plane = Plane(field);
  return {const_cast<float*>(plane.data()), plane.size()};
}

struct Synthesiser::Impl {
  Impl(std::shared_ptr<const Components> components, int cascade, int grid_size, FieldSet fields,
       PlaneKind planes)
      : fields(fields), evolver(std::move(components), cascade, grid_size, fields, planes) {}

  struct Pair {
    Field real_part;
    std::optional<Field> imaginary_part;
  };

  FieldSet fields;
  int grid_size = 0;
  Evolver evolver;
  std::vector<Pair> pairs;
  FloatArray spectrum_memory;
  float* spectrum_re = nullptr;
  float* spectrum_im = nullptr;
  FloatArray unused_plane;  // where the other half of an odd field goes
  std::unique_ptr<StripTransform> own;
  std::unique_ptr<FftwTransform> fftw;
};

Synthesiser::Synthesiser(std::shared_ptr<const Components> components, int cascade, int grid_size,
                         FieldSet fields, TransformKind transform, PlaneKind planes) {
  ONESEA_CHECK(components != nullptr);
  ONESEA_CHECK(cascade >= 0 && cascade < static_cast<int>(components->cascades.size()))
      << "cascade " << cascade;
  ONESEA_CHECK(grid_size >= kGridSizeMin && grid_size <= kGridSizeMax &&
               std::has_single_bit(unsigned(grid_size)))
      << "grid size " << grid_size;
  ONESEA_CHECK(fields != 0 && fields >> kFieldCount == 0) << "fields " << fields;
  ONESEA_CHECK(TransformAvailable(transform))
      << "this build has no FFTW: configure with -DONESEA_WITH_FFTW=ON or use the own transform";

  impl_ = std::make_unique<Impl>(std::move(components), cascade, grid_size, fields, planes);
  impl_->grid_size = grid_size;
  std::vector<Field> list;
  for (int f = 0; f < kFieldCount; ++f) {
    if ((fields >> f & 1) != 0) list.push_back(static_cast<Field>(f));
  }
  for (std::size_t n = 0; n < list.size(); n += 2) {
    impl_->pairs.push_back(
        {list[n], n + 1 < list.size() ? std::optional(list[n + 1]) : std::nullopt});
  }
  if (list.size() % 2 == 1)
    impl_->unused_plane = AllocateZeros<float>(static_cast<std::size_t>(grid_size) * grid_size);
  const std::size_t room = impl_->evolver.spectrum_floats() + kStripLanes;
  impl_->spectrum_memory = AllocateZeros<float>(2 * room);
  impl_->spectrum_re = impl_->spectrum_memory.get() + kStripLanes;
  impl_->spectrum_im = impl_->spectrum_re + room;
  if (transform == TransformKind::kOwn) {
    impl_->own = std::make_unique<StripTransform>(grid_size, impl_->evolver.index_max());
  } else {
    impl_->fftw = std::make_unique<FftwTransform>(grid_size, impl_->evolver.index_max());
  }
}

Synthesiser::~Synthesiser() = default;
Synthesiser::Synthesiser(Synthesiser&&) noexcept = default;
Synthesiser& Synthesiser::operator=(Synthesiser&&) noexcept = default;

void Synthesiser::Evaluate(SimTime time, CascadeFields& out) {
  Impl& impl = *impl_;
  ONESEA_CHECK(out.grid_size() == impl.grid_size && out.fields() == impl.fields)
      << "planes of " << out.grid_size() << " and fields " << out.fields()
      << " for a synthesiser of " << impl.grid_size << " and " << impl.fields;
  impl.evolver.SetTime(time);
  for (const Impl::Pair& pair : impl.pairs) {
    impl.evolver.Pack(pair.real_part, pair.imaginary_part, impl.spectrum_re, impl.spectrum_im);
    float* out_re = out.MutablePlane(pair.real_part).data();
    float* out_im = pair.imaginary_part ? out.MutablePlane(*pair.imaginary_part).data()
                                        : impl.unused_plane.get();
    if (impl.own) {
      impl.own->Inverse(impl.spectrum_re, impl.spectrum_im, out_re, out_im);
    } else {
      impl.fftw->Inverse(impl.spectrum_re, impl.spectrum_im, out_re, out_im);
    }
  }
}

double Synthesiser::OmittedVariance(SimTime time) const {
  return impl_->evolver.OmittedVariance(time);
}

bool TransformAvailable(TransformKind kind) {
  return kind == TransformKind::kOwn ||
         (kind == TransformKind::kFftw && FftwTransform::Available());
}

std::string TransformName(TransformKind kind) {
  ONESEA_CHECK(TransformAvailable(kind)) << "transform " << static_cast<int>(kind);
  return kind == TransformKind::kOwn ? "own" : FftwTransform::Name();
}

}  // namespace onesea::sea
