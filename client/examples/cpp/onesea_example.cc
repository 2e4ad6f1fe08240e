// A buoy that floats on the session's sea: heights in this process, with no round trip.
//
//   onesea_example [HOST:PORT]

#include <onesea/onesea.h>

#include <chrono>
#include <cstdio>
#include <thread>

int main(int argc, char** argv) {
  auto sea = onesea::Join(argc > 1 ? argv[1] : "127.0.0.1:7310");
  if (!sea.ok()) {
    std::fprintf(stderr, "%s\n", sea.status().ToString().c_str());
    return 1;
  }
  for (int n = 0; n < 10; ++n) {
    std::printf("t = %.3f s: the buoy floats at %+.3f m\n", (*sea)->Now(),
                (*sea)->HeightAt(12.0, -7.5));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return 0;
}
