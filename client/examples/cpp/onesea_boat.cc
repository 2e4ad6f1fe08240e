// A boat of this process: put into the water, driven for ten seconds, taken out again.
//
//   onesea_boat [HOST:PORT]

#include <onesea/onesea.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

int main(int argc, char** argv) {
  auto sea = onesea::Join(argc > 1 ? argv[1] : "127.0.0.1:7310");
  if (!sea.ok()) {
    std::fprintf(stderr, "%s\n", sea.status().ToString().c_str());
    return 1;
  }
  auto boat = (*sea)->Spawn({.preset = "boat", .x_m = 20.0, .name = "example"});
  if (!boat.ok()) {
    std::fprintf(stderr, "%s\n", boat.status().ToString().c_str());
    return 1;
  }
  (*boat)->Drive(0.7, 0.1).IgnoreError();  // goes as soon as the boat is there
  for (int frame = 0; frame < 600; ++frame) {
    std::this_thread::sleep_for(std::chrono::microseconds(16'667));
    if (const absl::Status status = (*boat)->status();
        !status.ok() && !absl::IsUnavailable(status)) {
      std::fprintf(stderr, "%s\n", status.ToString().c_str());
      return 1;
    }
    const std::optional<onesea::Body> body = (*sea)->FindBody((*boat)->id());
    if (!body || frame % 30 != 0) continue;
    double bow_m[3], astern_m[3];
    body->PointOf(2.4, 0.0, 0.0, bow_m);
    body->PointOf(-6.0, 0.0, 0.0, astern_m);
    const onesea::Place places[] = {{bow_m[0], bow_m[1]}, {astern_m[0], astern_m[1]}};
    onesea::Water water[2];
    if (!(*sea)->Sample(places, (*sea)->Now(), onesea::Detail::kHeight, water).ok()) continue;
    std::printf(
        "bow at (%.1f, %.1f): the water is at %+.3f m, %+.3f m of it wake; astern %+.3f m of "
        "wake\n",
        bow_m[0], bow_m[1], water[0].height_m, water[0].wakes_m, water[1].wakes_m);
  }
  (*boat)->Remove();
  return 0;
}
