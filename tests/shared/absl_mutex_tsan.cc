// Tells the thread sanitizer about absl::Mutex and absl::CondVar. Linked into every test of the
// tsan preset (onesea_test), into nothing else.
//
// Problem: the distribution's Abseil was built without the sanitizer, so its mutexes order nothing
// in the sanitizer's eyes and every guarded variable looks like a race.
// Idea: Abseil is a shared library, so definitions in the program stand before its own: these
// announce the operation and pass it on. Between an announcement and its end the sanitizer looks
// away, which also covers conditions that Abseil evaluates for another thread while it holds the
// mutex. gRPC's mutexes are Abseil's, so they are announced too.
// Limits: what is not here is not announced: Notification, BlockingCounter and the *LockWhen*
// functions (only tests of rpc use the first). Other uninstrumented libraries
// stay invisible, and gRPC's lock-free queues with them: CONTRIBUTING.md says what its reports are
// worth.
#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>

#include <string>

#include "absl/base/options.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "common/base/check.h"

namespace {

#define ONESEA_QUOTE_INNER(text) #text
#define ONESEA_QUOTE(text) ONESEA_QUOTE_INNER(text)

// Abseil's own definition of absl::`mangled`, which a C++ ABI makes an ordinary function.
template <typename Function>
Function* Real(const std::string& mangled) {
  const std::string version = ONESEA_QUOTE(ABSL_OPTION_INLINE_NAMESPACE_NAME);
  const std::string name = "_ZN4absl" + std::to_string(version.size()) + version + mangled;
  void* const found = dlsym(RTLD_NEXT, name.c_str());
  ONESEA_CHECK(found != nullptr) << name
                                 << " is in no shared library: is Abseil linked statically?";
  return reinterpret_cast<Function*>(found);
}

class Announced {
 public:
  enum class Kind { kLock, kUnlock };

  Announced(absl::Mutex* mutex, Kind kind, unsigned flags = 0)
      : mutex_(mutex), kind_(kind), flags_(flags) {
    kind_ == Kind::kLock ? __tsan_mutex_pre_lock(mutex_, flags_)
                         : static_cast<void>(__tsan_mutex_pre_unlock(mutex_, flags_));
  }
  ~Announced() {
    kind_ == Kind::kLock ? __tsan_mutex_post_lock(mutex_, flags_, 0)
                         : __tsan_mutex_post_unlock(mutex_, flags_);
  }
  void Failed() { flags_ |= __tsan_mutex_try_lock_failed; }

 private:
  absl::Mutex* mutex_;
  Kind kind_;
  unsigned flags_;
};

// Abseil builds some waits on others, which then come here a second time.
thread_local const absl::Mutex* waits_for = nullptr;

struct WaitMark {
  explicit WaitMark(const absl::Mutex* mutex) { waits_for = mutex; }
  ~WaitMark() { waits_for = nullptr; }
};

// A wait gives the mutex back and takes it again.
template <typename Wait>
auto Waiting(absl::Mutex* mutex, Wait wait) {
  if (waits_for == mutex) return wait();
  const WaitMark mark(mutex);
  { const Announced unlock(mutex, Announced::Kind::kUnlock); }
  const Announced lock(mutex, Announced::Kind::kLock);
  return wait();
}

}  // namespace

namespace absl {
ABSL_NAMESPACE_BEGIN

Mutex::~Mutex() {
  static auto* const real = Real<void(Mutex*)>("5MutexD1Ev");
  __tsan_mutex_destroy(this, 0);
  real(this);
}

void Mutex::Lock() {
  static auto* const real = Real<void(Mutex*)>("5Mutex4LockEv");
  const Announced lock(this, Announced::Kind::kLock);
  real(this);
}

void Mutex::Unlock() {
  static auto* const real = Real<void(Mutex*)>("5Mutex6UnlockEv");
  const Announced unlock(this, Announced::Kind::kUnlock);
  real(this);
}

bool Mutex::TryLock() {
  static auto* const real = Real<bool(Mutex*)>("5Mutex7TryLockEv");
  Announced lock(this, Announced::Kind::kLock, __tsan_mutex_try_lock);
  const bool locked = real(this);
  if (!locked) lock.Failed();
  return locked;
}

void Mutex::ReaderLock() {
  static auto* const real = Real<void(Mutex*)>("5Mutex10ReaderLockEv");
  const Announced lock(this, Announced::Kind::kLock, __tsan_mutex_read_lock);
  real(this);
}

void Mutex::ReaderUnlock() {
  static auto* const real = Real<void(Mutex*)>("5Mutex12ReaderUnlockEv");
  const Announced unlock(this, Announced::Kind::kUnlock, __tsan_mutex_read_lock);
  real(this);
}

void Mutex::Await(const Condition& condition) {
  static auto* const real = Real<void(Mutex*, const Condition&)>("5Mutex5AwaitERKNS0_9ConditionE");
  Waiting(this, [&] { real(this, condition); });
}

bool Mutex::AwaitWithTimeout(const Condition& condition, Duration timeout) {
  static auto* const real = Real<bool(Mutex*, const Condition&, Duration)>(
      "5Mutex16AwaitWithTimeoutERKNS0_9ConditionENS0_8DurationE");
  return Waiting(this, [&] { return real(this, condition, timeout); });
}

bool Mutex::AwaitWithDeadline(const Condition& condition, Time deadline) {
  static auto* const real = Real<bool(Mutex*, const Condition&, Time)>(
      "5Mutex17AwaitWithDeadlineERKNS0_9ConditionENS0_4TimeE");
  return Waiting(this, [&] { return real(this, condition, deadline); });
}

void CondVar::Wait(Mutex* mutex) {
  static auto* const real = Real<void(CondVar*, Mutex*)>("7CondVar4WaitEPNS0_5MutexE");
  Waiting(mutex, [&] { real(this, mutex); });
}

bool CondVar::WaitWithTimeout(Mutex* mutex, Duration timeout) {
  static auto* const real = Real<bool(CondVar*, Mutex*, Duration)>(
      "7CondVar15WaitWithTimeoutEPNS0_5MutexENS0_8DurationE");
  return Waiting(mutex, [&] { return real(this, mutex, timeout); });
}

bool CondVar::WaitWithDeadline(Mutex* mutex, Time deadline) {
  static auto* const real =
      Real<bool(CondVar*, Mutex*, Time)>("7CondVar16WaitWithDeadlineEPNS0_5MutexENS0_4TimeE");
  return Waiting(mutex, [&] { return real(this, mutex, deadline); });
}

ABSL_NAMESPACE_END
}  // namespace absl
