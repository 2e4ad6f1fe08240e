#include "server/app/listen_address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace onesea::server {
namespace {

TEST(ListenAddress, LoopbackNeedsNoPermission) {
  for (const char* address :
       {"127.0.0.1:7310", "127.1.2.3:0", "localhost:80", "[::1]:7310", "unix:/tmp/onesea.sock"}) {
    EXPECT_TRUE(CheckListenAddress(address, false).ok()) << address;
  }
}

TEST(ListenAddress, OthersNeedTheFlag) {
  for (const char* address :
       {"0.0.0.0:7310", "[::]:7310", "10.0.0.1:7310", "example.com:7310", "127.evil.example:7310",
        "127.0.0.1.evil.example:7310", "127.0.0.300:7310"}) {
    const absl::Status status = CheckListenAddress(address, false);
    EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition) << address;
    EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("--insecure_public"));
    EXPECT_TRUE(CheckListenAddress(address, true).ok()) << address;
  }
}

TEST(ListenAddress, RefusesWhatIsNoHostAndPort) {
  for (const char* address : {"", "127.0.0.1", ":7310", "127.0.0.1:", "127.0.0.1:65536",
                              "127.0.0.1:-1", "localhost:http"}) {
    EXPECT_EQ(CheckListenAddress(address, true).code(), absl::StatusCode::kInvalidArgument)
        << address;
  }
}

}  // namespace
}  // namespace onesea::server
