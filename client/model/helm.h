#pragma once

#include <cstdint>
#include <optional>

/// From keys to what a boat is told to do. No window, no network: time and keys are arguments.
namespace onesea::client {

/// Which keys are held.
struct HelmKeys {
  bool ahead = false, astern = false, port = false, starboard = false;
  friend bool operator==(const HelmKeys&, const HelmKeys&) = default;
};

/// What a boat is told: each in [-1, 1]; positive rudder turns to port.
struct HelmOrder {
  double throttle = 0.0, rudder = 0.0;
  friend bool operator==(const HelmOrder&, const HelmOrder&) = default;
};

/// A throttle lever that stays where it is left and a wheel that returns to the middle.
///
/// The lever stops in neutral until its key is pressed anew, so that whoever wants to stop does not
/// go astern. Both keys of a pair held are none.
class Helm {
 public:
  static constexpr double kThrottlePerS = 0.8;      ///< full ahead from neutral in 1.25 s
  static constexpr double kRudderPerS = 2.5;        ///< hard over from the middle in 0.4 s
  static constexpr double kRudderReturnPerS = 4.0;  ///< back to the middle in 0.25 s

  /// `seconds` of real time with these keys, at least 0; of more than 0.5 s only those count.
  void Advance(const HelmKeys& keys, double seconds);
  const HelmOrder& order() const { return order_; }
  void Reset() { *this = Helm(); }

 private:
  HelmOrder order_;
  int latched_ = 0;  // the direction that brought the lever to neutral and is still held
};

/// When an order must go to the server: when it changed, at most 20 times a second, and
/// unchanged often enough that the boat's lease doesn't run out.
class OrderTimer {
 public:
  static constexpr std::int64_t kSpacingNs = 50'000'000;  ///< 20 Hz: a step of the lever is 0.04
  static constexpr std::int64_t kReminderNs = 15'000'000'000;  ///< a quarter of a spawner's lease

  /// Asks with ascending times; after `true` the order counts as sent.
  bool MustSend(const HelmOrder& order, std::int64_t now_ns);
  /// The next order goes out whatever it is.
  void SendAgain() { sent_.reset(); }

 private:
  std::optional<HelmOrder> sent_;
  std::int64_t sent_ns_ = 0;
};

}  // namespace onesea::client
