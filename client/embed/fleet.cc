#include "client/embed/fleet.h"

#include <pthread.h>

#include <cmath>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/strings/str_format.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "client/embed/craft.h"
#include "common/base/clock.h"
#include "common/base/limits.h"

namespace onesea::client {
namespace {

// Between looks at what came back and what is due: less than orders are apart.
constexpr absl::Duration kLook = absl::Milliseconds(10);

absl::Status CheckShare(const char* name, double value) {
  if (value >= -1.0 && value <= 1.0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrFormat("%s is %g, it must be in [-1, 1]", name, value));
}

}  // namespace

// Outlives the fleet as long as somebody holds a body.
struct Fleet::Shared {
  std::string session;
  CommandSender::Call call;
  View view;
  absl::Mutex mutex;
  bool closed ABSL_GUARDED_BY(mutex) = false;
  std::unique_ptr<CommandSender> sender ABSL_GUARDED_BY(mutex);
  std::vector<std::shared_ptr<Craft>> crafts ABSL_GUARDED_BY(mutex);

  void Look() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex) {
    for (const CommandSender::Outcome& outcome : sender->Take()) {
      for (const std::shared_ptr<Craft>& craft : crafts) {
        if (craft->Take(outcome)) break;
      }
    }
    const std::shared_ptr<const WorldView> world = view();
    const std::int64_t now_ns = SystemClock().MonotonicNs();
    for (const std::shared_ptr<Craft>& craft : crafts) craft->Advance(now_ns, *world);
    std::erase_if(crafts, [](const std::shared_ptr<Craft>& craft) { return craft->over(); });
  }
};

class Fleet::Body final : public OwnBody {
 public:
  Body(std::shared_ptr<Shared> shared, std::shared_ptr<Craft> craft)
      : shared_(std::move(shared)), craft_(std::move(craft)) {}
  ~Body() override {
    Tell([](Craft& craft) { craft.LetGo(); });
  }

  std::uint32_t id() const override {
    absl::MutexLock lock(&shared_->mutex);
    return craft_->id();
  }
  absl::Status status() const override {
    absl::MutexLock lock(&shared_->mutex);
    if (shared_->closed) return absl::CancelledError("its sea was left");
    if (!craft_->status().ok()) return craft_->status();
    const std::string trouble = shared_->sender->trouble();
    return trouble.empty() ? absl::OkStatus() : absl::UnavailableError(trouble);
  }
  absl::Status Drive(double throttle, double rudder) override {
    absl::Status valid = CheckShare("throttle", throttle);
    valid.Update(CheckShare("rudder", rudder));
    if (valid.ok()) Tell([&](Craft& craft) { craft.Drive({throttle, rudder}); });
    return valid;
  }
  absl::Status Impulse(double x, double y, double z) override {
    for (const double part : {x, y, z}) {
      if (std::abs(part) <= kImpulseMaxNS) continue;
      return absl::InvalidArgumentError(absl::StrFormat(
          "impulse is (%g, %g, %g), each must be within ±%g N s", x, y, z, kImpulseMaxNS));
    }
    Tell([&](Craft& craft) { craft.Impulse({x, y, z}); });
    return absl::OkStatus();
  }
  void Remove() override {
    Tell([](Craft& craft) { craft.Remove(); });
  }

 private:
  template <typename What>
  void Tell(const What& what) {
    absl::MutexLock lock(&shared_->mutex);
    if (shared_->closed) return;
    what(*craft_);
    craft_->Advance(SystemClock().MonotonicNs(), *shared_->view());
  }

  const std::shared_ptr<Shared> shared_;
  const std::shared_ptr<Craft> craft_;
};

Fleet::Fleet(std::string session, CommandSender::Call call, View view)
    : shared_(std::make_shared<Shared>()) {
  shared_->session = std::move(session);
  shared_->call = std::move(call);
  shared_->view = std::move(view);
}

Fleet::~Fleet() {
  std::unique_ptr<CommandSender> sender;
  {
    absl::MutexLock lock(&shared_->mutex);
    for (const std::shared_ptr<Craft>& craft : shared_->crafts) craft->LetGo();
    const auto all_gone = [this]() ABSL_SHARED_LOCKS_REQUIRED(shared_->mutex) {
      return shared_->crafts.empty();
    };
    shared_->mutex.AwaitWithTimeout(absl::Condition(&all_gone), absl::Seconds(kPartingS));
    shared_->closed = true;
    sender = std::move(shared_->sender);
  }
  if (thread_.joinable()) thread_.join();
}

std::unique_ptr<OwnBody> Fleet::Spawn(wire::SpawnBody spawn, bool wake) {
  return Add(std::move(spawn), wake);
}

std::unique_ptr<OwnBody> Fleet::Take(std::uint32_t id, std::string holder) {
  return Add(id, std::move(holder));
}

template <typename... Arguments>
std::unique_ptr<OwnBody> Fleet::Add(Arguments&&... arguments) {
  absl::MutexLock lock(&shared_->mutex);
  if (shared_->sender == nullptr) {
    shared_->sender = std::make_unique<CommandSender>(shared_->session, shared_->call);
    thread_ = std::thread([this] { Run(); });
  }
  const auto send = [sender = shared_->sender.get()](wire::WorldCommand command,
                                                     std::string lease) {
    return sender->Send(std::move(command), std::move(lease));
  };
  auto craft = std::make_shared<Craft>(send, std::forward<Arguments>(arguments)...);
  shared_->crafts.push_back(craft);
  return std::make_unique<Body>(shared_, std::move(craft));
}

void Fleet::Run() {
  pthread_setname_np(pthread_self(), "sea-fleet");
  absl::MutexLock lock(&shared_->mutex);
  const auto has_work = [this]() ABSL_SHARED_LOCKS_REQUIRED(shared_->mutex) {
    return shared_->closed || !shared_->crafts.empty();
  };
  while (true) {
    shared_->mutex.Await(absl::Condition(&has_work));
    if (shared_->closed) return;
    shared_->Look();
    shared_->mutex.AwaitWithTimeout(absl::Condition(&shared_->closed), kLook);
  }
}

}  // namespace onesea::client
