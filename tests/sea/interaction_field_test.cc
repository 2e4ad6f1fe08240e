#include "common/sea/interaction_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace onesea::sea {
namespace {

InteractionField Field(double west_m, double height_m, double k) {
  InteractionField field;
  field.cells = {.west = static_cast<std::int64_t>(west_m / 0.5),
                 .south = -20,
                 .columns = 64,
                 .rows = 40,
                 .cell_m = 0.5};
  const auto flow = std::make_shared<InteractionFlow>();
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 64; ++column) {
      const Vec2d place = field.cells.PlaceOf(field.cells.west + column, -20 + row);
      field.height_m.push_back(
          static_cast<float>(height_m * std::sin(k * place.x + 0.3) * std::cos(0.7 * k * place.y)));
      flow->x.push_back(static_cast<float>(place.x));
      flow->y.push_back(static_cast<float>(place.y));
      flow->z.push_back(0.25f);
    }
  }
  field.flow = flow;
  field.foam = std::make_shared<const std::vector<float>>(field.cells.cells(), 0.7f);
  return field;
}

TEST(InteractionField, IsExactAtCellsAndCloseBetween) {
  const double k = 2.0 * 3.14159265 / 8.0;  // 16 cells a wave
  const InteractionField field = Field(100.0, 0.4, k);
  EXPECT_EQ(SampleInteraction(field, field.cells.PlaceOf(field.cells.west + 7, -11)).height_m,
            field.height_m[9 * 64 + 7]);
  for (double x = 104.0; x < 124.0; x += 0.37) {
    for (double y = -6.0; y < 6.0; y += 0.41) {
      const InteractionSample sample = SampleInteraction(field, {x, y});
      EXPECT_NEAR(sample.height_m, 0.4 * std::sin(k * x + 0.3) * std::cos(0.7 * k * y), 0.002);
      EXPECT_NEAR(sample.slope.x, 0.4 * k * std::cos(k * x + 0.3) * std::cos(0.7 * k * y), 0.02);
      EXPECT_NEAR(sample.slope.y, -0.28 * k * std::sin(k * x + 0.3) * std::sin(0.7 * k * y), 0.02);
      EXPECT_NEAR(sample.velocity.x, x, 1e-4);
      EXPECT_NEAR(sample.velocity.y, y, 1e-4);
      EXPECT_NEAR(sample.velocity.z, 0.25, 1e-6);
      EXPECT_NEAR(sample.foam, 0.7, 1e-6);
    }
  }
}

// Slope is the derivative of the height everywhere, across cells and beyond the field's end.
TEST(InteractionField, IsSmoothAndFadesBeyondItsEnd) {
  const InteractionField field = Field(0.0, 1.0, 0.5);
  for (double x = -1.5; x < 33.5; x += 0.0317) {
    const double step = 1e-5;
    const double difference = SampleInteraction(field, {x + step, 3.3}).height_m -
                              SampleInteraction(field, {x - step, 3.3}).height_m;
    ASSERT_NEAR(SampleInteraction(field, {x, 3.3}).slope.x, difference / (2.0 * step), 1e-3) << x;
  }
  EXPECT_EQ(SampleInteraction(field, {-1.01, 3.3}).height_m, 0.0);
  EXPECT_EQ(SampleInteraction(field, {32.6, 3.3}).height_m, 0.0);
}

TEST(InteractionField, FieldsAddAndNonsenseIsZero) {
  InteractionSnapshot snapshot;
  const auto a = std::make_shared<InteractionField>(Field(0.0, 0.3, 0.5));
  const auto b = std::make_shared<InteractionField>(Field(10.0, 0.2, 0.9));
  snapshot.fields = {a, b};
  const Vec2d place{15.3, 1.2};
  const InteractionSample sum = SampleInteraction(snapshot, place);
  EXPECT_DOUBLE_EQ(sum.height_m,
                   SampleInteraction(*a, place).height_m + SampleInteraction(*b, place).height_m);
  EXPECT_DOUBLE_EQ(sum.foam, 1.0);
  std::vector<Vec2d> places;
  for (int n = 0; n < 50; ++n) places.push_back({n - 5.0, 0.3 * n - 12.0});
  std::vector<double> heights(places.size());
  InteractionHeights(snapshot, places, heights);
  for (std::size_t n = 0; n < places.size(); ++n) {
    EXPECT_EQ(heights[n], SampleInteraction(snapshot, places[n]).height_m);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vec2d nonsense :
       {Vec2d{nan, 0.0}, Vec2d{0.0, nan}, Vec2d{inf, 1.0}, Vec2d{1.0, -inf}, Vec2d{1e300, 1e300}}) {
    EXPECT_EQ(SampleInteraction(snapshot, nonsense).height_m, 0.0);
  }
}

}  // namespace
}  // namespace onesea::sea
