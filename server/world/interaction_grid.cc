#include "server/world/interaction_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/only_owner.h"
#include "common/sea/constants.h"
#include "server/world/iwave_design.h"

namespace onesea::world {
namespace {

// Arrays of one region that are written again: the present, what queries hold, and the past.
constexpr std::size_t kKept = 32;
constexpr float kHeightMaxM = 1e4f;  // no wave is higher than the sea is deep
// Solvers that step every tick have their flow looked at every so many.
constexpr int kFlowTicks = 3;

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

// One that nobody reads any more: to write anew into memory that the system has to find first costs
// more than to compute it.
template <typename T>
std::shared_ptr<T> Spare(std::vector<std::shared_ptr<T>>& kept) {
  for (const auto& one : kept) {
    if (IsOnlyOwner(one)) return one;
  }
  auto made = std::make_shared<T>();
  if (kept.size() < kKept) kept.push_back(made);
  return made;
}

}  // namespace

absl::StatusOr<std::unique_ptr<InteractionGrid>> InteractionGrid::Make(const Region& region,
                                                                       SolverSpec spec,
                                                                       const FoamOptions& foam) {
  spec.kind = region.kind;
  spec.cells = region.cells;
  spec.damping_per_s += region.damping_per_s;
  const int ticks = TicksPerStep(spec);
  spec.step_s *= ticks;
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<WaveSolver> solver, MakeSolver(spec));
  return std::unique_ptr<InteractionGrid>(
      new InteractionGrid(region, std::move(solver), ticks, foam));
}

InteractionGrid::InteractionGrid(const Region& region, std::unique_ptr<WaveSolver> solver,
                                 int ticks, const FoamOptions& foam)
    : region_(region),
      solver_(std::move(solver)),
      ticks_(ticks),
      calm_(solver_->State()),
      foam_(region.cells, foam) {
  const std::size_t cells = region_.cells.cells();
  for (auto* values : {&source_m_, &pressure_head_m_, &solid_, &rest_height_m_}) {
    values->resize(cells);
  }
  forcing_ = {region_.cells, region_.traits, source_m_, pressure_head_m_, solid_, rest_height_m_};
  if (ticks_ > 1) before_m_.resize(cells);
  if (ticks_ > 1) between_m_.resize(cells);
}

void InteractionGrid::Take(InteractionGrid& other) {
  const sea::CellRect both = sea::Intersection(region_.cells, other.region_.cells);
  if (both.cells() == 0) return;
  solver_->Adopt(*other.solver_);
  is_flow_due_ = other.is_flow_due_ = true;
  std::vector<float> state = other.solver_->State();
  const std::size_t plane = other.region_.cells.cells();
  for (std::int64_t j = both.south; j < both.north(); ++j) {
    for (std::int64_t i = both.west; i < both.east(); ++i) {
      const std::size_t to = region_.cells.IndexOf(i, j);
      const std::size_t from = other.region_.cells.IndexOf(i, j);
      for (std::size_t at = from; at < state.size(); at += plane) state[at] = other.calm_[at];
      float& share = foam_.shares()[to];
      share = std::max(share, std::exchange(other.foam_.shares()[from], 0.0f));
      if (ticks_ > 1) {
        before_m_[to] += std::exchange(other.before_m_[from], 0.0f);
        between_m_[to] += std::exchange(other.between_m_[from], 0.0f);
      }
      if (other.forcing_.any()) TakeDeposits(to, other, from);
    }
  }
  forcing_.has_source |= other.forcing_.has_source;
  forcing_.has_pressure |= other.forcing_.has_pressure;
  forcing_.has_solid |= other.forcing_.has_solid;
  other.solver_->Restore(state);
}

void InteractionGrid::TakeDeposits(std::size_t at, InteractionGrid& other, std::size_t from) {
  source_m_[at] += std::exchange(other.source_m_[from], 0.0f);
  pressure_head_m_[at] += std::exchange(other.pressure_head_m_[from], 0.0f);
  const float other_solid = std::exchange(other.solid_[from], 0.0f);
  if (other_solid > solid_[at]) {
    solid_[at] = other_solid;
    rest_height_m_[at] = other.rest_height_m_[from];
  }
}

void InteractionGrid::Advance(std::int64_t steps) {
  const int tick = static_cast<int>((steps - 1) % ticks_);  // of those that one step covers
  if (tick == 0) StepSolver();
  if (ticks_ > 1) FindBetween(tick + 1);
  if (ticks_ > 1 ? tick == 0 : steps % kFlowTicks == 0) is_flow_due_ = true;
  const auto clear = [](bool& has, std::vector<float>& values) {
    if (std::exchange(has, false)) std::fill(values.begin(), values.end(), 0.0f);
  };
  if (forcing_.has_solid) std::fill(rest_height_m_.begin(), rest_height_m_.end(), 0.0f);
  clear(forcing_.has_pressure, pressure_head_m_);
  clear(forcing_.has_solid, solid_);
  if (tick == 0) clear(forcing_.has_source, source_m_);
  forcing_.is_read = steps % ticks_ == 0;
}

