// Virtual instruments over the network, against queries and closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "absl/synchronization/notification.h"
#include "common/sea/constants.h"
#include "server/rpc/instrument_feed.h"
#include "tests/rpc/rpc_fixture.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

constexpr double kRhoG = sea::kWaterDensityKgPerM3 * sea::kGravity;

SessionSpec Calm() {
  SessionSpec calm = SmallSession("calm");
  calm.pace = Pace::kHeld;
  calm.recipe.timeline[0].sea = SmallSea(1e-5);
  calm.recipe.timeline[0].sea.wind_speed_m_per_s = 0.0;
  return calm;
}

void Set(v1::Vector3* vector, Vec3d v) {
  vector->set_x(v.x);
  vector->set_y(v.y);
  vector->set_z(v.z);
}

class InstrumentsTest : public RpcFixture {
 protected:
  InstrumentsTest() { ONESEA_CHECK(registry.Create(Calm()).ok()); }

  void Step(const std::string& session, int ticks = 1) {
    v1::StepSessionRequest request;
    request.set_session(session);
    request.set_ticks(ticks);
    v1::StepSessionResponse response;
    const grpc::Status status = Call(&Stub::StepSession, request, &response);
    ASSERT_TRUE(status.ok()) << status.error_message();
  }

  // The first readings, of a session that is stepped as far as it takes.
  std::vector<v1::StreamInstrumentsResponse> Readings(const v1::StreamInstrumentsRequest& request,
                                                      int count) {
    grpc::ClientContext context;
    const auto stream = stub->StreamInstruments(&context, request);
    stream->WaitForInitialMetadata();
    std::vector<v1::StreamInstrumentsResponse> readings(static_cast<std::size_t>(count));
    for (auto& reading : readings) {
      Step(request.session(), std::max(request.ticks_per_reading(), 1));
      EXPECT_TRUE(stream->Read(&reading));
      EXPECT_EQ(reading.skipped_count(), 0);
    }
    context.TryCancel();
    return readings;
  }

  v1::SpawnBodyResponse Spawn(v1::BodyDescription::Control control, Vec3d at_m,
                              const v1::Kinematics& motion = {}) {
    v1::SpawnBodyRequest request;
    request.mutable_command()->set_session("calm");
    request.mutable_command()->set_request_id("r" + std::to_string(++requests));
    request.mutable_body()->set_control(control);
    request.mutable_body()->set_mass_kg(1500);
    Set(request.mutable_body()->mutable_shape()->mutable_box()->mutable_size_m(), {2, 2, 1});
    *request.mutable_start() = motion;
    Set(request.mutable_start()->mutable_position_m(), at_m);
    v1::SpawnBodyResponse response;
    const grpc::Status status = Call(&Stub::SpawnBody, request, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response;
  }

  static v1::StreamInstrumentsRequest For(const std::string& session) {
    v1::StreamInstrumentsRequest request;
    request.set_session(session);
    return request;
  }
  static void AddImu(v1::StreamInstrumentsRequest& request, std::uint32_t body, Vec3d at_m) {
    request.add_instruments()->mutable_imu()->set_body_id(body);
    Set(request.mutable_instruments()->rbegin()->mutable_imu()->mutable_position_m(), at_m);
  }
  static void AddPressure(v1::StreamInstrumentsRequest& request, std::uint32_t body, Vec3d at_m) {
    auto* gauge = request.add_instruments()->mutable_pressure_gauge();
    gauge->set_body_id(body);
    Set(gauge->mutable_position_m(), at_m);
  }

  int requests = 0;
};

TEST_F(InstrumentsTest, AGaugeReadsWhatAQueryAnswers) {
  v1::StreamInstrumentsRequest request = For("small");
  for (const double x : {0.0, 12.5, -40.0}) {
    request.add_instruments()->mutable_wave_gauge()->set_x_m(x);
  }
  request.set_ticks_per_reading(3);
  double largest = 0.0;
  std::int64_t tick = 0;
  for (const auto& reading : Readings(request, 5)) {
    ASSERT_EQ(reading.values_size(), 3);
    EXPECT_EQ(reading.tick(), tick += 3);
    v1::QueryPointsRequest query = QueryAt("small", 3);
    for (int n = 0; n < 3; ++n) {
      query.set_x_m(n, request.instruments(n).wave_gauge().x_m());
      query.set_y_m(n, 0.0);
    }
    query.set_tick(reading.tick());
    v1::QueryPointsResponse answer;
    ASSERT_TRUE(Call(&Stub::QueryPoints, query, &answer).ok());
    for (int n = 0; n < 3; ++n) {
      EXPECT_EQ(static_cast<float>(reading.values(n)), answer.height_m(n));
      largest = std::max(largest, std::abs(reading.values(n)));
    }
  }
  EXPECT_GT(largest, 0.01);  // of a sea of 1 m: else nothing was compared
}

TEST_F(InstrumentsTest, PressureInStillWaterIsRhoGD) {
  const v1::SpawnBodyResponse box = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, {30.0, 0.0, 0.1});
  v1::StreamInstrumentsRequest request = For("calm");
  AddPressure(request, 0, {0, 0, -2.5});
  AddPressure(request, 0, {0, 0, 0.5});
  AddPressure(request, box.body_id(), {1.0, 1.0, -0.5});  // a corner at z = 0.1 - 0.5
  const auto reading = Readings(request, 1)[0];
  ASSERT_EQ(reading.values_size(), 3);
  EXPECT_NEAR(reading.values(0), kRhoG * 2.5, 1e-4 * kRhoG);
  EXPECT_EQ(reading.values(1), 0.0);
  EXPECT_NEAR(reading.values(2), kRhoG * 0.4, 1e-4 * kRhoG);
}

