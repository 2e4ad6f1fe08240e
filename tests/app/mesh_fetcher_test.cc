// Hulls from files, got on another thread.
#include "client/app/mesh_fetcher.h"

#include <gtest/gtest.h>

#include <atomic>

#include "common/base/clock.h"
#include "common/wire/body_description.h"

namespace onesea::client {
namespace {

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

template <typename F>
bool Within(double seconds, F&& holds) {
  const std::int64_t end_ns =
      SystemClock().MonotonicNs() + static_cast<std::int64_t>(1e9 * seconds);
  while (!holds()) {
    if (SystemClock().MonotonicNs() > end_ns) return false;
    SystemClock().SleepUntil(SystemClock().MonotonicNs() + 2'000'000);
  }
  return true;
}

TEST(MeshFetcherTest, IsThereLaterAndIsAskedForOnce) {
  std::atomic<int> calls = 0;
  std::atomic<bool> open = false;
  MeshFetcher fetcher([&](std::uint64_t) -> absl::StatusOr<std::string> {
    ++calls;
    while (!open) SystemClock().SleepUntil(SystemClock().MonotonicNs() + 1'000'000);
    return std::string(kTetrahedron);
  });
  const std::uint64_t hash = wire::MeshHash(kTetrahedron);
  EXPECT_EQ(fetcher.Find(hash), nullptr);  // at once, though the answer isn't there
  open = true;
  ASSERT_TRUE(Within(10.0, [&] { return fetcher.Find(hash) != nullptr; }));
  EXPECT_EQ(fetcher.Find(hash)->corners.size(), 12u);
  EXPECT_EQ(fetcher.Find(hash), fetcher.Find(hash));
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(fetcher.trouble(), "");
}

TEST(MeshFetcherTest, BadFilesAreRefusedAndNotAskedForAgain) {
  std::atomic<int> calls = 0;
  MeshFetcher fetcher([&](std::uint64_t) -> absl::StatusOr<std::string> {
    ++calls;
    return std::string("f 1 2 9");
  });
  fetcher.Find(wire::MeshHash("f 1 2 9"));
  ASSERT_TRUE(Within(10.0, [&] { return !fetcher.trouble().empty(); }));
  EXPECT_NE(fetcher.trouble().find("the hull "), std::string::npos) << fetcher.trouble();
  fetcher.Find(7);
  ASSERT_TRUE(Within(10.0, [&] { return calls == 2; }));
  EXPECT_EQ(fetcher.Find(wire::MeshHash("f 1 2 9")), nullptr);
  EXPECT_EQ(fetcher.Find(7), nullptr);
}

TEST(MeshFetcherTest, TroubleIsOverWhenTheFileComes) {
  std::atomic<int> calls = 0;
  MeshFetcher fetcher([&](std::uint64_t) -> absl::StatusOr<std::string> {
    if (++calls == 1) return absl::UnavailableError("nobody answers");
    return std::string(kTetrahedron);
  });
  const std::uint64_t hash = wire::MeshHash(kTetrahedron);
  fetcher.Find(hash);
  ASSERT_TRUE(Within(10.0, [&] { return !fetcher.trouble().empty(); }));
  EXPECT_NE(fetcher.trouble().find("nobody answers"), std::string::npos);
  ASSERT_TRUE(Within(30.0, [&] { return fetcher.Find(hash) != nullptr; }));
  EXPECT_EQ(fetcher.trouble(), "");
}

TEST(MeshOfFileTest, NamesWhatIsWrong) {
  EXPECT_FALSE(MeshOfFile(kTetrahedron, 1).ok());
  const std::string huge = "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto refused = MeshOfFile(huge, wire::MeshHash(huge));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.status().message().find("limit"), std::string::npos);
  EXPECT_TRUE(MeshOfFile(kTetrahedron, wire::MeshHash(kTetrahedron)).ok());
}

}  // namespace
}  // namespace onesea::client
