#include "common/sea/sheet_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/fold.h"
#include "common/sea/spline.h"

namespace onesea::sea {

namespace {

constexpr double kSolvedM = 1e-4;
constexpr double kSameRootM = 5e-3;
constexpr int kNewtonSteps = 24;
constexpr int kSpokes = 32;

const std::array<Vec2d, kSpokes>& Spokes() {
  static const std::array<Vec2d, kSpokes> spokes = [] {
    std::array<Vec2d, kSpokes> made;
    for (int n = 0; n < kSpokes; ++n) {
      const real::SinCosPair angle = real::SinCos(2.0 * kPi * n / kSpokes);
      made[n] = {angle.cos, angle.sin};
    }
    return made;
  }();
  return spokes;
}

void AddCascade(const QueryCascade& cascade, double factor, Vec2d p, QueryPoint& sum) {
  const double u = cascade.cells_per_m * (cascade.cosine * p.x + cascade.sine * p.y);
  const double v = cascade.cells_per_m * (cascade.cosine * p.y - cascade.sine * p.x);
  const double whole_u = std::floor(u), whole_v = std::floor(v);
  const double size = cascade.grid_size;
  const auto iu = static_cast<std::size_t>(whole_u - size * std::floor(whole_u / size));
  const auto iv = static_cast<std::size_t>(whole_v - size * std::floor(whole_v / size));
  const SplineWeights at_u(u - whole_u), at_v(v - whole_v);
  const std::size_t pitch = RecordPitchWords(cascade.grid_size);
  double value[3] = {}, along_u[3] = {}, along_v[3] = {};
  for (int b = 0; b < 4; ++b) {
    const std::uint32_t* row = cascade.waves.words + (iv + (b & 2)) * pitch + 4 * iu;
    double row_value[3] = {}, row_along[3] = {};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t f = 0; f < 3; ++f) {
        const double coefficient = RecordHalf(row[4 * a + f], b & 1);
        row_value[f] += at_u.value[a] * coefficient;
        row_along[f] += at_u.slope[a] * coefficient;
      }
    }
    for (std::size_t f = 0; f < 3; ++f) {
      value[f] += at_v.value[b] * row_value[f];
      along_u[f] += at_v.value[b] * row_along[f];
      along_v[f] += at_v.slope[b] * row_value[f];
    }
  }
  const double unit = factor * double{cascade.waves.unit}, cells = unit * cascade.cells_per_m;
  const double c = cascade.cosine * cells, s = cascade.sine * cells;
  sum.dx_m += unit * value[0];
  sum.dy_m += unit * value[1];
  sum.height_m += unit * value[2];
  sum.j_xx += c * along_u[0] - s * along_v[0];
  sum.j_xy += s * along_u[0] + c * along_v[0];
  sum.j_yx += c * along_u[1] - s * along_v[1];
  sum.j_yy += s * along_u[1] + c * along_v[1];
  sum.height_x += c * along_u[2] - s * along_v[2];
  sum.height_y += s * along_u[2] + c * along_v[2];
}

void AddRegular(const QueryRegular& regular, double share, Vec2d p, QueryPoint& sum) {
  const real::SinCosPair wave = real::SinCos(2.0 * kPi * regular.wave.TurnsAt(p));
  const auto factor = [&](Field field) {
    return share * double{regular.factors[static_cast<int>(field)]};
  };
  sum.height_m += factor(Field::kHeight) * wave.cos;
  sum.height_x -= factor(Field::kSlopeX) * wave.sin;
  sum.height_y -= factor(Field::kSlopeY) * wave.sin;
  sum.dx_m -= factor(Field::kDisplacementX) * wave.sin;
  sum.dy_m -= factor(Field::kDisplacementY) * wave.sin;
  sum.j_xx += factor(Field::kJacobianXX) * wave.cos;
  sum.j_yy += factor(Field::kJacobianYY) * wave.cos;
  sum.j_xy += factor(Field::kJacobianXY) * wave.cos;
  sum.j_yx += factor(Field::kJacobianXY) * wave.cos;
}

constexpr double kThinDeterminant = 0.4;
constexpr double kThinReach = 0.5;

