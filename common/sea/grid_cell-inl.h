// The cell of a periodic grid that a place lies in. Included once per SIMD target.

#if defined(ONESEA_SEA_GRID_CELL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_SEA_GRID_CELL_INL_H_
#undef ONESEA_SEA_GRID_CELL_INL_H_
#else
#define ONESEA_SEA_GRID_CELL_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// World points to cells of one cascade's grid; in double, since places may lie far out.
class GridCells {
 public:
  using DD = hn::CappedTag<double, 8>;
  using VD = hn::Vec<DD>;

  HWY_INLINE GridCells(double cosine, double sine, double cells_per_m, int grid_size)
      : cosine_(hn::Set(DD(), cosine)),
        sine_(hn::Set(DD(), sine)),
        cells_per_m_(hn::Set(DD(), cells_per_m)),
        size_(hn::Set(DD(), static_cast<double>(grid_size))),
        inverse_size_(hn::Set(DD(), 1.0 / grid_size)) {}

  // Cell index in [0, grid_size) and place within the cell in [0, 1), along both axes.
  HWY_INLINE void Place(VD x, VD y, float* frac_u, std::int32_t* cell_u, float* frac_v,
                        std::int32_t* cell_v) const {
    Wrap(hn::Add(hn::Mul(cosine_, x), hn::Mul(sine_, y)), frac_u, cell_u);
    Wrap(hn::Sub(hn::Mul(cosine_, y), hn::Mul(sine_, x)), frac_v, cell_v);
  }

 private:
  HWY_INLINE void Wrap(VD along_m, float* frac, std::int32_t* cell) const {
    const hn::Rebind<float, DD> df;
    const hn::Rebind<std::int32_t, DD> di;
    const VD u = hn::Mul(cells_per_m_, along_m);
    const VD whole = hn::Floor(u);
    const VD wrapped = hn::Sub(whole, hn::Mul(size_, hn::Floor(hn::Mul(whole, inverse_size_))));
    hn::Store(hn::DemoteTo(df, hn::Sub(u, whole)), df, frac);
    hn::Store(hn::DemoteTo(di, wrapped), di, cell);
  }

  VD cosine_, sine_, cells_per_m_, size_, inverse_size_;
};

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
