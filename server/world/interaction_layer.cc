#include "server/world/interaction_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/hash.h"
#include "common/base/only_owner.h"
#include "common/sea/constants.h"
#include "server/world/iwave_design.h"

namespace onesea::world {
namespace {

// Fields of one region that are written again: the present, what queries hold, and the past.
constexpr std::size_t kFieldsKept = 32;
constexpr float kHeightMaxM = 1e4f;  // of the mean; no wave is higher than the sea is deep

}  // namespace

struct InteractionLayer::Grid {
  Grid(const Region& region_in, std::unique_ptr<WaveSolver> solver_in, int ticks_in,
       const FoamOptions& options)
      : region(region_in),
        solver(std::move(solver_in)),
        ticks(ticks_in),
        calm(solver->State()),
        foam(region_in.cells, options) {
    const std::size_t cells = region.cells.cells();
    for (auto* values : {&source_m, &pressure_head_m, &solid, &rest_height_m}) {
      values->resize(cells);
    }
    forcing = {region.cells, region.traits, source_m, pressure_head_m, solid, rest_height_m};
    if (ticks > 1) before_m.resize(cells);
    if (ticks > 1) between_m.resize(cells);
  }

  // The other's waves, foam and deposits where both lie; the other has none there afterwards.
  void Take(Grid& other) {
    const sea::CellRect both = sea::Intersection(region.cells, other.region.cells);
    if (both.cells() == 0) return;
    solver->Adopt(*other.solver);
    stepped = other.stepped = true;
    std::vector<float> state = other.solver->State();
    const std::size_t plane = other.region.cells.cells();
    for (std::int64_t j = both.south; j < both.north(); ++j) {
      for (std::int64_t i = both.west; i < both.east(); ++i) {
        const std::size_t from = other.At(i, j);
        for (std::size_t at = from; at < state.size(); at += plane) state[at] = other.calm[at];
        float& share = foam.shares()[At(i, j)];
        share = std::max(share, other.foam.shares()[from]);
        other.foam.shares()[from] = 0.0f;
        if (ticks > 1) {
          before_m[At(i, j)] += std::exchange(other.before_m[from], 0.0f);
          between_m[At(i, j)] += std::exchange(other.between_m[from], 0.0f);
        }
        if (other.forcing.any()) TakeDeposits(At(i, j), other, from);
      }
    }
    forcing.has_source |= other.forcing.has_source;
    forcing.has_pressure |= other.forcing.has_pressure;
    forcing.has_solid |= other.forcing.has_solid;
    other.solver->Restore(state);
  }

  void TakeDeposits(std::size_t at, Grid& other, std::size_t from) {
    source_m[at] += std::exchange(other.source_m[from], 0.0f);
    pressure_head_m[at] += std::exchange(other.pressure_head_m[from], 0.0f);
    const float other_solid = std::exchange(other.solid[from], 0.0f);
    if (other_solid > solid[at]) {
      solid[at] = other_solid;
      rest_height_m[at] = other.rest_height_m[from];
    }
  }

  // The `steps`th tick; the deposits are used up, but sources wait for the solver's next step.
  void Advance(std::int64_t steps) {
    const int tick = static_cast<int>((steps - 1) % ticks);  // of those that one step covers
    if (tick == 0) StepSolver();
    if (ticks > 1) FindBetween(tick + 1);
    const auto clear = [](bool& has, std::vector<float>& values) {
      if (std::exchange(has, false)) std::fill(values.begin(), values.end(), 0.0f);
    };
    if (forcing.has_solid) std::fill(rest_height_m.begin(), rest_height_m.end(), 0.0f);
    clear(forcing.has_pressure, pressure_head_m);
    clear(forcing.has_solid, solid);
    if (tick == 0) clear(forcing.has_source, source_m);
  }

  void StepSolver() {
    StepForcing now;
    if (forcing.has_source) now.source_m = source_m;
    if (forcing.has_pressure) now.pressure_head_m = pressure_head_m;
    if (forcing.has_solid) now.solid = solid, now.rest_height_m = rest_height_m;
    if (ticks > 1) {
      const auto height = solver->height_m();
      std::copy(height.begin(), height.end(), before_m.begin());
      // What is poured in is there at once.
      for (std::size_t n = 0; n < now.source_m.size(); ++n) before_m[n] += now.source_m[n];
    }
    solver->Step(now);
    stepped = true;
  }

