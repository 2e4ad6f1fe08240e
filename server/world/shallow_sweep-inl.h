// One sweep of a strip of lines, lines as lanes: eliminate, substitute, move the water. Included
// once per SIMD target.

#if defined(ONESEA_WORLD_SHALLOW_SWEEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ONESEA_WORLD_SHALLOW_SWEEP_INL_H_
#undef ONESEA_WORLD_SHALLOW_SWEEP_INL_H_
#else
#define ONESEA_WORLD_SHALLOW_SWEEP_INL_H_
#endif

#include <cstddef>

#include "common/sea/constants.h"
#include "hwy/highway.h"
#include "server/world/shallow_water_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::world {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

// Lines n and n + kHalf of a strip go through the recurrences side by side, to hide latencies and
// to share a division; the same two on every target, since that changes their last bits.
constexpr int kPair = 2;
constexpr std::size_t kHalf = kStripLines / kPair;
// Numbers smaller than this become zero; left alone they decay into slow subnormal ones.
constexpr float kTiny = 1e-15f;

// Friction of sheets thinner than this.
constexpr float kSheetDepthM = 0.1f;
constexpr float kSheetDrag = 0.0025f;

struct Line {
  float* level;
  const float* bottom;
  float* velocity;        // through the face after each cell
  const float* pressure;  // unused unless forced
  const float* solid;
  std::size_t pressure_stride;
  float* height;  // null, or where the level of wet cells goes
  std::size_t height_stride;
  std::size_t stride;  // from cell to cell of level, bottom, velocity
  int cells;
  const float* keep_along;   // (cells)
  const float* keep_across;  // (kStripLines)
};

struct Numbers {
  explicit Numbers(const ShallowFields& f, bool held)
      : step(f.step_per_cell),
        theta(f.theta),
        gravity_step(static_cast<float>(sea::kGravity) * f.step_per_cell),
        coupling(f.theta * f.theta * gravity_step * f.step_per_cell),
        keep_velocity(f.keep_velocity),
        velocity_max(f.velocity_max),
        sheet_drag(kSheetDrag * f.step_s),
        open(f.open),
        held(held ? 1.0f : 0.0f) {}
  float step, theta, gravity_step, coupling, keep_velocity, velocity_max, sheet_drag;
  bool open;
  float held;
};

HWY_INLINE V WithoutTiny(V x) {
  const D d;
  return hn::IfThenElseZero(hn::Gt(hn::Abs(x), hn::Set(d, kTiny)), x);
}

// What a cell brings to the equations of its two faces.
struct Cell {
  V level, bottom, pressure, free;
};

template <bool kForced>
HWY_INLINE Cell LoadCell(const Line& line, std::size_t i, std::size_t lane) {
  const D d;
  Cell cell;
  cell.level = hn::LoadU(d, line.level + i * line.stride + lane);
  cell.bottom = hn::LoadU(d, line.bottom + i * line.stride + lane);
  if constexpr (kForced) {
    cell.pressure = hn::LoadU(d, line.pressure + i * line.pressure_stride + lane);
    cell.free =
        hn::Sub(hn::Set(d, 1.0f), hn::LoadU(d, line.solid + i * line.pressure_stride + lane));
  } else {
    cell.pressure = hn::Zero(d);
    cell.free = hn::Set(d, 1.0f);
  }
  return cell;
}

// Speed at which a wave leaves through an outer face: sqrt(g H), 0 for a wall.
HWY_INLINE V LeavingSpeed(const Numbers& n, const Cell& cell) {
  const D d;
  if (!n.open) return hn::Zero(d);
  const V depth = hn::Sub(cell.level, cell.bottom);
  return hn::Sqrt(hn::Mul(hn::Set(d, static_cast<float>(sea::kGravity)), depth));
}

struct Face {
  V depth;   // of the flow
  V marked;  // the same, but -1 where the face is dry
  V push;    // g dt times the gradient of the head
};

