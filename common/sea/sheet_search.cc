#include "common/sea/sheet_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/fold.h"

namespace onesea::sea {

namespace {

constexpr double kSolvedM = 1e-4;
constexpr double kSameRootM = 5e-3;
constexpr int kNewtonSteps = 24;

struct Interpolated {
  double value, along_u, along_v;
};

Interpolated Bilinear(const float* plane, int size, int iu, int iv, double wu, double wv) {
  const int mask = size - 1;
  const float* low = plane + static_cast<std::size_t>(iv) * size;
  const float* high = plane + static_cast<std::size_t>((iv + 1) & mask) * size;
  const double c00 = low[iu], c10 = low[(iu + 1) & mask], c01 = high[iu],
               c11 = high[(iu + 1) & mask];
  const double a = c00 + wu * (c10 - c00), b = c01 + wu * (c11 - c01);
  return {a + wv * (b - a), (c10 - c00) + wv * ((c11 - c01) - (c10 - c00)), b - a};
}

void AddCascade(const QueryCascade& cascade, Vec2d p, QueryPoint& sum) {
  const double u = cascade.cells_per_m * (cascade.cosine * p.x + cascade.sine * p.y);
  const double v = cascade.cells_per_m * (cascade.cosine * p.y - cascade.sine * p.x);
  const double whole_u = std::floor(u), whole_v = std::floor(v);
  const double size = cascade.grid_size;
  const int iu = static_cast<int>(whole_u - size * std::floor(whole_u / size));
  const int iv = static_cast<int>(whole_v - size * std::floor(whole_v / size));
  const auto read = [&](Field field) {
    return Bilinear(cascade.planes[static_cast<int>(field)], cascade.grid_size, iu, iv, u - whole_u,
                    v - whole_v);
  };
  const double c = cascade.cosine * cascade.cells_per_m, s = cascade.sine * cascade.cells_per_m;
  const Interpolated h = read(Field::kHeight);
  const Interpolated dx = read(Field::kDisplacementX);
  const Interpolated dy = read(Field::kDisplacementY);
  sum.height_m += h.value;
  sum.height_x += c * h.along_u - s * h.along_v;
  sum.height_y += s * h.along_u + c * h.along_v;
  sum.dx_m += dx.value;
  sum.dy_m += dy.value;
  sum.j_xx += c * dx.along_u - s * dx.along_v;
  sum.j_xy += s * dx.along_u + c * dx.along_v;
  sum.j_yx += c * dy.along_u - s * dy.along_v;
  sum.j_yy += s * dy.along_u + c * dy.along_v;
}

void AddRegular(const QueryRegular& regular, Vec2d p, QueryPoint& sum) {
  const real::SinCosPair wave = real::SinCos(2.0 * kPi * regular.wave.TurnsAt(p));
  const auto factor = [&](Field field) { return double{regular.factors[static_cast<int>(field)]}; };
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

struct Trial {
  Vec2d p;
  QueryPoint at;
  Vec2d miss;  // p + D(p) - x
};

class Search {
 public:
  Search(const QueryGrids& grids, Vec2d point) : grids_(grids), point_(point) {}

  Trial Try(Vec2d p) const {
    const QueryPoint at = EvaluateQueryPoint(grids_, p);
    return {p, at, {p.x + at.dx_m - point_.x, p.y + at.dy_m - point_.y}};
  }

  // Newton with halved steps; nothing if it does not arrive.
  std::optional<Trial> Solve(Vec2d start) const {
    Trial best = Try(start);
    for (int n = 0; n < kNewtonSteps && Norm(best.miss) > 0.1 * kSolvedM; ++n) {
      const QueryPoint& a = best.at;
      double determinant = a.j_xx * a.j_yy - a.j_xy * a.j_yx;
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
};

Vec2d FoldDirection(const QueryPoint& at) {
  const FoldState fold = FoldOf(at.j_xx - 1.0, at.j_yy - 1.0, 0.5 * (at.j_xy + at.j_yx));
  return {fold.direction_x, fold.direction_y};
}

// Sheets found so far; the highest answers.
struct Sheets {
  void Add(const Trial& root) {
    if (count == 0) {
      top = first = root;
      count = 1;
      return;
    }
    if (Norm(root.p - first.p) < kSameRootM || Norm(root.p - top.p) < kSameRootM) return;
    ++count;
    if (root.at.height_m > top.at.height_m) top = root;
  }
  Trial first{}, top{};
  int count = 0;
};

// Walks from `centre` along ±direction; between two steps where the miss along the direction
// changes sign lies a sheet.
void Walk(const Search& search, const Trial& centre, Vec2d direction, double first_step_m,
          Sheets& sheets) {
  const Vec2d across = {-direction.y, direction.x};
  for (const double sense : {1.0, -1.0}) {
    Vec2d p = centre.p;
    double along_before = 0.0;
    bool known = false;
    for (double step_m = first_step_m, gone_m = 0.0; gone_m < kSheetSearchM;
         gone_m += step_m, step_m *= 1.2) {
      p = p + (sense * step_m) * direction;
      const Trial here = search.Try(p);
      const double along = Dot(here.miss, direction) * sense;
      if (known && (along < 0.0) != (along_before < 0.0)) {
        if (const auto root = search.Solve(p)) sheets.Add(*root);
        if (const auto root = search.Solve(p - (0.5 * sense * step_m) * direction))
          sheets.Add(*root);
      }
      along_before = along;
      known = true;
      // Stay near the curve on which the miss across vanishes.
      p = p - (0.7 * Dot(here.miss, across)) * across;
    }
  }
}

}  // namespace

QueryPoint EvaluateQueryPoint(const QueryGrids& grids, Vec2d undisplaced) {
  QueryPoint sum;
  for (const QueryCascade& cascade : grids.cascades) AddCascade(cascade, undisplaced, sum);
  for (const QueryRegular& regular : grids.regular) AddRegular(regular, undisplaced, sum);
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
  double finest_m = kSheetSearchM;
  for (const QueryCascade& cascade : grids.cascades)
    finest_m = std::min(finest_m, 1.0 / cascade.cells_per_m);
  Walk(search, centre, FoldDirection(centre.at), finest_m, sheets);
  // No sheet at all is possible only where bilinear kinks stop Newton: the nearest try answers, its
  // residual tells.
  const Trial& top = sheets.count > 0 ? sheets.top : centre;
  sample.height_m = static_cast<float>(top.at.height_m);
  sample.displacement_x_m = static_cast<float>(point.x - top.p.x);
  sample.displacement_y_m = static_cast<float>(point.y - top.p.y);
  sample.residual_m = static_cast<float>(Norm(top.miss));
  sample.folded = sheets.count > 1;
}

}  // namespace onesea::sea