// In waves: rho g (-z) and what QueryPoints answers for the dynamic pressure at that depth.
TEST_F(InstrumentsTest, PressureInWavesIsThatOfQueries) {
  v1::StreamInstrumentsRequest request = For("small");
  AddPressure(request, 0, {5.0, -3.0, -4.0});
  const auto reading = Readings(request, 1)[0];
  v1::QueryPointsRequest query = QueryAt("small", 1);
  query.set_x_m(0, 5.0);
  query.set_y_m(0, -3.0);
  query.set_tick(reading.tick());
  query.add_depth_m(4.0);
  v1::QueryPointsResponse answer;
  ASSERT_TRUE(Call(&Stub::QueryPoints, query, &answer).ok());
  EXPECT_GT(std::abs(answer.dynamic_pressure_pa(0)), 1.0);
  EXPECT_NEAR(reading.values(0), kRhoG * 4.0 + answer.dynamic_pressure_pa(0), 0.1);
}

// At rest +g up; in free fall nothing; turning about the vertical the centripetal acceleration.
TEST_F(InstrumentsTest, AnImuReadsSpecificForce) {
  v1::Kinematics spinning, rolled;
  spinning.mutable_spin_rad_per_s()->set_z(2.0);
  rolled.mutable_turn()->set_w(std::sqrt(0.5));  // a quarter turn about x: its y axis is up
  rolled.mutable_turn()->set_x(std::sqrt(0.5));
  const auto still = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, {0, 0, 5}, rolled);
  const auto turning = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, {20, 0, 5}, spinning);
  const auto falling = Spawn(v1::BodyDescription::CONTROL_INTEGRATED, {40, 0, 500});
  v1::StreamInstrumentsRequest request = For("calm");
  AddImu(request, still.body_id(), {0.5, 0, 0});
  AddImu(request, turning.body_id(), {0.7, 0, 0});
  AddImu(request, falling.body_id(), {0, 0, 0});
  request.add_instruments()->mutable_motion()->set_body_id(turning.body_id());
  const auto reading = Readings(request, 1)[0];
  ASSERT_EQ(reading.values_size(), 43);
  const auto near = [&](int first, std::vector<double> expected) {
    for (std::size_t n = 0; n < expected.size(); ++n) {
      EXPECT_NEAR(reading.values(first + static_cast<int>(n)), expected[n], 1e-9) << first + n;
    }
  };
  near(0, {0, sea::kGravity, 0, 0, 0, 0, std::sqrt(0.5), std::sqrt(0.5), 0, 0});
  near(10, {-4.0 * 0.7, 0, sea::kGravity, 0, 0, 2.0});
  near(20, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
  near(30, {20, 0, 5});
  near(37, {0, 0, 0, 0, 0, 2.0});
  const double angle = 2.0 * static_cast<double>(reading.tick()) / 60.0;  // since tick 0
  EXPECT_NEAR(std::abs(reading.values(33)), std::abs(std::cos(0.5 * angle)), 1e-6);
}