  // The heights after `tick` of the ticks that the solver's last step covers.
  void FindBetween(int tick) {
    const auto after = solver->height_m();
    const float share = static_cast<float>(tick) / static_cast<float>(ticks);
    if (tick == ticks) {
      std::copy(after.begin(), after.end(), between_m.begin());
      return;
    }
    for (std::size_t n = 0; n < between_m.size(); ++n) {
      // Land stays exactly dry.
      between_m[n] = after[n] == 0.0f ? 0.0f : before_m[n] + share * (after[n] - before_m[n]);
    }
  }

  std::span<const float> height_m() const {
    return ticks > 1 ? std::span<const float>(between_m) : solver->height_m();
  }

  // Between the solver's steps they stay as they are, and copying is cheaper.
  void FillVelocities(sea::InteractionField& field) {
    if (latest != nullptr && !stepped) {
      field.velocity_x = latest->velocity_x;
      field.velocity_y = latest->velocity_y;
      field.velocity_z = latest->velocity_z;
      return;
    }
    for (auto* values : {&field.velocity_x, &field.velocity_y, &field.velocity_z}) {
      values->resize(region.cells.cells());
    }
    solver->Velocity(field.velocity_x, field.velocity_y, field.velocity_z);
    stepped = false;
  }

  // One that nobody reads any more: to write a field anew into memory that the system has to find
  // first costs more than to compute it.
  std::shared_ptr<sea::InteractionField> SpareField() {
    for (const auto& field : published) {
      if (IsOnlyOwner(field)) return field;
    }
    auto field = std::make_shared<sea::InteractionField>();
    if (published.size() < kFieldsKept) published.push_back(field);
    return field;
  }

  // False also for NaN, which passes every sum on.
  bool IsSane() const {
    float sum = 0.0f;
    for (const float height : solver->height_m()) sum += std::abs(height);
    return sum < kHeightMaxM * static_cast<float>(region.cells.cells());
  }

  std::size_t At(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j - region.cells.south) * region.cells.columns + i -
                                    region.cells.west);
  }

  Region region;
  std::unique_ptr<WaveSolver> solver;
  int ticks;                               // that one step of the solver covers
  std::vector<float> before_m, between_m;  // heights before that step, and now; empty for 1
  std::vector<float> calm;                 // the state without a wave
  InteractionFoam foam;
  std::vector<float> source_m, pressure_head_m, solid, rest_height_m;
  RegionForcing forcing;
  std::vector<std::shared_ptr<sea::InteractionField>> published;
  std::shared_ptr<const sea::InteractionField> latest;  // of them; null: not yet
  bool stepped = true;                                  // the solver, since then
};

namespace {

// Calls use(index in the region, weight) for the cells of a disc, weight (1 - r²/R²)².
template <typename Use>
void ForDisc(const sea::CellRect& cells, Vec2d place, double radius_m, const Use& use) {
  const double radius = std::max(radius_m / cells.cell_m, 1.5);
  const double x = place.x / cells.cell_m - static_cast<double>(cells.west);
  const double y = place.y / cells.cell_m - static_cast<double>(cells.south);
  const int west = static_cast<int>(std::max(0.0, std::ceil(x - radius)));
  const int south = static_cast<int>(std::max(0.0, std::ceil(y - radius)));
  const double east = std::min(x + radius, static_cast<double>(cells.columns - 1));
  const double north = std::min(y + radius, static_cast<double>(cells.rows - 1));
  for (int row = south; row <= north; ++row) {
    for (int column = west; column <= east; ++column) {
      const double r2 = ((column - x) * (column - x) + (row - y) * (row - y)) / (radius * radius);
      if (r2 >= 1.0) continue;
      use(static_cast<std::size_t>(row) * cells.columns + column, (1.0 - r2) * (1.0 - r2));
    }
  }
}

bool AllFinite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// Adds `total` shared out over the disc in proportion to the weights.
void SpreadOver(const sea::CellRect& cells, Vec2d place, double radius_m, double total,
                std::span<float> to) {
  double sum = 0.0;
  ForDisc(cells, place, radius_m, [&](std::size_t, double weight) { sum += weight; });
  if (!(sum > 0.0)) return;
  ForDisc(cells, place, radius_m, [&](std::size_t at, double weight) {
    to[at] += static_cast<float>(total * weight / sum);
  });
}

// iWave is right whatever the step, as long as that is short beside its shortest waves, and costs
// more than the others together. Between its steps heights are linear in time: (ω span)²/8 of a
// wave of ω is lost half-way.
int TicksPerStep(const SolverSpec& spec) {
  constexpr double kPhaseMax = 0.5;  // of the shortest waves in a step
  constexpr int kTicksMax = 3;
  if (spec.kind != SolverKind::kIwave || !(spec.cells.cell_m > 0.0)) return 1;
  const double omega = std::sqrt(sea::kGravity * kIwaveSymbolMax / spec.cells.cell_m);
  return std::clamp(static_cast<int>(kPhaseMax / (omega * spec.step_s)), 1, kTicksMax);
}

}  // namespace