double Determinant(const QueryPoint& at) { return at.j_xx * at.j_yy - at.j_xy * at.j_yx; }

double LeastStretch(const QueryPoint& at) {
  return FoldOf(at.j_xx - 1.0, at.j_yy - 1.0, 0.5 * (at.j_xy + at.j_yx)).least;
}

struct Trial {
  Vec2d p;
  QueryPoint at;
  Vec2d miss;  // p + D(p) - x
};

class Search {
 public:
  Search(const QueryGrids& grids, Vec2d point)
      : grids_(grids), point_(point), factors_(FactorsAt(grids, point)) {}

  Trial Try(Vec2d p) const {
    const QueryPoint at = EvaluateQueryPoint(grids_, factors_, p);
    return {p, at, {p.x + at.dx_m - point_.x, p.y + at.dy_m - point_.y}};
  }

  // Newton with halved steps; nothing if it does not arrive.
  std::optional<Trial> Solve(Vec2d start) const {
    Trial best = Try(start);
    for (int n = 0; n < kNewtonSteps && Norm(best.miss) > 0.1 * kSolvedM; ++n) {
      const QueryPoint& a = best.at;
      double determinant = Determinant(a);
      if (std::abs(determinant) < 1e-3) determinant = std::copysign(1e-3, determinant);
      const Vec2d step = {(a.j_yy * best.miss.x - a.j_xy * best.miss.y) / determinant,
                          (a.j_xx * best.miss.y - a.j_yx * best.miss.x) / determinant};
      double scale = std::min(1.0, 2.0 / std::max(Norm(step), 1e-12));  // at most 2 m a step
      bool better = false;
      for (int halving = 0; halving < 6 && !better; ++halving, scale *= 0.5) {
        const Trial next = Try(best.p - scale * step);
        if (Norm(next.miss) < Norm(best.miss)) {
          best = next;
          better = true;
        }
      }
      if (!better) break;
    }
    if (Norm(best.miss) > kSolvedM) return std::nullopt;
    return best;
  }

 private:
  const QueryGrids& grids_;
  Vec2d point_;
  PlaneFactors factors_;
};

// Sheets found so far; the highest answers.
class Sheets {
 public:
  void Add(const Trial& root) {
    for (int n = 0; n < count_; ++n) {
      if (Norm(root.p - roots_[n].p) < kSameRootM) return;
    }
    if (count_ < kSheetsMax) roots_[count_++] = root;
  }
  int count() const { return count_; }
  const Trial& Top() const {
    return *std::max_element(
        roots_.begin(), roots_.begin() + count_,
        [](const Trial& a, const Trial& b) { return a.at.height_m < b.at.height_m; });
  }

 private:
  static constexpr int kSheetsMax = 8;
  std::array<Trial, kSheetsMax> roots_;
  int count_ = 0;
};

// The undisplaced point within triangle abc that the triangle's linear map sends to the query
// point, if there is one.
std::optional<Vec2d> CoveredBy(const Trial& a, const Trial& b, const Trial& c) {
  const Vec2d ab = b.miss - a.miss, ac = c.miss - a.miss;
  const double area = ab.x * ac.y - ac.x * ab.y;
  const double u = (ac.x * a.miss.y - a.miss.x * ac.y) / area;
  const double v = (a.miss.x * ab.y - ab.x * a.miss.y) / area;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return std::nullopt;
  return a.p + u * (b.p - a.p) + v * (c.p - a.p);
}

// Is there a spot near `centre` that is folded or close to it? Without one the map is one to one
// around it.
bool MayFold(const Search& search, const Trial& centre) {
  constexpr double kStretchSafe = 0.2;
  constexpr int kSpokeStep = 4;
  if (LeastStretch(centre.at) < kStretchSafe) return true;
  for (const double radius_m : {0.15, 0.5, 1.5, 4.0}) {
    for (int n = 0; n < kSpokes; n += kSpokeStep) {
      const Trial probe = search.Try(centre.p + radius_m * Spokes()[n]);
      if (LeastStretch(probe.at) < kStretchSafe) return true;
    }
  }
  return false;
}

