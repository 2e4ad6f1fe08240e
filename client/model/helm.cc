#include "client/model/helm.h"

#include <algorithm>

namespace onesea::client {
namespace {

// After a stall of the program nobody wants the lever to have gone all the way.
constexpr double kSecondsMax = 0.5;

double Towards(double value, double target, double step) {
  return value < target ? std::min(value + step, target) : std::max(value - step, target);
}

}  // namespace

void Helm::Advance(const HelmKeys& keys, double seconds) {
  if (!(seconds > 0.0)) return;
  seconds = std::min(seconds, kSecondsMax);
  const int lever = (keys.ahead ? 1 : 0) - (keys.astern ? 1 : 0);
  if (lever != latched_) latched_ = 0;
  if (lever != 0 && latched_ == 0) {
    const bool crosses = order_.throttle * lever < 0.0;
    order_.throttle = Towards(order_.throttle, crosses ? 0.0 : lever, kThrottlePerS * seconds);
    if (crosses && order_.throttle == 0.0) latched_ = lever;
  }
  const int wheel = (keys.port ? 1 : 0) - (keys.starboard ? 1 : 0);
  const bool returns = order_.rudder * wheel <= 0.0;
  // From the wrong side the wheel first comes back, at the speed at which it would by itself.
  const double rate = returns && order_.rudder != 0.0 ? kRudderReturnPerS : kRudderPerS;
  order_.rudder = Towards(order_.rudder, wheel, rate * seconds);
}

bool OrderTimer::MustSend(const HelmOrder& order, std::int64_t now_ns) {
  const std::int64_t since_ns = now_ns - sent_ns_;
  if (sent_ && since_ns < (order == *sent_ ? kReminderNs : kSpacingNs)) return false;
  sent_ = order;
  sent_ns_ = now_ns;
  return true;
}

}  // namespace onesea::client
