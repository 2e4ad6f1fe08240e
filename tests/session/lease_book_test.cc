#include "server/session/lease_book.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_cat.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;

class LeaseBookTest : public ::testing::Test {
 protected:
  int made_ = 0;
  LeaseBook book_{[this] { return absl::StrCat("secret-", ++made_); }};
};

TEST_F(LeaseBookTest, OneHolderAtATime) {
  const std::string anna = *book_.Take(7, "", "Anna", 60.0, 0);
  const auto bert = book_.Take(7, "", "Bert", 60.0, kSecond);
  EXPECT_EQ(bert.status().code(), absl::StatusCode::kPermissionDenied);
  EXPECT_THAT(std::string(bert.status().message()), HasSubstr("'Anna'"));
  EXPECT_TRUE(book_.Use(7, anna, kSecond).ok());
  EXPECT_FALSE(book_.Use(7, "", kSecond).ok());
  EXPECT_FALSE(book_.Use(7, "secret-2", kSecond).ok());
  EXPECT_EQ(book_.Holder(7, kSecond), "Anna");
  EXPECT_TRUE(book_.Take(8, "", "Bert", 60.0, kSecond).ok());
}

TEST_F(LeaseBookTest, RunsOutUnlessUsed) {
  const std::string lease = *book_.Take(1, "", "Anna", 10.0, 0);
  EXPECT_TRUE(book_.Use(1, lease, 9 * kSecond).ok());
  EXPECT_TRUE(book_.Use(1, lease, 18 * kSecond).ok());
  EXPECT_EQ(book_.Use(1, lease, 28 * kSecond).code(), absl::StatusCode::kPermissionDenied);
  EXPECT_EQ(book_.Holder(1, 28 * kSecond), "");
  EXPECT_TRUE(book_.Take(1, "", "Bert", 10.0, 28 * kSecond).ok());
  EXPECT_FALSE(book_.Use(1, lease, 29 * kSecond).ok());
}

TEST_F(LeaseBookTest, NobodysBodyNeedsNone) {
  EXPECT_TRUE(book_.Use(3, "", 0).ok());
  EXPECT_EQ(book_.Use(3, "made up", 0).code(), absl::StatusCode::kPermissionDenied);
}

TEST_F(LeaseBookTest, HolderMayTakeAgainAndGiveBack) {
  const std::string lease = *book_.Take(1, "", "Anna", 10.0, 0);
  EXPECT_EQ(*book_.Take(1, lease, "Anna", 100.0, 5 * kSecond), lease);
  EXPECT_TRUE(book_.Use(1, lease, 90 * kSecond).ok());
  EXPECT_FALSE(book_.Release(1, "wrong", 91 * kSecond).ok());
  EXPECT_TRUE(book_.Release(1, lease, 91 * kSecond).ok());
  EXPECT_TRUE(book_.Use(1, "", 92 * kSecond).ok());
}

TEST(RandomSecret, IsLongAndNew) {
  EXPECT_EQ(RandomSecret().size(), 32u);
  EXPECT_NE(RandomSecret(), RandomSecret());
}

}  // namespace
}  // namespace onesea::server
