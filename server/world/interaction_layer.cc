#include "server/world/interaction_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/sea/constants.h"

namespace onesea::world {
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

absl::StatusOr<std::unique_ptr<InteractionGrid>> InteractionLayer::MakeGrid(
    const Region& region) const {
  SolverSpec spec;
  spec.step_s = options_.step_s;
  spec.depth_m = options_.depth_m;
  spec.terrain = options_.terrain;
  spec.damping_per_s = options_.damping_per_s;
  spec.edge_cells = options_.edge_cells;
  return InteractionGrid::Make(region, spec, options_.foam);
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
  std::vector<std::unique_ptr<InteractionGrid>> dropped = std::move(grids_);
  grids_.clear();
  for (const Region& region : LayOut(asks_)) {
    const auto old = std::find_if(dropped.begin(), dropped.end(), [&](const auto& grid) {
      return SameGrid(grid->region(), region);
    });
    if (old != dropped.end()) {
      (*old)->SetTraits(region.traits);
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

void InteractionLayer::AdoptFrom(std::vector<std::unique_ptr<InteractionGrid>>& dropped) {
  for (const auto& to : grids_) {
    for (const auto& from : dropped) {
      if (from->region().kind == to->region().kind &&
          from->region().cells.cell_m == to->region().cells.cell_m) {
        to->Take(*from);
      }
    }
  }
}

std::vector<Region> InteractionLayer::regions() const {
  std::vector<Region> regions;
  for (const auto& grid : grids_) regions.push_back(grid->region());
  return regions;
}

InteractionGrid* InteractionLayer::BestAt(Vec2d place) {
  InteractionGrid* best = nullptr;
  double best_m = 0.0;  // inside by at least this
  for (const auto& grid : grids_) {
    const sea::CellRect& cells = grid->region().cells;
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
  InteractionGrid* grid = BestAt(place);
  return grid == nullptr ? nullptr : &grid->forcing();
}

void InteractionLayer::ForEachForcing(const std::function<void(RegionForcing&)>& fill) {
  for (const auto& grid : grids_) fill(grid->forcing());
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
  InteractionGrid* grid = BestAt(place);
  if (grid == nullptr) return false;
  ForDisc(grid->region().cells, place, radius_m, [&](std::size_t at, double weight) {
    float& foam = grid->foam().shares()[at];
    foam = static_cast<float>(std::clamp(foam + share * weight, 0.0, 1.0));
  });
  return true;
}

void InteractionLayer::Step() {
  ++steps_;
  for (const auto& grid : grids_) {
    grid->Advance(steps_);
    if (steps_ % kFoamSteps != 0) continue;
    resets_ += grid->CalmTheInsane() ? 1 : 0;
    grid->AdvanceFoam(kFoamSteps * options_.step_s);
  }
}

void InteractionLayer::AddFelt(std::span<const Vec2d> places,
                               std::span<sea::InteractionFelt> sum) const {
  for (const auto& grid : grids_) grid->AddFelt(places, sum);
}

std::shared_ptr<const sea::InteractionSnapshot> InteractionLayer::Snapshot(std::int64_t tick) {
  auto snapshot = std::make_shared<sea::InteractionSnapshot>();
  snapshot->tick = tick;
  for (const auto& grid : grids_) snapshot->fields.push_back(grid->Publish());
  return snapshot;
}

InteractionState InteractionLayer::State() const {
  InteractionState state{.steps = steps_, .asks = asks_, .regions = {}};
  for (const auto& grid : grids_) state.regions.push_back(grid->State());
  return state;
}

absl::Status InteractionLayer::Restore(const InteractionState& state) {
  grids_.clear();
  asks_.clear();
  std::vector<std::unique_ptr<InteractionGrid>> grids;
  for (const RegionState& saved : state.regions) {
    ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<InteractionGrid> grid, MakeGrid(saved.region));
    ONESEA_RETURN_IF_ERROR(grid->Restore(saved));
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
  for (const PlacedAsk& ask : asks_) {
    hash.Add(ask.id);
    hash.Add(static_cast<std::uint8_t>(ask.kind));
    ask.cells.AddTo(hash);
  }
  for (const auto& grid : grids_) grid->AddTo(hash);
  return hash.value();
}

}  // namespace onesea::world
