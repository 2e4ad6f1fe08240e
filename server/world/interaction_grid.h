#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "common/base/hash.h"
#include "common/sea/interaction_field.h"
#include "server/world/interaction_foam.h"
#include "server/world/region_layout.h"
#include "server/world/wave_solver.h"

/// One region of the interaction layer: a solver, its foam, and what is put in for its next step.
namespace onesea::world {

/// One region's forcing for the next step, to be filled cell by cell with finite numbers;
/// (rows x columns) each. StepForcing says what they are. What isn't announced isn't read.
struct RegionForcing {
  sea::CellRect cells;
  RegionTraits traits;
  std::span<float> source_m, pressure_head_m, solid, rest_height_m;
  bool has_source = false, has_pressure = false, has_solid = false;  ///< set by whoever writes
  bool is_read = true;  ///< the next tick's step reads it; pressure heads are felt in any case
  bool any() const { return has_source || has_pressure || has_solid; }
};

/// Everything that the next step of a region depends on.
struct RegionState {
  Region region;
  std::vector<float> waves;                          ///< WaveSolver::State
  std::vector<float> foam;                           ///< (rows x columns)
  std::vector<float> before_m, between_m;            ///< likewise, or empty: it steps every tick
  std::vector<float> source_m;                       ///< (rows x columns), waiting
  std::shared_ptr<const sea::InteractionFlow> flow;  ///< that hulls feel; null: not made yet
};

/// Not thread-safe; published fields are. Hot: allocates nothing once as many fields are about as
/// readers hold.
class InteractionGrid {
 public:
  /// `spec` without what the region says; its step_s is the tick. InvalidArgument.
  static absl::StatusOr<std::unique_ptr<InteractionGrid>> Make(const Region& region,
                                                               SolverSpec spec,
                                                               const FoamOptions& foam);

  const Region& region() const { return region_; }
  void SetTraits(const RegionTraits& traits) { region_.traits = forcing_.traits = traits; }
  RegionForcing& forcing() { return forcing_; }
  InteractionFoam& foam() { return foam_; }

  /// The other's waves, foam and deposits where both lie; the other has none there afterwards.
  /// Pre: the same kind and cell_m.
  void Take(InteractionGrid& other);

  /// The `steps`th tick; the deposits are used up, but sources wait for the solver's next step.
  void Advance(std::int64_t steps);
  void AdvanceFoam(double span_s);
  /// Heights that are no longer numbers of this world become calm. True: so they were.
  bool CalmTheInsane();

  /// Adds what hulls feel: heights and the pressure heads put in, and the last published flow.
  void AddFelt(std::span<const Vec2d> places, std::span<sea::InteractionFelt> sum) const;
  std::shared_ptr<const sea::InteractionField> Publish();

  RegionState State() const;
  /// InvalidArgument: of another size.
  absl::Status Restore(const RegionState& state);
  void AddTo(Hash64& hash) const;

 private:
  InteractionGrid(const Region& region, std::unique_ptr<WaveSolver> solver, int ticks,
                  const FoamOptions& foam);
  void TakeDeposits(std::size_t at, InteractionGrid& other, std::size_t from);
  void StepSolver();
  void FindBetween(int tick);
  const std::shared_ptr<const sea::InteractionFlow>& Flow();
  std::shared_ptr<const std::vector<float>> PublishedFoam();
  std::span<const float> height_m() const {
    return ticks_ > 1 ? std::span<const float>(between_m_) : solver_->height_m();
  }

  Region region_;
  std::unique_ptr<WaveSolver> solver_;
  int ticks_;                                // that one step of the solver covers
  std::vector<float> before_m_, between_m_;  // heights before that step, and now; empty for 1
  std::vector<float> calm_;                  // the state without a wave
  InteractionFoam foam_;
  std::vector<float> source_m_, pressure_head_m_, solid_, rest_height_m_;
  RegionForcing forcing_;
  std::vector<std::shared_ptr<sea::InteractionField>> fields_;  // published, to be written again
  std::vector<std::shared_ptr<sea::InteractionFlow>> flows_;    // likewise
  std::shared_ptr<const sea::InteractionFlow> flow_;            // the last; null: not made yet
  bool is_flow_due_ = true;
  std::vector<std::shared_ptr<std::vector<float>>> foams_;  // likewise
  std::shared_ptr<const std::vector<float>> published_foam_;
};

}  // namespace onesea::world
