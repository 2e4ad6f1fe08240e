// Vectors of three, a lane each. Included once per SIMD target; see Highway's foreach_target.h.
#if defined(ONESEA_WORLD_WET_VECTOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_WORLD_WET_VECTOR_INL_H_
#undef ONESEA_WORLD_WET_VECTOR_INL_H_
#else
#define ONESEA_WORLD_WET_VECTOR_INL_H_
#endif

#include "common/base/vec.h"
#include "hwy/highway.h"
#include "server/world/wet_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace wet {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kWetBlock>;
using V = hn::Vec<D>;

struct Vec3v {
  HWY_INLINE Vec3v() {}  // an implicit one would not get the target's attributes
  HWY_INLINE Vec3v(V a, V b, V c) : x(a), y(b), z(c) {}
  V x, y, z;
};
HWY_INLINE Vec3v Sum(Vec3v a, Vec3v b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vec3v Difference(Vec3v a, Vec3v b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vec3v Scaled(V s, Vec3v a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE V Product(Vec3v a, Vec3v b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vec3v CrossOf(Vec3v a, Vec3v b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Vec3v SetAll(Vec3d v) {
  const D d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

}  // namespace wet
}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#endif  // per target
