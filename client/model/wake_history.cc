#include "client/model/wake_history.h"

#include <algorithm>
#include <utility>

namespace onesea::client {
namespace {

// Samples are cubic in both directions, with weights whose amounts add to 5/4 at most in each.
constexpr double kSplineGain = 25.0 / 16.0;

bool IsSame(const sea::InteractionField& a, const wire::RegionField& b) {
  const bool same_foam = a.foam == nullptr ? b.foam.empty() : *a.foam == b.foam;
  return a.cells == b.layout.cells && a.height_m == b.height_m && same_foam;
}

std::shared_ptr<const sea::InteractionField> Copy(const wire::RegionField& field) {
  auto copy = std::make_shared<sea::InteractionField>();
  copy->cells = field.layout.cells;
  copy->height_m = field.height_m;
  if (!field.foam.empty()) copy->foam = std::make_shared<const std::vector<float>>(field.foam);
  return copy;
}

// Does the water that one region moves meet the other's? It reaches two cells out.
bool Meet(const sea::CellRect& a, const sea::CellRect& b) {
  const auto overlap = [&](std::int64_t a_low, int a_count, std::int64_t b_low, int b_count) {
    const double a_from = static_cast<double>(a_low - 2) * a.cell_m;
    const double b_from = static_cast<double>(b_low - 2) * b.cell_m;
    return a_from < b_from + (b_count + 4) * b.cell_m && b_from < a_from + (a_count + 4) * a.cell_m;
  };
  return overlap(a.west, a.columns, b.west, b.columns) && overlap(a.south, a.rows, b.south, b.rows);
}

// A cell is within a step of the server's; where regions overlap, heights add.
double HeightErrorBound(std::span<const wire::RegionField> fields) {
  double worst_m = 0.0;
  for (const wire::RegionField& field : fields) {
    double sum_m = 0.0;
    for (const wire::RegionField& other : fields) {
      if (Meet(field.layout.cells, other.layout.cells)) sum_m += other.layout.height_step_m;
    }
    worst_m = std::max(worst_m, sum_m);
  }
  return kSplineGain * worst_m;
}

void AddTo(sea::InteractionSample& sum, double weight, const sea::InteractionSample& sample) {
  sum.height_m += weight * sample.height_m;
  sum.slope = sum.slope + weight * sample.slope;
  sum.foam += weight * sample.foam;
}

}  // namespace

WakeHistory::WakeHistory() { Add({}, {}, {}); }

WakeHistory::Moment WakeHistory::AfterLast(SimTime time) const {
  const Update& last = updates_.back();
  const double age_s = (time - last.time).Seconds();
  Moment moment;
  moment.strength = std::clamp(2.0 - age_s / kStandsS, 0.0, 1.0);
  if (moment.strength == 0.0) return {};
  moment.before = moment.after = last.snapshot.get();
  moment.height_error_m = last.height_error_m;
  if (updates_.size() < 2 || last.is->fields.empty()) return moment;
  const double span_s = (last.time - updates_[updates_.size() - 2].time).Seconds();
  moment.was = last.was.get();
  moment.is = last.is.get();
  moment.ahead = std::min({age_s / span_s, kAheadUpdates, kAheadMaxS / span_s});
  return moment;
}

WakeHistory::Moment WakeHistory::MomentAt(SimTime time) const {
  const auto after = std::find_if(updates_.begin(), updates_.end(),
                                  [&](const Update& update) { return time <= update.time; });
  Moment moment;
  if (after == updates_.end()) {
    moment = AfterLast(time);
  } else if (after->time == time) {
    moment.before = moment.after = after->snapshot.get();
    moment.height_error_m = after->height_error_m;
  } else if (after != updates_.begin()) {
    const Update& before = after[-1];
    moment.before = before.snapshot.get();
    moment.after = after->snapshot.get();
    moment.share = (time - before.time).Seconds() / (after->time - before.time).Seconds();
    moment.height_error_m = std::max(before.height_error_m, after->height_error_m);
  }
  const bool is_calm = !moment || (moment.before->fields.empty() && moment.after->fields.empty());
  return is_calm ? Moment{} : moment;
}

sea::InteractionSample WakeHistory::SampleAt(const Moment& moment, Vec2d place) {
  if (!moment) return {};
  sea::InteractionSample sum = sea::SampleInteraction(*moment.before, place);
  if (moment.before != moment.after) {
    const sea::InteractionSample before = std::exchange(sum, {});
    AddTo(sum, 1.0 - moment.share, before);
    AddTo(sum, moment.share, sea::SampleInteraction(*moment.after, place));
  }
  if (moment.ahead > 0.0) {
    AddTo(sum, moment.ahead, sea::SampleInteraction(*moment.is, place));
    AddTo(sum, -moment.ahead, sea::SampleInteraction(*moment.was, place));
    sum.foam = std::clamp(sum.foam, 0.0, 1.0);
  }
  if (moment.strength != 1.0) {
    const sea::InteractionSample full = std::exchange(sum, {});
    AddTo(sum, moment.strength, full);
  }
  return sum;
}

const WakeHistory::Update* WakeHistory::Last() const {
  return updates_.empty() ? nullptr : &updates_.back();
}

// Fields of the update before are shared where they are the same, and copied where not, since the
// store of the fields goes on changing.
WakeHistory::Update WakeHistory::Compared(std::span<const wire::RegionField> fields) const {
  auto snapshot = std::make_shared<sea::InteractionSnapshot>();
  auto was = std::make_shared<sea::InteractionSnapshot>();
  auto is = std::make_shared<sea::InteractionSnapshot>();
  Update update;
  for (const wire::RegionField& field : fields) {
    const Region* const old = Find(field.layout.id);
    const bool is_same = old != nullptr && IsSame(*old->field, field);
    Region region{.id = field.layout.id,
                  .field = is_same ? old->field : Copy(field),
                  .changed = old != nullptr && !is_same};
    snapshot->fields.push_back(region.field);
    if (region.changed && old->changed) {
      was->fields.push_back(old->field);
      is->fields.push_back(region.field);
    }
    update.regions.push_back(std::move(region));
  }
  update.snapshot = std::move(snapshot);
  update.was = std::move(was);
  update.is = std::move(is);
  return update;
}

const WakeHistory::Region* WakeHistory::Find(std::uint32_t id) const {
  if (Last() == nullptr) return nullptr;
  const auto found = std::ranges::find(Last()->regions, id, &Region::id);
  return found == Last()->regions.end() ? nullptr : &*found;
}

void WakeHistory::Add(SimTime time, std::span<const wire::RegionField> fields, SimTime past) {
  Update update = Compared(fields);
  if (Last() != nullptr && Last()->time == time) {
    // The sea stands still, or the newer one holds.
    if (update.snapshot->fields == Last()->snapshot->fields) return;
    updates_.pop_back();
    update = Compared(fields);
  }
  update.time = time;
  update.height_error_m = HeightErrorBound(fields);
  updates_.push_back(std::move(update));
  // The one before the oldest is the other end of the way to it.
  const SimTime oldest = time - past;
  while (updates_.size() > 2 && updates_[1].time <= oldest) updates_.erase(updates_.begin());
}

}  // namespace onesea::client