TEST_F(InstrumentsTest, ABodyThatGoesReadsNan) {
  const auto box = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, {0, 0, 0.1});
  v1::StreamInstrumentsRequest request = For("calm");
  request.add_instruments()->mutable_motion()->set_body_id(box.body_id());
  AddPressure(request, box.body_id(), {0, 0, -0.5});
  request.add_instruments()->mutable_wave_gauge();
  grpc::ClientContext context;
  const auto stream = stub->StreamInstruments(&context, request);
  stream->WaitForInitialMetadata();
  Step("calm");
  v1::StreamInstrumentsResponse reading;
  ASSERT_TRUE(stream->Read(&reading));
  EXPECT_EQ(reading.values(2), 0.1);
  v1::RemoveBodyRequest remove;
  remove.mutable_command()->set_session("calm");
  remove.mutable_command()->set_request_id("remove");
  remove.mutable_command()->set_lease(box.lease());
  remove.set_body_id(box.body_id());
  v1::RemoveBodyResponse removed;
  ASSERT_TRUE(Call(&Stub::RemoveBody, remove, &removed).ok());
  Step("calm");
  ASSERT_TRUE(stream->Read(&reading));
  EXPECT_EQ(reading.tick(), removed.tick());
  EXPECT_TRUE(std::isnan(reading.values(0)));
  EXPECT_TRUE(std::isnan(reading.values(13)));
  EXPECT_FALSE(std::isnan(reading.values(14)));
  context.TryCancel();
}

