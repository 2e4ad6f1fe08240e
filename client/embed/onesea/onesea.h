#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "onesea/bodies.h"

/// Join a session of a sea and ask for heights in your own process, with no round trip:
///
///   #include <onesea/onesea.h>
///
///   auto sea = onesea::Join("127.0.0.1:7310");
///   if (!sea.ok()) return Fail(sea.status());
///   double height_m = (*sea)->HeightAt(12.0, -7.5);
///
/// CMake: find_package(onesea REQUIRED) and target_link_libraries(game PRIVATE onesea::client).
///
/// Heights are the server's: the waves, lowered over the session's terrain if it has one, the water
/// level (tide), and the wakes and splashes of bodies, which come as a stream of some tens of
/// kilobytes a second. Water::layers says what is in a height. Bodies are in bodies.h:
///
///   auto boat = (*sea)->Spawn({.preset = "boat", .x_m = 20.0});
///   (*boat)->Drive(0.8, 0.0);
///
/// World frame: x east, y north, z up [m]; z = 0 is the mean water level. Time is sea time: seconds
/// since the session's tick 0. Everything is thread-safe.
namespace onesea {

struct JoinOptions {
  std::string session = {};      ///< empty: the server's only session
  std::string client_name = {};  ///< for the server's logs, and the owner of your bodies
  double timeout_s = 10.0;       ///< of Join(), (0, 3600]; afterwards reconnection goes on for ever
  bool world = true;             ///< false: neither wakes nor bodies, for a few bytes a second
  /// Called with a line for people when the connection is lost or found again, the weather changes,
  /// or this process can no longer follow. From a thread of the library: be quick, and do not
  /// destroy the sea there.
  std::function<void(const std::string& line)> on_event = {};
};

struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// What Sample() fills in beside heights.
enum class Detail : std::uint8_t { kHeight = 1, kNormal = 2, kVelocity = 3 };

/// What a height contains: a bit set.
enum Layer : std::uint32_t {
  kLayerWaves = 1,       ///< the spectral sea, always
  kLayerWakes = 2,       ///< wakes and splashes: the interaction layer
  kLayerTerrain = 4,     ///< the waves are lowered over terrain
  kLayerWaterLevel = 8,  ///< a mean level that is not 0
};

struct Water {
  double height_m = 0.0;               ///< of the top sheet above the place
  double normal[3] = {0.0, 0.0, 1.0};  ///< unit; from kNormal on
  /// Of the surface water, with the current, without the wakes' own; from kVelocity on.
  double velocity_m_per_s[3] = {0, 0, 0};
  double wakes_m = 0.0;      ///< what wakes and splashes add; in height_m
  std::uint32_t layers = 0;  ///< of Layer
  bool folded = false;       ///< several sheets of waves here; the top one answers
  bool dry = false;          ///< land that no water covers; the height is the water's around
};

/// What SampleAtDepth() fills in; of waves alone, as the server's answers are.
struct Underwater {
  double velocity_m_per_s[3] = {0, 0, 0};  ///< of the water particle, with the current
  double dynamic_pressure_pa = 0.0;        ///< without the hydrostatic part
  bool dry = false;                        ///< above the surface or in dry land: zeros
};

/// How far this process's sea is from the server's.
struct DriftReport {
  std::int64_t comparisons = 0;  ///< with heights that the server sent, one a second
  double last_m = 0.0;           ///< worst place of the last comparison
  double worst_m = 0.0;          ///< worst of all
  double clock_error_s =
      0.0;  ///< bound of the error of Now(): half the least round trip; < 0: not known yet
};

struct SessionReport {
  std::string name;
  std::string sea_name;
  int tick_rate_hz = 0;
  double hs_m = 0.0;                 ///< significant wave height now
  std::uint64_t component_hash = 0;  ///< equal in every process of the session
  std::vector<Place> probes;
  bool connected = false;
  std::int64_t connection_count = 0;  ///< 1 after Join(), one more for every reconnection
  std::int64_t bytes_received = 0;    ///< of frames, since Join()
  /// Sea time of the last news of wakes and bodies: some 30 a second, a ping old. 0: none yet.
  double news_time_s = 0.0;
};

/// One session's sea in this process. Leaves the session when destroyed.
class Sea {
 public:
  virtual ~Sea() = default;