void InteractionGrid::StepSolver() {
  StepForcing now;
  if (forcing_.has_source) now.source_m = source_m_;
  if (forcing_.has_pressure) now.pressure_head_m = pressure_head_m_;
  if (forcing_.has_solid) now.solid = solid_, now.rest_height_m = rest_height_m_;
  if (ticks_ > 1) {
    const auto height = solver_->height_m();
    std::copy(height.begin(), height.end(), before_m_.begin());
    // What is poured in is there at once.
    for (std::size_t n = 0; n < now.source_m.size(); ++n) before_m_[n] += now.source_m[n];
  }
  solver_->Step(now);
}

// The heights after `tick` of the ticks that the solver's last step covers.
void InteractionGrid::FindBetween(int tick) {
  const auto after = solver_->height_m();
  const float share = static_cast<float>(tick) / static_cast<float>(ticks_);
  if (tick == ticks_) {
    std::copy(after.begin(), after.end(), between_m_.begin());
    return;
  }
  for (std::size_t n = 0; n < between_m_.size(); ++n) {
    // Land stays exactly dry.
    between_m_[n] = after[n] == 0.0f ? 0.0f : before_m_[n] + share * (after[n] - before_m_[n]);
  }
}

void InteractionGrid::AdvanceFoam(double span_s) {
  foam_.Advance(span_s, solver_->height_m(), *Flow());
}

bool InteractionGrid::CalmTheInsane() {
  int insane = 0;
  for (const float height : solver_->height_m()) {
    insane |= static_cast<int>(!(std::abs(height) < kHeightMaxM));  // NaN is, too
  }
  if (insane == 0) return false;
  solver_->Restore(calm_);
  is_flow_due_ = true;
  std::fill(before_m_.begin(), before_m_.end(), 0.0f);
  std::fill(between_m_.begin(), between_m_.end(), 0.0f);
  return true;
}

void InteractionGrid::AddFelt(std::span<const Vec2d> places,
                              std::span<sea::InteractionFelt> sum) const {
  const std::span<const float> heads =
      forcing_.has_pressure ? std::span<const float>(pressure_head_m_) : std::span<const float>();
  sea::AddFelt(region_.cells, height_m(), heads, flow_.get(), places, sum);
}

// Made when it is looked at: it costs as much as a step of the cheaper solvers.
const std::shared_ptr<const sea::InteractionFlow>& InteractionGrid::Flow() {
  if (!std::exchange(is_flow_due_, false)) return flow_;
  const std::shared_ptr<sea::InteractionFlow> flow = Spare(flows_);
  for (auto* values : {&flow->x, &flow->y, &flow->z}) values->resize(region_.cells.cells());
  solver_->Velocity(flow->x, flow->y, flow->z);
  flow_ = flow;
  return flow_;
}

std::shared_ptr<const sea::InteractionField> InteractionGrid::Publish() {
  std::shared_ptr<sea::InteractionField> field = Spare(fields_);
  field->cells = region_.cells;
  const auto height = height_m();
  field->height_m.assign(height.begin(), height.end());
  field->flow = Flow();
  field->foam = PublishedFoam();
  return field;
}

std::shared_ptr<const std::vector<float>> InteractionGrid::PublishedFoam() {
  if (!foam_.any()) return nullptr;
  if (foam_.TakeChanged()) {
    const std::shared_ptr<std::vector<float>> copy = Spare(foams_);
    const auto shares = std::as_const(foam_).shares();
    copy->assign(shares.begin(), shares.end());
    published_foam_ = copy;
  }
  return published_foam_;
}

RegionState InteractionGrid::State() const {
  const auto foam = std::as_const(foam_).shares();
  return {region_, solver_->State(), {foam.begin(), foam.end()}, before_m_, between_m_, source_m_,
          flow_};
}

absl::Status InteractionGrid::Restore(const RegionState& state) {
  const std::size_t cells = region_.cells.cells();
  if (state.waves.size() != calm_.size() || state.foam.size() != cells ||
      state.before_m.size() != before_m_.size() || state.source_m.size() != cells ||
      state.between_m.size() != between_m_.size() ||
      (state.flow != nullptr && state.flow->x.size() != cells)) {
    return absl::InvalidArgumentError(absl::StrCat("region state of ", state.waves.size(), " and ",
                                                   state.foam.size(), " numbers, not ",
                                                   calm_.size(), " and ", cells));
  }
  solver_->Restore(state.waves);
  std::copy(state.foam.begin(), state.foam.end(), foam_.shares().begin());
  before_m_ = state.before_m;
  between_m_ = state.between_m;
  std::copy(state.source_m.begin(), state.source_m.end(), source_m_.begin());
  forcing_.has_source =
      std::any_of(source_m_.begin(), source_m_.end(), [](float source) { return source != 0.0f; });
  flow_ = state.flow;
  is_flow_due_ = flow_ == nullptr;
  return absl::OkStatus();
}

void InteractionGrid::AddTo(Hash64& hash) const {
  hash.Add(static_cast<std::uint8_t>(region_.kind));
  region_.cells.AddTo(hash);
  hash.Add(region_.damping_per_s);
  hash.AddFloats(solver_->State());
  hash.AddFloats(std::as_const(foam_).shares());
  if (forcing_.has_source) hash.AddFloats(source_m_);
  hash.AddFloats(before_m_);
  hash.AddFloats(between_m_);
  if (flow_ == nullptr) return;
  hash.AddFloats(flow_->x);
  hash.AddFloats(flow_->y);
}

}  // namespace onesea::world
