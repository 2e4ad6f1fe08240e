// Bytes that nobody meant: whatever arrives, decoding returns, and what it accepts is within the
// limits.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/proto_query.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_session.h"
#include "common/wire/recipe_codec.h"
#include "onesea/v1/frame.pb.h"
#include "tests/wire/recipe_examples.h"
#include "tests/wire/world_examples.h"

namespace onesea::wire {
namespace {

using google::protobuf::FieldDescriptor;

Frame FullFrame(const sea::SeaState& sea) {
  Frame frame;
  frame.sequence = 42;
  frame.keyframe = true;
  frame.stamp = Stamp{.tick = 7, .server_monotonic_ns = 123456789, .speed = 2.0};
  frame.probes = ProbeHeights{7, {0.1f, -0.2f}};
  frame.welcome.emplace();
  frame.welcome->recipe = RecipeOf(sea);
  frame.welcome->component_hash = 99;
  frame.welcome->water_level = {{-60.0, 0.5}, {3600.0, -1.25}};
  frame.welcome->session.name = "storm";
  frame.welcome->session.latitude_deg = 12.0;
  frame.welcome->session.longitude_deg = 34.0;
  frame.welcome->session.hs_m = 3.0;
  frame.welcome->session.probes_m = {{1.0, 2.0}};
  frame.farewell = "bye";
  frame.world = FullUpdate();
  return frame;
}

std::uint64_t Next(std::uint64_t& state) {
  state = state * 6364136223846793005ULL + 1442695040888963407ULL;
  return state >> 33;
}

TEST(HostileBytes, TruncationAnywhereIsRefusedOrHarmless) {
  const std::string bytes = EncodeFrame(FullFrame(BuoySea()));
  ASSERT_TRUE(DecodeFrame(bytes).ok()) << DecodeFrame(bytes).status();
  int refused = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    if (!DecodeFrame(std::string_view(bytes).substr(0, size)).ok()) ++refused;
  }
  EXPECT_GT(refused, 1000);
}

TEST(HostileBytes, BitFlipsAreRefusedOrStayInRange) {
  const std::string bytes = EncodeFrame(FullFrame(ParametricSea()));
  std::uint64_t random = 1;
  int refused = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    std::string broken = bytes;
    for (std::uint64_t flips = 1 + Next(random) % 4; flips > 0; --flips) {
      broken[Next(random) % broken.size()] ^= static_cast<char>(1 << (Next(random) % 8));
    }
    const absl::StatusOr<Frame> frame = DecodeFrame(broken);
    if (!frame.ok()) {
      ++refused;
      continue;
    }
    if (frame->welcome) {
      EXPECT_TRUE(sea::ValidateRecipe(frame->welcome->recipe).ok());
    }
    if (frame->stamp) {
      EXPECT_TRUE(std::isfinite(frame->stamp->speed));
    }
    if (!frame->world || frame->world->ropes == nullptr) continue;
    for (const TiedRope& rope : *frame->world->ropes) {
      EXPECT_TRUE(ValidateRopeSpec("", rope.spec).ok());
    }
  }
  EXPECT_GT(refused, 1000);
}

// A server that means harm could command the terminals of those who list its sessions.
TEST(HostileBytes, WhatAServerSaysOfItselfIsPrintable) {
  Frame frame = FullFrame(ParametricSea());
  frame.welcome->session.name = "a\x1b[2Jb";
  frame.welcome->session.sea_name = std::string(199, 's') + "\u00e4 and more";
  frame.welcome->session.transform = "own\n";
  frame.farewell = "\u6ce2\a";
  const absl::StatusOr<Frame> read = DecodeFrame(EncodeFrame(frame));
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(read->welcome->session.name, "a?[2Jb");
  EXPECT_EQ(read->welcome->session.sea_name, std::string(199, 's'));
  EXPECT_EQ(read->welcome->session.transform, "own?");
  EXPECT_EQ(*read->farewell, "\u6ce2?");
  v1::QueryPointsResponse answer;
  answer.set_error_code(5);
  answer.set_error_message("no\x7f");
  EXPECT_EQ(FromProto(answer)->status.message(), "no?");
  EXPECT_EQ(Printable("\xff\xfe\u00e4", 3), "??");
}

