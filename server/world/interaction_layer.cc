#include "server/world/interaction_layer.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/hash.h"
#include "common/sea/constants.h"

namespace onesea::world {
namespace {

constexpr float kHeightMaxM = 1e4f;  // of the mean; no wave is higher than the sea is deep

}  // namespace

struct InteractionLayer::Grid {
  Grid(const Region& region_in, std::unique_ptr<WaveSolver> solver_in, const FoamOptions& options)
      : region(region_in),
        solver(std::move(solver_in)),
        calm(solver->State()),
        foam(region_in.cells, options) {
    const std::size_t cells = region.cells.cells();
    for (auto* values : {&source_m, &pressure_head_m, &solid, &rest_height_m}) {
      values->resize(cells);
    }
    forcing = {region.cells, source_m, pressure_head_m, solid, rest_height_m};
  }

  // The other's waves and foam where both lie; the other is calm there afterwards.
  void Take(Grid& other) {
    const sea::CellRect both = sea::Intersection(region.cells, other.region.cells);
    if (both.cells() == 0) return;
    solver->Adopt(*other.solver);
    std::vector<float> state = other.solver->State();
    const std::size_t plane = other.region.cells.cells();
    for (std::int64_t j = both.south; j < both.north(); ++j) {
      for (std::int64_t i = both.west; i < both.east(); ++i) {
        const std::size_t from = other.At(i, j);
        for (std::size_t at = from; at < state.size(); at += plane) state[at] = other.calm[at];
        float& share = foam.shares()[At(i, j)];
        share = std::max(share, other.foam.shares()[from]);
        other.foam.shares()[from] = 0.0f;
      }
    }
    other.solver->Restore(state);
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
  std::vector<float> calm;  // the state without a wave
  InteractionFoam foam;
  std::vector<float> source_m, pressure_head_m, solid, rest_height_m;
  RegionForcing forcing;
  bool forced = false;  // any of the four is not zero
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
  spec.damping_per_s = options_.damping_per_s;
  spec.edge_cells = options_.edge_cells;
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<WaveSolver> solver, MakeSolver(spec));
  return std::make_unique<Grid>(region, std::move(solver), options_.foam);
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
                                  [&](const auto& grid) { return grid->region == region; });
    if (old != dropped.end()) {
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
  if (grid == nullptr) return nullptr;
  grid->forced = true;
  return &grid->forcing;
}

void InteractionLayer::ForEachForcing(const std::function<bool(RegionForcing&)>& fill) {
  for (const auto& grid : grids_) {
    if (fill(grid->forcing)) grid->forced = true;
  }
}

bool InteractionLayer::AddSource(Vec2d place, double radius_m, double volume_m3) {
  if (!AllFinite({place.x, place.y, radius_m, volume_m3})) return false;
  const RegionForcing* forcing = ForcingAt(place);
  if (forcing == nullptr) return false;
  const double cell_m2 = forcing->cells.cell_m * forcing->cells.cell_m;
  SpreadOver(forcing->cells, place, radius_m, volume_m3 / cell_m2, forcing->source_m);
  return true;
}

bool InteractionLayer::AddPressure(Vec2d place, double radius_m, double force_n) {
  if (!AllFinite({place.x, place.y, radius_m, force_n})) return false;
  const RegionForcing* forcing = ForcingAt(place);
  if (forcing == nullptr) return false;
  const double newton_per_m =
      sea::kWaterDensityKgPerM3 * sea::kGravity * forcing->cells.cell_m * forcing->cells.cell_m;
  SpreadOver(forcing->cells, place, radius_m, force_n / newton_per_m, forcing->pressure_head_m);
  return true;
}

bool InteractionLayer::AddSolid(Vec2d place, double radius_m, double rest_height_m) {
  if (!AllFinite({place.x, place.y, radius_m, rest_height_m})) return false;
  const RegionForcing* forcing = ForcingAt(place);
  if (forcing == nullptr) return false;
  ForDisc(forcing->cells, place, radius_m + 0.5 * forcing->cells.cell_m,
          [&](std::size_t at, double) {
            forcing->solid[at] = 1.0f;
            forcing->rest_height_m[at] = static_cast<float>(rest_height_m);
          });
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
    StepForcing forcing;
    if (grid->forced) {
      forcing = {grid->source_m, grid->pressure_head_m, grid->solid, grid->rest_height_m};
    }
    grid->solver->Step(forcing);
    if (grid->forced) {
      for (auto* values :
           {&grid->source_m, &grid->pressure_head_m, &grid->solid, &grid->rest_height_m}) {
        std::fill(values->begin(), values->end(), 0.0f);
      }
      grid->forced = false;
    }
    if (steps_ % kFoamSteps == 0) {
      if (!grid->IsSane()) {
        grid->solver->Restore(grid->calm);
        ++resets_;
      }
      grid->foam.Advance(kFoamSteps * options_.step_s, *grid->solver);
    }
  }
}

std::shared_ptr<const sea::InteractionSnapshot> InteractionLayer::Snapshot(std::int64_t tick,
                                                                           bool velocities) const {
  auto snapshot = std::make_shared<sea::InteractionSnapshot>();
  snapshot->tick = tick;
  for (const auto& grid : grids_) {
    auto field = std::make_shared<sea::InteractionField>();
    field->cells = grid->region.cells;
    const auto height = grid->solver->height_m();
    field->height_m.assign(height.begin(), height.end());
    if (velocities) {
      for (auto* values : {&field->velocity_x, &field->velocity_y, &field->velocity_z}) {
        values->resize(height.size());
      }
      grid->solver->Velocity(field->velocity_x, field->velocity_y, field->velocity_z);
    }
    const auto foam = std::as_const(grid->foam).shares();
    if (std::any_of(foam.begin(), foam.end(), [](float share) { return share > 0.0f; })) {
      field->foam.assign(foam.begin(), foam.end());
    }
    snapshot->fields.push_back(std::move(field));
  }
  return snapshot;
}

InteractionState InteractionLayer::State() const {
  InteractionState state{.steps = steps_, .asks = asks_, .regions = {}};
  for (const auto& grid : grids_) {
    const auto foam = std::as_const(grid->foam).shares();
    state.regions.push_back({grid->region, grid->solver->State(), {foam.begin(), foam.end()}});
  }
  return state;
}

absl::Status InteractionLayer::Restore(const InteractionState& state) {
  grids_.clear();
  asks_.clear();
  std::vector<std::unique_ptr<Grid>> grids;
  for (const auto& saved : state.regions) {
    ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<Grid> grid, MakeGrid(saved.region));
    if (saved.waves.size() != grid->calm.size() ||
        saved.foam.size() != saved.region.cells.cells()) {
      return absl::InvalidArgumentError(
          absl::StrCat("region state of ", saved.waves.size(), " and ", saved.foam.size(),
                       " numbers, not ", grid->calm.size(), " and ", saved.region.cells.cells()));
    }
    grid->solver->Restore(saved.waves);
    std::copy(saved.foam.begin(), saved.foam.end(), grid->foam.shares().begin());
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
    for (const float value : grid->solver->State()) hash.Add(value);
    for (const float value : std::as_const(grid->foam).shares()) hash.Add(value);
  }
  return hash.value();
}

}  // namespace onesea::world