// Water runs over the higher of the two grounds. Where the bottom is smooth the depth is that of
// the level upstream over the mean of the grounds; the weir's own depth bounds it, so that a pool
// behind a ridge stays there.
template <bool kForced>
HWY_INLINE Face FaceBetween(const Numbers& n, const Cell& a, const Cell& b, V velocity) {
  const D d;
  const V bed = hn::Max(a.bottom, b.bottom);
  const V head_a = hn::Max(a.level, bed), head_b = hn::Max(b.level, bed);
  const V weir = hn::Sub(hn::Max(head_a, head_b), bed);
  const V upstream = hn::IfThenElse(hn::Gt(velocity, hn::Zero(d)), a.level, b.level);
  const V mean_bed = hn::Mul(hn::Set(d, 0.5f), hn::Add(a.bottom, b.bottom));
  V depth = hn::Min(hn::Sub(upstream, mean_bed), hn::Add(weir, weir));
  V rise = hn::Sub(head_b, head_a);
  if constexpr (kForced) {
    rise = hn::Add(rise, hn::Sub(b.pressure, a.pressure));
    depth = hn::Mul(depth, hn::Max(hn::Min(a.free, b.free), hn::Set(d, n.held)));
  }
  depth = hn::Max(depth, hn::Zero(d));
  const auto wet = hn::Gt(weir, hn::Set(d, kFilmDepthM));
  return {hn::IfThenElseZero(wet, depth), hn::IfThenElse(wet, depth, hn::Set(d, -1.0f)),
          hn::Mul(hn::Set(d, n.gravity_step), rise)};
}

// Forward elimination of the tridiagonal system of the rise of the level in this step: on return
// rise[i] = offset[i] + gain[i] rise[i + 1]. Also leaves the depth of the faces and the velocity
// that the present level gives them.
template <bool kForced>
HWY_INLINE void Eliminate(const Numbers& n, const Line& line, ShallowFields& f, std::size_t lane) {
  const D d;
  const V one = hn::Set(d, 1.0f), step = hn::Set(d, n.step), theta = hn::Set(d, n.theta);
  const V coupling = hn::Set(d, n.coupling), step_theta = hn::Mul(step, theta);
  const V row_least = hn::Set(d, 1.0f - n.held);
  const std::size_t cells = line.cells;
  Cell cell[kPair];
  V before[kPair], gain[kPair], offset[kPair], inflow[kPair], leaving[kPair];
  for (int k = 0; k < kPair; ++k) {
    cell[k] = LoadCell<kForced>(line, 0, lane + k * kHalf);
    leaving[k] = LeavingSpeed(n, cell[k]);
    inflow[k] = hn::Neg(hn::Mul(leaving[k], cell[k].level));
    before[k] = gain[k] = offset[k] = hn::Zero(d);
  }
  for (std::size_t i = 0; i < cells; ++i) {
    V left[kPair], right[kPair], rise[kPair], pivot[kPair];
    for (int k = 0; k < kPair; ++k) {
      const std::size_t own = lane + k * kHalf, at = i * kStripLines + own;
      V after = hn::Zero(d), outflow;
      Cell next = cell[k];
      if (i + 1 < cells) {
        next = LoadCell<kForced>(line, i + 1, own);
        const V velocity = hn::LoadU(d, line.velocity + i * line.stride + own);
        const Face face = FaceBetween<kForced>(n, cell[k], next, velocity);
        outflow = hn::Mul(face.depth, hn::Sub(velocity, hn::Mul(theta, face.push)));
        after = hn::Mul(coupling, face.depth);
        hn::Store(face.marked, d, f.depth.get() + at);
        hn::Store(hn::Sub(velocity, face.push), d, f.moved.get() + at);
      } else {
        leaving[k] = LeavingSpeed(n, cell[k]);
        outflow = hn::Mul(leaving[k], cell[k].level);
      }
      left[k] = before[k];
      right[k] = after;
      rise[k] = hn::Mul(step, hn::Sub(inflow[k], outflow));
      V own_part = one;
      if (i == 0 || i + 1 == cells) own_part = hn::Add(one, hn::Mul(step_theta, leaving[k]));
      if constexpr (kForced) {
        const V row = hn::Max(cell[k].free, row_least);
        left[k] = hn::Mul(row, left[k]);
        right[k] = hn::Mul(row, right[k]);
        rise[k] = hn::Mul(row, rise[k]);
      }
      const V diagonal = hn::Add(own_part, hn::Add(left[k], right[k]));
      pivot[k] = hn::Sub(diagonal, hn::Mul(left[k], gain[k]));
      inflow[k] = outflow;
      before[k] = after;
      cell[k] = next;
    }
    const V both = hn::Div(one, hn::Mul(pivot[0], pivot[1]));
    for (int k = 0; k < kPair; ++k) {
      const std::size_t at = i * kStripLines + lane + k * kHalf;
      const V inverse = hn::Mul(both, pivot[1 - k]);
      gain[k] = hn::Mul(right[k], inverse);
      offset[k] = WithoutTiny(hn::Mul(hn::Add(rise[k], hn::Mul(left[k], offset[k])), inverse));
      hn::Store(gain[k], d, f.gain.get() + at);
      hn::Store(offset[k], d, f.offset.get() + at);
    }
  }
}