// Every triangle of a fan of rings around `centre` that covers the query point holds a sheet. The
// rings widen with their radius, since sheets that lie far apart are wide.
void SearchRings(const Search& search, const Trial& centre, double first_radius_m, bool with_fan,
                 Sheets& sheets) {
  constexpr double kWiden = 1.2;
  std::array<Trial, kSpokes> inner, outer;
  inner.fill(centre);
  const auto visit = [&](const Trial& a, const Trial& b, const Trial& c) {
    const std::optional<Vec2d> start = CoveredBy(a, b, c);
    if (!start) return;
    const std::optional<Trial> root = search.Solve(*start);
    // Newton may stop at the edge of a fold; the sheet is there all the same.
    sheets.Add(root ? *root : search.Try(*start));
  };
  // A pair of sheets too thin for the triangles: a vertex from which Newton would not go far.
  const auto visit_thin = [&](const Trial& at, double spacing_m) {
    const double miss_m = Norm(at.miss);
    const bool flat = std::abs(Determinant(at.at)) < kThinDeterminant;
    if (miss_m > kThinReach * spacing_m && !(flat && miss_m < spacing_m)) return;
    if (const std::optional<Trial> root = search.Solve(at.p)) sheets.Add(*root);
  };
  bool first = true;
  for (double radius_m = first_radius_m; radius_m < kSheetSearchM; radius_m *= kWiden) {
    for (int n = 0; n < kSpokes; ++n) {
      outer[n] = search.Try(centre.p + radius_m * Spokes()[n]);
      visit_thin(outer[n], radius_m * (kWiden - 1.0));
    }
    for (int n = 0; n < kSpokes; ++n) {
      const int next = (n + 1) % kSpokes;
      if (first) {
        if (with_fan) visit(centre, outer[n], outer[next]);
        continue;
      }
      visit(inner[n], outer[n], outer[next]);
      visit(inner[n], outer[next], inner[next]);
    }
    inner = outer;
    first = false;
  }
}

}  // namespace

PlaneFactors FactorsAt(const QueryGrids& grids, Vec2d place) {
  PlaneFactors factors;
  factors.fill(1.0f);
  if (grids.attenuation != nullptr) grids.attenuation->AllAt(place, factors.data());
  return factors;
}

QueryPoint EvaluateQueryPoint(const QueryGrids& grids, const PlaneFactors& factors,
                              Vec2d undisplaced) {
  QueryPoint sum;
  const std::size_t cascades = grids.cascades.size();
  for (std::size_t c = 0; c < cascades; ++c) {
    AddCascade(grids.cascades[c], double{factors[c]}, undisplaced, sum);
  }
  for (const QueryRegular& regular : grids.regular) {
    AddRegular(regular, double{factors[cascades]}, undisplaced, sum);
  }
  return sum;
}

void FindTopSheet(const QueryGrids& grids, Vec2d point, SurfaceSample& sample) {
  const Search search(grids, point);
  const Vec2d guess = {point.x - sample.displacement_x_m, point.y - sample.displacement_y_m};
  Sheets sheets;
  std::optional<Trial> root = search.Solve(guess);
  if (!root) root = search.Solve(point);
  if (root) sheets.Add(*root);
  const Trial centre = root ? *root : search.Try(guess);
  double finest_m = 1.0;
  for (const QueryCascade& cascade : grids.cascades) {
    finest_m = std::min(finest_m, 1.0 / cascade.cells_per_m);
  }
  if (!root || MayFold(search, centre)) SearchRings(search, centre, finest_m, !root, sheets);
  // No sheet at all is possible only where Newton stopped everywhere: the nearest try answers, and
  // its residual tells.
  const Trial& top = sheets.count() > 0 ? sheets.Top() : centre;
  sample.height_m = static_cast<float>(top.at.height_m);
  sample.displacement_x_m = static_cast<float>(point.x - top.p.x);
  sample.displacement_y_m = static_cast<float>(point.y - top.p.y);
  sample.residual_m = static_cast<float>(Norm(top.miss));
  sample.folded = sheets.count() > 1;
}

}  // namespace onesea::sea