InteractionLayer::InteractionLayer(InteractionOptions options) : options_(std::move(options)) {}
InteractionLayer::~InteractionLayer() = default;

absl::StatusOr<std::unique_ptr<InteractionLayer::Grid>> InteractionLayer::MakeGrid(
    const Region& region) const {
  SolverSpec spec;
  spec.kind = region.kind;
  spec.cells = region.cells;
  spec.step_s = options_.step_s;
  spec.depth_m = options_.depth_m;
  spec.terrain = options_.terrain;
  spec.damping_per_s = options_.damping_per_s + region.damping_per_s;
  spec.edge_cells = options_.edge_cells;
  const int ticks = TicksPerStep(spec);
  spec.step_s *= ticks;
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<WaveSolver> solver, MakeSolver(spec));
  return std::make_unique<Grid>(region, std::move(solver), ticks, options_.foam);
}

absl::Status InteractionLayer::Place(std::span<const RegionAsk> asks) {
  absl::Status first_error;
  std::vector<RegionAsk> valid;
  for (const RegionAsk& ask : asks) {
    absl::Status status = ValidateRegionAsk(ask);
    if (status.ok()) valid.push_back(ask);
    first_error.Update(status);
  }
  asks_ = SnapAsks(valid, asks_);
  std::vector<std::unique_ptr<Grid>> dropped = std::move(grids_), created;
  grids_.clear();
  for (const Region& region : LayOut(asks_)) {
    const auto old = std::find_if(dropped.begin(), dropped.end(),
                                  [&](const auto& grid) { return SameGrid(grid->region, region); });
    if (old != dropped.end()) {
      (*old)->region.traits = (*old)->forcing.traits = region.traits;
      grids_.push_back(std::move(*old));
      dropped.erase(old);
      continue;
    }
    auto made = MakeGrid(region);
    first_error.Update(made.status());
    if (made.ok()) grids_.push_back(*std::move(made));
  }
  AdoptFrom(dropped);
  return first_error;
}

void InteractionLayer::AdoptFrom(std::vector<std::unique_ptr<Grid>>& dropped) {
  for (const auto& to : grids_) {
    for (const auto& from : dropped) {
      if (from->region.kind == to->region.kind &&
          from->region.cells.cell_m == to->region.cells.cell_m) {
        to->Take(*from);
      }
    }
  }
}

std::vector<Region> InteractionLayer::regions() const {
  std::vector<Region> regions;
  for (const auto& grid : grids_) regions.push_back(grid->region);
  return regions;
}

InteractionLayer::Grid* InteractionLayer::BestAt(Vec2d place) {
  Grid* best = nullptr;
  double best_m = 0.0;  // inside by at least this
  for (const auto& grid : grids_) {
    const sea::CellRect& cells = grid->region.cells;
    const Vec2d low = cells.PlaceOf(cells.west, cells.south);
    const Vec2d high = cells.PlaceOf(cells.east() - 1, cells.north() - 1);
    const double inside_m = std::min(std::min(place.x - low.x, high.x - place.x),
                                     std::min(place.y - low.y, high.y - place.y));
    if (inside_m > best_m) {
      best = grid.get();
      best_m = inside_m;
    }
  }
  return best;
}