// Each tick is one that some rate allows; what counts is the century, not the number.
TEST(HostileBytes, ATickBeyondACenturyOfItsRateIsRefused) {
  Frame frame = FullFrame(ParametricSea());
  frame.welcome->session.tick = std::int64_t{3'200'000'000} * 60;
  EXPECT_TRUE(DecodeFrame(EncodeFrame(frame)).ok());
  for (const std::int64_t past : {1, -1}) {
    frame.welcome->session.tick = past * (std::int64_t{3'200'000'000} * 60 + 1);
    const absl::Status status = DecodeFrame(EncodeFrame(frame)).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find("session.tick"), absl::string_view::npos) << status;
  }
}

TEST(HostileBytes, RandomBytesAreRefusedOrHarmless) {
  std::uint64_t random = 2;
  for (int trial = 0; trial < 20'000; ++trial) {
    std::string bytes(Next(random) % 200, '\0');
    for (char& byte : bytes) byte = static_cast<char>(Next(random));
    DecodeFrame(bytes).IgnoreError();
    DecodeRecipe(bytes).IgnoreError();
  }
}

// Sets the n-th float or double below `message` (of a repeated one its first element) to `value`;
// `n` counts down. Returns the field's name, empty when there are fewer.
std::string SetNumber(google::protobuf::Message& message, int& n, double value) {
  const auto* reflection = message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    const auto type = field->cpp_type();
    if (type == FieldDescriptor::CPPTYPE_MESSAGE) {
      const int count = field->is_repeated() ? reflection->FieldSize(message, field) : 1;
      for (int child = 0; child < count; ++child) {
        const std::string name = SetNumber(
            field->is_repeated() ? *reflection->MutableRepeatedMessage(&message, field, child)
                                 : *reflection->MutableMessage(&message, field),
            n, value);
        if (!name.empty()) return field->name() + "." + name;
      }
      continue;
    }
    const bool is_double = type == FieldDescriptor::CPPTYPE_DOUBLE;
    if (!is_double && type != FieldDescriptor::CPPTYPE_FLOAT) continue;
    if (n-- > 0) continue;
    const float narrow = static_cast<float>(value);
    if (field->is_repeated() && is_double) {
      reflection->SetRepeatedDouble(&message, field, 0, value);
    } else if (field->is_repeated()) {
      reflection->SetRepeatedFloat(&message, field, 0, narrow);
    } else if (is_double) {
      reflection->SetDouble(&message, field, value);
    } else {
      reflection->SetFloat(&message, field, narrow);
    }
    return field->name();
  }
  return "";
}

// Every number of `proto` in turn is NaN and infinite; `accepts` says whether the decoder takes the
// whole.
template <typename Proto, typename Accepts>
void ExpectNoNanAnywhere(const Proto& proto, int numbers_min, Accepts accepts) {
  ASSERT_TRUE(accepts(proto));
  for (double value : {std::nan(""), std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()}) {
    int count = 0;
    for (;; ++count) {
      Proto broken = proto;
      int n = count;
      const std::string name = SetNumber(broken, n, value);
      if (name.empty()) break;
      EXPECT_FALSE(accepts(broken)) << name << " = " << value;
    }
    EXPECT_GE(count, numbers_min);
  }
}

TEST(HostileBytes, NanAndInfinityAreRefusedInEveryFieldOfAFrame) {
  for (const sea::SeaState& sea : {ParametricSea(), BuoySea(), GridSea()}) {
    v1::WatchResponse proto;
    ASSERT_TRUE(proto.ParseFromString(EncodeFrame(FullFrame(sea))));
    ExpectNoNanAnywhere(proto, 30, [](const v1::WatchResponse& frame) {
      return DecodeFrame(frame.SerializeAsString()).ok();
    });
  }
}

TEST(HostileBytes, NanAndInfinityAreRefusedInEveryFieldOfASessionSpec) {
  SessionSpec spec;
  spec.name = "storm";
  spec.recipe = RecipeOf(ParametricSea());
  spec.latitude_deg = 1.0;
  spec.longitude_deg = 2.0;
  spec.probes_m = {{1.0, 2.0}};
  spec.world.regions = {FullRegion()};
  spec.world.bodies = {{FullBody(), FullKinematics()}};
  spec.world.water_level = {{10.0, 0.5}};
  spec.world.body_wind_m_per_s = Vec2d{3.0, 4.0};
  v1::SessionSpec proto;
  ToProto(spec, &proto);
  ExpectNoNanAnywhere(proto, 120,
                      [](const v1::SessionSpec& broken) { return FromProto(broken).ok(); });
}

}  // namespace
}  // namespace onesea::wire