  /// The server's sea time now [s], from synchronised clocks; never goes back while the session
  /// goes on.
  virtual double Now() const = 0;

  /// Height of the surface [m] now. NaN for a place that isn't finite or farther than 1e7 m, after
  /// status() failed, and while a terrain that the session changed to is still on its way. Waves
  /// are interpolated linearly between moments 1/60 s apart: 0.35 mm at an acceleration of 1 g;
  /// wakes go on from the last news for two frames. Cost: some µs, and one synthesis (about 1 ms
  /// at the default resolution) per 1/60 s of sea time. For many places at once Sample() is far
  /// cheaper a place.
  virtual double HeightAt(double x_m, double y_m) const = 0;

  /// The same at sea time `time_s`, past or future, within 3.2e9 s of tick 0, waves not
  /// interpolated in time. A first call for a time costs one synthesis; the last few times are
  /// kept. Wakes are known of the last second: linear in time between news; from the last news they
  /// go on for at most 0.1 s, stand until they are 1.5 s old (of sea time), and fade within as much
  /// again. Other moments have none.
  virtual double HeightAt(double x_m, double y_m, double time_s) const = 0;

  /// out[n] answers places[n] at `time_s`. InvalidArgument naming the place or time that is out of
  /// range, or if the sizes differ; FailedPrecondition after status() failed; Unavailable while a
  /// terrain that the session changed to is still on its way.
  virtual absl::Status Sample(std::span<const Place> places, double time_s, Detail detail,
                              std::span<Water> out) const = 0;

  /// out[n] answers places[n], depth_m[n] below the mean water level, in [0, 12000]. The exact sum
  /// over all waves: about 15 µs a place. Errors as in Sample().
  virtual absl::Status SampleAtDepth(std::span<const Place> places, std::span<const double> depth_m,
                                     double time_s, std::span<Underwater> out) const = 0;

  /// Bound [m] of the error of heights at `time_s`, where the waves do not fold: of the waves
  /// against their exact sum (the server's answer has the same error), and of wakes, if they are
  /// in, against the server's at a moment that news tell of. Between news 1/30 s apart wakes of
  /// period T are off by (0.07 s / T)² more of themselves; now, some 20 ms after the last news, by
  /// a percent of themselves (docs/embedding.md).
  virtual double HeightErrorBound(double time_s) const = 0;

  /// All bodies now, ascending by id; between news on smooth curves, after them by their velocities
  /// for 1.5 s. None while JoinOptions::world is false.
  virtual std::vector<Body> Bodies() const = 0;
  /// At sea time `time_s`; of past moments only the last two news of a body are known.
  virtual std::vector<Body> Bodies(double time_s) const = 0;
  /// None: no such body. Cheaper than all of them.
  virtual std::optional<Body> FindBody(std::uint32_t id) const = 0;

  /// Asks the server for a new body, which this process then commands. Does not wait.
  /// InvalidArgument for an option out of range; what the server thinks of it is in
  /// OwnBody::status().
  virtual absl::StatusOr<std::unique_ptr<OwnBody>> Spawn(const SpawnOptions& options) = 0;
  /// Asks the server for the lease of a body that is there. Does not wait. InvalidArgument if `id`
  /// is 0; PermissionDenied (in OwnBody::status()) while somebody else holds it.
  virtual absl::StatusOr<std::unique_ptr<OwnBody>> Take(std::uint32_t id) = 0;

  /// OK, or why this process can't show the session's sea any more: its components differ
  /// (FailedPrecondition), the session was deleted (NotFound). A lost connection is not a failure:
  /// the sea goes on and reconnects.
  virtual absl::Status status() const = 0;

  virtual DriftReport drift() const = 0;
  virtual SessionReport session() const = 0;
};

/// Joins and waits for the first correct height: one round trip, building the components (about 40
/// ms per wave system) and, beside them, the exchange of clocks; then the session's terrain, if it
/// has one (up to 64 MB).
///
/// Unavailable: no server answers, or not in time. NotFound: no such session. InvalidArgument:
/// several sessions and no name, or an option out of range. FailedPrecondition: this process would
/// build another sea; the message has both hashes.
absl::StatusOr<std::unique_ptr<Sea>> Join(const std::string& address,
                                          const JoinOptions& options = {});

}  // namespace onesea