RegionForcing* InteractionLayer::ForcingAt(Vec2d place) {
  Grid* grid = BestAt(place);
  return grid == nullptr ? nullptr : &grid->forcing;
}

void InteractionLayer::ForEachForcing(const std::function<void(RegionForcing&)>& fill) {
  for (const auto& grid : grids_) fill(grid->forcing);
}

bool InteractionLayer::AddSource(Vec2d place, double radius_m, double volume_m3) {
  if (!AllFinite({place.x, place.y, radius_m, volume_m3})) return false;
  RegionForcing* forcing = ForcingAt(place);
  if (forcing == nullptr) return false;
  const double cell_m2 = forcing->cells.cell_m * forcing->cells.cell_m;
  SpreadOver(forcing->cells, place, radius_m, volume_m3 / cell_m2, forcing->source_m);
  forcing->has_source = true;
  return true;
}

bool InteractionLayer::AddPressure(Vec2d place, double radius_m, double force_n) {
  if (!AllFinite({place.x, place.y, radius_m, force_n})) return false;
  RegionForcing* forcing = ForcingAt(place);
  if (forcing == nullptr) return false;
  const double newton_per_m =
      sea::kWaterDensityKgPerM3 * sea::kGravity * forcing->cells.cell_m * forcing->cells.cell_m;
  SpreadOver(forcing->cells, place, radius_m, force_n / newton_per_m, forcing->pressure_head_m);
  forcing->has_pressure = true;
  return true;
}

bool InteractionLayer::AddSolid(Vec2d place, double radius_m, double rest_height_m) {
  if (!AllFinite({place.x, place.y, radius_m, rest_height_m})) return false;
  RegionForcing* forcing = ForcingAt(place);
  if (forcing == nullptr) return false;
  ForDisc(forcing->cells, place, radius_m + 0.5 * forcing->cells.cell_m,
          [&](std::size_t at, double) {
            forcing->solid[at] = 1.0f;
            forcing->rest_height_m[at] = static_cast<float>(rest_height_m);
          });
  forcing->has_solid = true;
  return true;
}

bool InteractionLayer::AddFoam(Vec2d place, double radius_m, double share) {
  if (!AllFinite({place.x, place.y, radius_m, share})) return false;
  Grid* grid = BestAt(place);
  if (grid == nullptr) return false;
  ForDisc(grid->region.cells, place, radius_m, [&](std::size_t at, double weight) {
    float& foam = grid->foam.shares()[at];
    foam = static_cast<float>(std::clamp(foam + share * weight, 0.0, 1.0));
  });
  return true;
}

void InteractionLayer::Step() {
  ++steps_;
  for (const auto& grid : grids_) {
    grid->Advance(steps_);
    if (steps_ % kFoamSteps == 0) {
      if (!grid->IsSane()) {
        grid->solver->Restore(grid->calm);
        grid->stepped = true;
        std::fill(grid->before_m.begin(), grid->before_m.end(), 0.0f);
        std::fill(grid->between_m.begin(), grid->between_m.end(), 0.0f);
        ++resets_;
      }
      grid->foam.Advance(kFoamSteps * options_.step_s, *grid->solver);
    }
  }
}

void InteractionLayer::AddFelt(std::span<const Vec2d> places,
                               std::span<sea::InteractionFelt> sum) const {
  const auto some = [](const std::vector<float>& values, bool any) {
    return any ? std::span<const float>(values) : std::span<const float>();
  };
  for (const auto& grid : grids_) {
    std::span<const float> velocity_x, velocity_y;
    if (grid->latest != nullptr) {
      velocity_x = grid->latest->velocity_x;
      velocity_y = grid->latest->velocity_y;
    }
    sea::AddFelt(grid->region.cells, grid->height_m(),
                 some(grid->pressure_head_m, grid->forcing.has_pressure), velocity_x, velocity_y,
                 places, sum);
  }
}

