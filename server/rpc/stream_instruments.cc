#include "server/rpc/stream_instruments.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/proto_world.h"
#include "server/rpc/status_map.h"

namespace onesea::server {
namespace {

std::uint32_t BodyOf(const wire::Instrument& instrument) {
  return std::visit(
      [](const auto& one) -> std::uint32_t {
        if constexpr (requires { one.body_id; }) return one.body_id;
        return 0;
      },
      instrument);
}

absl::Status CheckBodies(const wire::InstrumentRequest& request,
                         const std::vector<wire::BodyView>& bodies) {
  for (std::size_t n = 0; n < request.instruments.size(); ++n) {
    const std::uint32_t id = BodyOf(request.instruments[n]);
    if (id == 0 || wire::FindBody(bodies, id) != nullptr) continue;
    return absl::NotFoundError(absl::StrCat("instruments[", n, "].body_id: there is no body ", id));
  }
  return absl::OkStatus();
}

}  // namespace

void StreamInstrumentsReactor::Begin(StreamInstrumentsReactor* reactor,
                                     const v1::StreamInstrumentsRequest& request) {
  absl::StatusOr<wire::InstrumentRequest> asked = wire::FromProto(request);
  absl::Status status = asked.status();
  if (status.ok()) {
    status = reactor->worker_.Post([reactor, asked = *std::move(asked)] { reactor->Start(asked); });
  }
  if (!status.ok()) reactor->End(status);
}

void StreamInstrumentsReactor::Start(const wire::InstrumentRequest& request) {
  const absl::Status status = Observe(request);
  if (!status.ok()) return End(status);
  StartSendInitialMetadata();  // from here on no tick is missed
  const std::shared_ptr<InstrumentFeed> feed = feed_;
  {
    absl::MutexLock lock(&mutex_);
    beginning_ = false;
  }
  // The call may be over and this reactor gone; the feed knows.
  feed->Wake();
}

absl::Status StreamInstrumentsReactor::Observe(const wire::InstrumentRequest& request) {
  ONESEA_ASSIGN_OR_RETURN(session_, registry_.Find(request.session));
  ONESEA_RETURN_IF_ERROR(CheckBodies(request, session_->View().world->bodies));
  feed_ = std::make_shared<InstrumentFeed>(request, *session_, desk_.EngineOf(session_), worker_,
                                           [this] { Advance(); });
  session_->AddObserver(feed_);
  return absl::OkStatus();
}

// Writes what there is, or ends. From any thread.
void StreamInstrumentsReactor::Advance() {
  absl::Status end;
  {
    absl::MutexLock lock(&mutex_);
    if (beginning_ || writing_ || finished_) return;
    end = cancelled_ ? absl::CancelledError("the caller went away") : feed_->status();
    if (end.ok()) {
      const std::optional<Reading> reading = feed_->Next();
      if (!reading) return;
      writing_ = true;
      response_.set_tick(reading->tick);
      response_.mutable_values()->Assign(reading->values.begin(), reading->values.end());
      response_.set_skipped_count(reading->skipped_count);
      StartWrite(&response_);
      return;
    }
  }
  End(end);
}

void StreamInstrumentsReactor::End(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (std::exchange(finished_, true)) return;
  }
  Finish(ToGrpc(status));
}

void StreamInstrumentsReactor::OnWriteDone(bool ok) {
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    if (!ok) cancelled_ = true;
  }
  Advance();
}

void StreamInstrumentsReactor::OnCancel() {
  {
    absl::MutexLock lock(&mutex_);
    cancelled_ = true;
  }
  Advance();
}

void StreamInstrumentsReactor::OnDone() {
  if (feed_ == nullptr) {
    delete this;
    return;
  }
  feed_->StopWaking();
  // The session's lock may take a tick: not for a thread of gRPC's.
  const auto leave = [session = session_, feed = feed_] { session->RemoveObserver(feed.get()); };
  if (!worker_.Post(leave).ok()) leave();
  delete this;
}

}  // namespace onesea::server
