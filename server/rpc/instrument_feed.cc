#include "server/rpc/instrument_feed.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/wire/bounds.h"

namespace onesea::server {

InstrumentFeed::InstrumentFeed(const wire::InstrumentRequest& request, const SessionLoop& session,
                               std::shared_ptr<QueryEngine> engine, Worker& worker,
                               std::function<void()> wake)
    : water_level_(session.water_level().begin(), session.water_level().end()),
      ticks_per_reading_(request.ticks_per_reading),
      engine_(std::move(engine)),
      worker_(worker),
      reader_(request.instruments),
      wake_(std::move(wake)) {
  SessionView now = session.View();
  absl::MutexLock lock(&mutex_);
  last_tick_ = now.tick;
  last_world_ = std::move(now.world);
}

void InstrumentFeed::OnTick(const TickEvent& event) {
  absl::MutexLock lock(&mutex_);
  const Tick tick = event.stamp.tick;
  if (tick <= last_tick_) return;  // time stands still
  std::shared_ptr<const world::WorldView> before = std::exchange(last_world_, event.world);
  if (std::exchange(last_tick_, tick) + 1 != tick) before = nullptr;
  if (tick % ticks_per_reading_ != 0) return;
  if (moments_.size() >= kMomentsMax) {
    ++moments_skipped_;
  } else {
    moments_.push_back({tick, event.components, event.world, std::move(before),
                        std::exchange(moments_skipped_, 0)});
  }
  PostReading();
}

// Refused: the worker is busy, and the next moment tries again.
void InstrumentFeed::PostReading() {
  if (at_worker_ || moments_.empty()) return;
  at_worker_ = worker_.Post([self = shared_from_this()] { self->ReadMoment(); }).ok();
}

void InstrumentFeed::ReadMoment() {
  Moment moment;
  {
    absl::MutexLock lock(&mutex_);
    moment = std::move(moments_.front());
    moments_.pop_front();
  }
  InstrumentMoment seen{.tick = moment.tick,
                        .components = moment.components,
                        .interaction = moment.world->interaction.get(),
                        .water_level = water_level_,
                        .bodies = moment.world->bodies,
                        .before = {}};
  if (moment.before != nullptr) seen.before = moment.before->bodies;
  Keep({moment.tick, reader_.Read(*engine_, seen), moment.skipped_count});
  {
    absl::MutexLock lock(&mutex_);
    at_worker_ = false;
    PostReading();
  }
  Wake();  // also if the session ended meanwhile
}

void InstrumentFeed::Keep(Reading reading) {
  absl::MutexLock lock(&mutex_);
  if (readings_.size() >= kReadingsMax) {
    readings_skipped_ += reading.skipped_count + 1;
    return;
  }
  reading.skipped_count += std::exchange(readings_skipped_, 0);
  readings_.push_back(std::move(reading));
}

void InstrumentFeed::OnClosed(std::string_view reason) {
  {
    absl::MutexLock lock(&mutex_);
    status_ = absl::NotFoundError(absl::StrCat("session: it ended: ", wire::Text(reason)));
  }
  Wake();
}

std::optional<Reading> InstrumentFeed::Next() {
  absl::MutexLock lock(&mutex_);
  if (readings_.empty()) return std::nullopt;
  Reading next = std::move(readings_.front());
  readings_.pop_front();
  return next;
}

absl::Status InstrumentFeed::status() const {
  absl::MutexLock lock(&mutex_);
  // Moments that the worker refused are never read once the session is over.
  const bool all_told = !at_worker_ && readings_.empty();
  return all_told ? status_ : absl::OkStatus();
}

void InstrumentFeed::Wake() {
  absl::MutexLock lock(&wake_mutex_);
  if (wake_ != nullptr) wake_();
}

void InstrumentFeed::StopWaking() {
  absl::MutexLock lock(&wake_mutex_);
  wake_ = nullptr;
}

}  // namespace onesea::server