// The flux through an outer face, that of the waves which leave there.
HWY_INLINE void StoreOutflow(const Numbers& n, const Line& line, ShallowFields& f, std::size_t i,
                             std::size_t face, std::size_t lane, V rise, bool west) {
  const D d;
  const Cell cell = LoadCell<false>(line, i, lane);
  const V flux =
      hn::Mul(LeavingSpeed(n, cell), hn::Add(cell.level, hn::Mul(hn::Set(d, n.theta), rise)));
  hn::Store(west ? hn::Neg(flux) : flux, d, f.flux.get() + face * kStripLines + lane);
}

// A thin sheet is slowed by the ground: u' = -C |u| u / H, implicitly. Nothing moves at H = 0.
HWY_INLINE V SlowSheet(const Numbers& n, V depth, V velocity) {
  const D d;
  const V drag = hn::Mul(hn::Set(d, n.sheet_drag), hn::Abs(velocity));
  const V share = hn::Div(depth, hn::Max(hn::Add(depth, drag), hn::Set(d, kFilmDepthM)));
  const auto sheet = hn::Lt(depth, hn::Set(d, kSheetDepthM));
  return hn::IfThenElse(sheet, hn::Mul(share, velocity), velocity);
}

// What a dry face has when water gets there: the velocity of the wet face behind it. (Advection
// would carry it there; without it a front would start from rest in every cell.)
HWY_INLINE V Inherit(V west_depth, V west, V east_depth, V east) {
  const D d;
  const V zero = hn::Zero(d);
  const V from_west = hn::IfThenElseZero(hn::Gt(west_depth, zero), hn::Max(west, zero));
  const V from_east = hn::IfThenElseZero(hn::Gt(east_depth, zero), hn::Min(east, zero));
  return hn::Add(from_west, from_east);
}

// Back substitution: the new velocity of every face, and the flux through it during the step.
HWY_INLINE void Substitute(const Numbers& n, const Line& line, ShallowFields& f, std::size_t lane) {
  const D d;
  const std::size_t cells = line.cells;
  const V zero = hn::Zero(d), theta = hn::Set(d, n.theta), rest = hn::Set(d, 1.0f - n.theta);
  const V pull = hn::Mul(theta, hn::Set(d, n.gravity_step));
  V rise[kPair], depth[kPair], old[kPair], east_depth[kPair], east_old[kPair];
  for (int k = 0; k < kPair; ++k) {
    const std::size_t own = lane + k * kHalf, last = cells - 1;
    rise[k] = hn::Load(d, f.offset.get() + last * kStripLines + own);
    StoreOutflow(n, line, f, last, cells, own, rise[k], false);
    east_depth[k] = east_old[k] = zero;
    depth[k] = hn::Load(d, f.depth.get() + (last - 1) * kStripLines + own);
    old[k] = hn::LoadU(d, line.velocity + (last - 1) * line.stride + own);
  }
  for (std::size_t i = cells - 1; i-- > 0;) {
    const V keep = hn::Set(d, line.keep_along[i] * n.keep_velocity);
    for (int k = 0; k < kPair; ++k) {
      const std::size_t own = lane + k * kHalf, at = i * kStripLines + own;
      const V next = rise[k];
      rise[k] =
          hn::Add(hn::Load(d, f.offset.get() + at), hn::Mul(hn::Load(d, f.gain.get() + at), next));
      V west_depth = zero, west_old = zero;
      if (i > 0) {
        west_depth = hn::Load(d, f.depth.get() + at - kStripLines);
        west_old = hn::LoadU(d, line.velocity + (i - 1) * line.stride + own);
      }
      V fresh = hn::Sub(hn::Load(d, f.moved.get() + at), hn::Mul(pull, hn::Sub(next, rise[k])));
      const V mean = hn::Add(hn::Mul(theta, fresh), hn::Mul(rest, old[k]));
      const V wet_depth = hn::Max(depth[k], zero);
      hn::Store(hn::Mul(wet_depth, mean), d, f.flux.get() + at + kStripLines);
      const auto shallow = hn::Lt(depth[k], hn::Set(d, kSheetDepthM));
      if (!hn::AllFalse(d, shallow)) {
        const V inherited = Inherit(west_depth, west_old, east_depth[k], east_old[k]);
        fresh = hn::IfThenElse(hn::Lt(depth[k], zero), inherited, SlowSheet(n, wet_depth, fresh));
      }
      const V kept = WithoutTiny(hn::Mul(keep, fresh));
      const V limit = hn::Set(d, n.velocity_max);
      hn::StoreU(hn::Min(hn::Max(kept, hn::Neg(limit)), limit), d,
                 line.velocity + i * line.stride + own);
      east_depth[k] = depth[k];
      east_old[k] = old[k];
      depth[k] = west_depth;
      old[k] = west_old;
    }
  }
  for (int k = 0; k < kPair; ++k) {
    StoreOutflow(n, line, f, 0, 0, lane + k * kHalf, rise[k], true);
  }
}