std::shared_ptr<const sea::InteractionSnapshot> InteractionLayer::Snapshot(std::int64_t tick,
                                                                           bool velocities) const {
  auto snapshot = std::make_shared<sea::InteractionSnapshot>();
  snapshot->tick = tick;
  for (const auto& grid : grids_) {
    std::shared_ptr<sea::InteractionField> field = grid->SpareField();
    field->cells = grid->region.cells;
    const auto height = grid->height_m();
    field->height_m.assign(height.begin(), height.end());
    if (velocities) {
      grid->FillVelocities(*field);
      grid->latest = field;
    } else {
      for (auto* values : {&field->velocity_x, &field->velocity_y, &field->velocity_z}) {
        values->clear();
      }
    }
    const auto foam = std::as_const(grid->foam).shares();
    const bool any = std::any_of(foam.begin(), foam.end(), [](float share) { return share > 0; });
    field->foam.assign(foam.begin(), any ? foam.end() : foam.begin());
    snapshot->fields.push_back(std::move(field));
  }
  return snapshot;
}

InteractionState InteractionLayer::State() const {
  InteractionState state{.steps = steps_, .asks = asks_, .regions = {}};
  for (const auto& grid : grids_) {
    const auto foam = std::as_const(grid->foam).shares();
    state.regions.push_back({grid->region,
                             grid->solver->State(),
                             {foam.begin(), foam.end()},
                             grid->before_m,
                             grid->between_m,
                             grid->source_m});
  }
  return state;
}

absl::Status InteractionLayer::Restore(const InteractionState& state) {
  grids_.clear();
  asks_.clear();
  std::vector<std::unique_ptr<Grid>> grids;
  for (const auto& saved : state.regions) {
    ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<Grid> grid, MakeGrid(saved.region));
    const std::size_t cells = saved.region.cells.cells();
    if (saved.waves.size() != grid->calm.size() || saved.foam.size() != cells ||
        saved.before_m.size() != grid->before_m.size() || saved.source_m.size() != cells ||
        saved.between_m.size() != grid->between_m.size()) {
      return absl::InvalidArgumentError(absl::StrCat("region state of ", saved.waves.size(),
                                                     " and ", saved.foam.size(), " numbers, not ",
                                                     grid->calm.size(), " and ", cells));
    }
    grid->solver->Restore(saved.waves);
    std::copy(saved.foam.begin(), saved.foam.end(), grid->foam.shares().begin());
    std::copy(saved.before_m.begin(), saved.before_m.end(), grid->before_m.begin());
    std::copy(saved.between_m.begin(), saved.between_m.end(), grid->between_m.begin());
    std::copy(saved.source_m.begin(), saved.source_m.end(), grid->source_m.begin());
    grid->forcing.has_source = std::any_of(saved.source_m.begin(), saved.source_m.end(),
                                           [](float source) { return source != 0.0f; });
    grids.push_back(std::move(grid));
  }
  grids_ = std::move(grids);
  asks_ = state.asks;
  steps_ = state.steps;
  return absl::OkStatus();
}

std::uint64_t InteractionLayer::Hash() const {
  Hash64 hash;
  hash.Add(steps_);
  const auto add_cells = [&](const sea::CellRect& cells) {
    hash.Add(cells.west);
    hash.Add(cells.south);
    hash.Add(cells.columns);
    hash.Add(cells.rows);
    hash.Add(cells.cell_m);
  };
  for (const PlacedAsk& ask : asks_) {
    hash.Add(ask.id);
    hash.Add(static_cast<std::uint8_t>(ask.kind));
    add_cells(ask.cells);
  }
  for (const auto& grid : grids_) {
    hash.Add(static_cast<std::uint8_t>(grid->region.kind));
    add_cells(grid->region.cells);
    hash.Add(grid->region.damping_per_s);
    hash.AddFloats(grid->solver->State());
    hash.AddFloats(std::as_const(grid->foam).shares());
    if (grid->forcing.has_source) hash.AddFloats(grid->source_m);
    hash.AddFloats(grid->before_m);
    hash.AddFloats(grid->between_m);
  }
  return hash.value();
}

}  // namespace onesea::world