// Nobody reads while 3000 ticks go by: what comes then is in order, and what is missing is counted
// to the last one.
TEST_F(InstrumentsTest, ASlowReaderIsToldWhatItMissed) {
  v1::StreamInstrumentsRequest request = For("calm");
  for (int n = 0; n < 64; ++n) request.add_instruments()->mutable_wave_gauge()->set_x_m(n);
  grpc::ClientContext context;
  const auto stream = stub->StreamInstruments(&context, request);
  stream->WaitForInitialMetadata();
  Step("calm", 3000);
  // The last one comes surely: by then there is room.
  std::thread ender([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    Step("calm");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_TRUE(registry.Delete("calm", "enough").ok());
  });
  std::int64_t tick = 0, skipped = 0, count = 0;
  v1::StreamInstrumentsResponse reading;
  while (stream->Read(&reading)) {
    EXPECT_EQ(reading.tick(), tick + 1 + reading.skipped_count());
    tick = reading.tick();
    skipped += reading.skipped_count();
    ++count;
  }
  ender.join();
  EXPECT_EQ(tick, 3001);
  EXPECT_EQ(count + skipped, 3001);
  EXPECT_GT(skipped, 0);  // else this test says nothing
  const grpc::Status end = stream->Finish();
  EXPECT_EQ(end.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_THAT(end.error_message(), HasSubstr("enough"));
}

TEST_F(InstrumentsTest, NonsenseIsRefused) {
  const auto refused = [&](const v1::StreamInstrumentsRequest& request, grpc::StatusCode code,
                           const char* words) {
    grpc::ClientContext context;
    const auto stream = stub->StreamInstruments(&context, request);
    v1::StreamInstrumentsResponse reading;
    EXPECT_FALSE(stream->Read(&reading)) << words;
    const grpc::Status status = stream->Finish();
    EXPECT_EQ(status.error_code(), code) << words;
    EXPECT_THAT(status.error_message(), HasSubstr(words));
  };
  v1::StreamInstrumentsRequest request = For("calm");
  refused(request, grpc::StatusCode::INVALID_ARGUMENT, "instruments: 0");
  request.add_instruments();
  refused(request, grpc::StatusCode::INVALID_ARGUMENT, "is none of");
  request.mutable_instruments(0)->mutable_wave_gauge()->set_x_m(std::nan(""));
  refused(request, grpc::StatusCode::INVALID_ARGUMENT, "instruments[0].place_m.x: nan");
  request.mutable_instruments(0)->mutable_motion()->set_body_id(9);
  refused(request, grpc::StatusCode::NOT_FOUND, "instruments[0].body_id: there is no body 9");
  request.mutable_instruments(0)->mutable_wave_gauge();
  request.set_ticks_per_reading(-1);
  refused(request, grpc::StatusCode::INVALID_ARGUMENT, "ticks_per_reading");
  request = For("nobody");
  request.add_instruments()->mutable_wave_gauge();
  refused(request, grpc::StatusCode::NOT_FOUND, "nobody");
}

// Callers that come and go while the session runs leave nothing behind that is called again.
TEST_F(InstrumentsTest, StreamsThatAreLeftAreLetGo) {
  v1::StreamInstrumentsRequest request = For("calm");
  request.add_instruments()->mutable_wave_gauge();
  for (int round = 0; round < 20; ++round) {
    grpc::ClientContext context;
    const auto stream = stub->StreamInstruments(&context, request);
    Step("calm", 1 + round % 5);
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
    Step("calm");
  }
}

// Moments that wait while the worker takes nothing are read once it does; the rest is counted.
TEST_F(InstrumentsTest, AFeedGoesOnAfterABusyWorker) {
  const std::shared_ptr<SessionLoop> session = *registry.Find("calm");
  wire::InstrumentRequest request;
  request.session = "calm";
  request.instruments = {wire::WaveGauge{{0.0, 0.0}}};
  Worker worker;
  absl::Notification begun, released, drained;
  ASSERT_TRUE(worker
                  .Post([&] {
                    begun.Notify();
                    released.WaitForNotification();
                  })
                  .ok());
  begun.WaitForNotification();  // or it would leave its place in the queue later
  while (worker.Post([] {}).ok()) {
  }
  const auto feed = std::make_shared<InstrumentFeed>(
      request, *session, std::make_shared<QueryEngine>(sea::TransformKind::kOwn), worker, [] {});
  const SessionView view = session->View();
  TickEvent event;
  event.world = view.world;
  event.components = view.components;
  constexpr int kRefused = 7;
  for (int n = 0; n < kRefused; ++n) {
    event.stamp.tick = view.tick + 1 + n;
    feed->OnTick(event);
  }
  released.Notify();
  while (!worker.Post([&] { drained.Notify(); }).ok()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  drained.WaitForNotification();
  event.stamp.tick = view.tick + 1 + kRefused;
  feed->OnTick(event);
  std::vector<Reading> readings;
  for (int ms = 0; ms < 5000 && readings.size() < InstrumentFeed::kMomentsMax; ++ms) {
    while (std::optional<Reading> reading = feed->Next()) readings.push_back(*std::move(reading));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_EQ(readings.size(), InstrumentFeed::kMomentsMax);
  EXPECT_EQ(readings.front().tick, view.tick + 1);
  // What found the queue full is told with the next that didn't.
  event.stamp.tick += 1;
  feed->OnTick(event);
  std::optional<Reading> last;
  for (int ms = 0; ms < 5000 && !last; ++ms) {
    last = feed->Next();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(last.has_value());
  EXPECT_EQ(last->skipped_count, kRefused + 1 - static_cast<int>(InstrumentFeed::kMomentsMax));
}

}  // namespace
}  // namespace onesea::server