// Writes the cell's new level and, if wanted, its height.
template <bool kForced>
HWY_INLINE void Settle(const Numbers& n, const Line& line, std::size_t i, std::size_t lane,
                       const Cell& cell, V inflow, V outflow) {
  const D d;
  V rise = hn::Mul(hn::Set(d, n.step), hn::Sub(inflow, outflow));
  if constexpr (kForced) rise = hn::Mul(hn::Max(cell.free, hn::Set(d, 1.0f - n.held)), rise);
  V level = hn::Add(cell.level, rise);
  if (line.height != nullptr) {  // the second sweep
    const V keep = hn::Mul(hn::Set(d, line.keep_along[i]), hn::LoadU(d, line.keep_across + lane));
    level = WithoutTiny(hn::Mul(level, keep));
  }
  level = hn::Max(level, cell.bottom);
  hn::StoreU(level, d, line.level + i * line.stride + lane);
  if (line.height != nullptr) {
    const auto wet = hn::Gt(hn::Sub(level, cell.bottom), hn::Set(d, kDryDepthM));
    hn::StoreU(hn::IfThenElseZero(wet, level), d, line.height + i * line.height_stride + lane);
  }
}

// Moves the water. No cell gives more than it has: the fluxes out of one that would are scaled
// down. What leaves a cell enters its neighbour.
template <bool kForced>
HWY_INLINE void Move(const Numbers& n, const Line& line, ShallowFields& f, std::size_t lane) {
  const D d;
  const V one = hn::Set(d, 1.0f), zero = hn::Zero(d), step = hn::Set(d, n.step);
  const std::size_t cells = line.cells;
  Cell cell = LoadCell<kForced>(line, 0, lane);
  V share = one, west = zero, flux = hn::Load(d, f.flux.get() + lane);
  bool limited = false;
  for (std::size_t i = 0; i <= cells; ++i) {
    V own_share = one, next_flux = zero;
    Cell own = cell;
    bool own_limited = false;
    if (i < cells) {
      if (i > 0) own = LoadCell<kForced>(line, i, lane);
      next_flux = hn::Load(d, f.flux.get() + (i + 1) * kStripLines + lane);
      const V out = hn::Mul(step, hn::Sub(hn::Max(next_flux, zero), hn::Min(flux, zero)));
      const V water = hn::Sub(own.level, own.bottom);
      const auto over = hn::Gt(out, water);
      own_limited = !hn::AllFalse(d, over);
      if (own_limited) own_share = hn::IfThenElse(over, hn::Div(water, out), one);
    }
    if (limited || own_limited) {
      const V factor = hn::IfThenElse(hn::Gt(flux, zero), share, own_share);
      flux = hn::Mul(flux, factor);
    }
    if (i > 0) Settle<kForced>(n, line, i - 1, lane, cell, west, flux);
    west = flux;
    flux = next_flux;
    share = own_share;
    limited = own_limited;
    cell = own;
  }
}

template <bool kForced>
HWY_INLINE void SweepStrip(const Numbers& n, const Line& line, ShallowFields& f) {
  const std::size_t lanes = hn::Lanes(D());
  for (std::size_t lane = 0; lane < kHalf; lane += lanes) {
    Eliminate<kForced>(n, line, f, lane);
    Substitute(n, line, f, lane);
    for (int k = 0; k < kPair; ++k) Move<kForced>(n, line, f, lane + k * kHalf);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::world
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
