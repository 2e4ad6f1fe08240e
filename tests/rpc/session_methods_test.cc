#include <gmock/gmock.h>

#include <cmath>
#include <future>
#include <thread>

#include "tests/rpc/rpc_fixture.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

using SessionMethods = RpcFixture;

v1::CreateSessionRequest CreateRequest(const std::string& name) {
  v1::CreateSessionRequest request;
  SessionSpec spec = SmallSession(name);
  wire::ToProto(spec, request.mutable_spec());
  return request;
}

TEST_F(SessionMethods, ListsByName) {
  v1::ListSessionsResponse response;
  ASSERT_TRUE(Call(&Stub::ListSessions, v1::ListSessionsRequest(), &response).ok());
  ASSERT_EQ(response.sessions_size(), 2);
  EXPECT_EQ(response.sessions(0).name(), "lock");
  EXPECT_EQ(response.sessions(0).pace(), v1::PACE_LOCK_STEP);
  EXPECT_EQ(response.sessions(1).name(), "small");
  EXPECT_NEAR(response.sessions(1).hs_m(), 1.0, 0.2);
  EXPECT_EQ(response.sessions(1).component_hash(), Find("small")->Hashes().component_hash);
  EXPECT_EQ(response.sessions(1).probes_size(), 3);
  EXPECT_TRUE(response.sessions(1).has_epoch_time());
}

TEST_F(SessionMethods, CreatesAndDeletesAndTheNameComesFree) {
  for (int round = 0; round < 2; ++round) {
    v1::CreateSessionResponse created;
    ASSERT_TRUE(Call(&Stub::CreateSession, CreateRequest("new"), &created).ok());
    EXPECT_EQ(created.session().name(), "new");
    EXPECT_EQ(created.session().pace(), v1::PACE_REAL_TIME);
    EXPECT_EQ(Call(&Stub::CreateSession, CreateRequest("new"), &created).error_code(),
              grpc::StatusCode::ALREADY_EXISTS);
    v1::DeleteSessionRequest request;
    request.set_session("new");
    v1::DeleteSessionResponse deleted;
    ASSERT_TRUE(Call(&Stub::DeleteSession, request, &deleted).ok());
    EXPECT_EQ(Call(&Stub::DeleteSession, request, &deleted).error_code(),
              grpc::StatusCode::NOT_FOUND);
  }
}

TEST_F(SessionMethods, CreateRefusesBadSpecs) {
  v1::CreateSessionResponse response;
  grpc::Status status = Call(&Stub::CreateSession, v1::CreateSessionRequest(), &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  v1::CreateSessionRequest request = CreateRequest("new");
  request.mutable_spec()->mutable_sea()->mutable_systems(0)->mutable_jonswap()->set_hs_m(
      std::nan(""));
  status = Call(&Stub::CreateSession, request, &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), HasSubstr("sea.systems[0]"));
  request = CreateRequest("new");
  request.mutable_spec()->mutable_sea()->mutable_systems(0)->mutable_file()->set_path("/dev/zero");
  status = Call(&Stub::CreateSession, request, &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), HasSubstr("not over the network"));
}

TEST_F(SessionMethods, CreateRefusesTheSixtyFifth) {
  v1::CreateSessionResponse response;
  for (int n = 2; n < 64; ++n) {
    v1::CreateSessionRequest request = CreateRequest(absl::StrCat("s", n));
    request.mutable_spec()->set_pace(v1::PACE_HELD);
    ASSERT_TRUE(Call(&Stub::CreateSession, request, &response).ok());
  }
  EXPECT_EQ(Call(&Stub::CreateSession, CreateRequest("more"), &response).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST_F(SessionMethods, HoldResumeSpeed) {
  v1::ResumeSessionRequest resume;
  resume.set_session("small");
  v1::ResumeSessionResponse resumed;
  ASSERT_TRUE(Call(&Stub::ResumeSession, resume, &resumed).ok());
  EXPECT_EQ(resumed.tick(), 0);
  v1::SetSpeedRequest speed;
  speed.set_session("small");
  speed.set_speed(50.0);
  v1::SetSpeedResponse set;
  ASSERT_TRUE(Call(&Stub::SetSpeed, speed, &set).ok());
  EXPECT_EQ(set.speed(), 50.0);
  while (Find("small")->View().tick < 100) std::this_thread::yield();
  v1::HoldSessionRequest hold;
  hold.set_session("small");
  v1::HoldSessionResponse held;
  ASSERT_TRUE(Call(&Stub::HoldSession, hold, &held).ok());
  EXPECT_GE(held.tick(), 100);
  EXPECT_EQ(Find("small")->Hashes().tick, held.tick());
}

TEST_F(SessionMethods, HoldResumeSpeedErrors) {
  v1::HoldSessionRequest hold;
  v1::HoldSessionResponse held;
  hold.set_session("nobody");
  EXPECT_EQ(Call(&Stub::HoldSession, hold, &held).error_code(), grpc::StatusCode::NOT_FOUND);
  hold.set_session("lock");
  EXPECT_EQ(Call(&Stub::HoldSession, hold, &held).error_code(),
            grpc::StatusCode::FAILED_PRECONDITION);
  v1::ResumeSessionRequest resume;
  v1::ResumeSessionResponse resumed;
  resume.set_session("nobody");
  EXPECT_EQ(Call(&Stub::ResumeSession, resume, &resumed).error_code(), grpc::StatusCode::NOT_FOUND);
  resume.set_session("lock");
  EXPECT_EQ(Call(&Stub::ResumeSession, resume, &resumed).error_code(),
            grpc::StatusCode::FAILED_PRECONDITION);
  v1::SetSpeedRequest speed;
  v1::SetSpeedResponse set;
  speed.set_session("small");
  for (double bad : {0.0, -1.0, 1000.0, std::nan("")}) {
    speed.set_speed(bad);
    const grpc::Status status = Call(&Stub::SetSpeed, speed, &set);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(status.error_message(), HasSubstr("[0.01, 100]"));
  }
  speed.set_session("nobody");
  EXPECT_EQ(Call(&Stub::SetSpeed, speed, &set).error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(SessionMethods, ChangesTheWeather) {
  v1::ChangeWeatherRequest request;
  request.set_session("small");
  request.set_over_s(2.0);
  auto* jonswap = request.mutable_sea()->add_systems()->mutable_jonswap();
  jonswap->set_hs_m(2.0);
  jonswap->set_tp_s(5.0);
  v1::ChangeWeatherResponse response;
  ASSERT_TRUE(Call(&Stub::ChangeWeather, request, &response).ok());
  EXPECT_EQ(response.start_tick(), 1);
  EXPECT_EQ(response.end_tick(), 121);
  EXPECT_EQ(Find("small")->View().components->recipe.timeline.size(), 2u);
}

TEST_F(SessionMethods, ChangeWeatherErrors) {
  v1::ChangeWeatherRequest request;
  v1::ChangeWeatherResponse response;
  request.set_session("nobody");
  EXPECT_EQ(Call(&Stub::ChangeWeather, request, &response).error_code(),
            grpc::StatusCode::NOT_FOUND);
  request.set_session("small");
  for (double bad : {-1.0, 86'401.0, std::nan("")}) {
    request.set_over_s(bad);
    const grpc::Status status = Call(&Stub::ChangeWeather, request, &response);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(status.error_message(), HasSubstr("over_s"));
  }
  request.set_over_s(1.0);
  request.set_start_tick(-5);
  EXPECT_EQ(Call(&Stub::ChangeWeather, request, &response).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  request.clear_start_tick();
  request.mutable_sea()->add_systems();
  EXPECT_EQ(Call(&Stub::ChangeWeather, request, &response).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(SessionMethods, StateHashTellsTickAndComponents) {
  v1::GetStateHashRequest request;
  request.set_session("small");
  v1::GetStateHashResponse response;
  ASSERT_TRUE(Call(&Stub::GetStateHash, request, &response).ok());
  EXPECT_EQ(response.tick(), 0);
  EXPECT_EQ(response.component_hash(), Find("small")->View().components->hash);
  const std::uint64_t before = response.state_hash();
  // Another server with the same recipe at the same tick holds the same state.
  Registry other;
  ASSERT_TRUE(other.Create(SmallSession("elsewhere")).ok());
  EXPECT_EQ((*other.Find("elsewhere"))->View().components->hash, response.component_hash());
  v1::StepSessionRequest step;
  step.set_session("small");
  step.set_ticks(1);
  v1::StepSessionResponse stepped;
  ASSERT_TRUE(Call(&Stub::StepSession, step, &stepped).ok());
  EXPECT_NE(stepped.state_hash(), before);
  request.set_session("nobody");
  EXPECT_EQ(Call(&Stub::GetStateHash, request, &response).error_code(),
            grpc::StatusCode::NOT_FOUND);
}

class Step : public RpcFixture {
 protected:
  static v1::StepSessionRequest Request(const std::string& session, std::int64_t ticks,
                                        const std::string& participant = "") {
    v1::StepSessionRequest request;
    request.set_session(session);
    request.set_ticks(ticks);
    request.set_participant(participant);
    return request;
  }
};

TEST_F(Step, AnswersAtTheTickReachedWithTheQuery) {
  v1::StepSessionRequest request = Request("small", 7);
  *request.mutable_query() = QueryAt("", 3);
  v1::StepSessionResponse response;
  ASSERT_TRUE(Call(&Stub::StepSession, request, &response).ok());
  EXPECT_EQ(response.tick(), 7);
  EXPECT_EQ(response.state_hash(), Find("small")->Hashes().state_hash);
  EXPECT_DOUBLE_EQ(response.query().time_s(), 7.0 / 60.0);
  ASSERT_EQ(response.query().height_m_size(), 3);
  v1::QueryPointsRequest query = QueryAt("small", 3);
  query.set_tick(7);
  v1::QueryPointsResponse direct;
  ASSERT_TRUE(Call(&Stub::QueryPoints, query, &direct).ok());
  EXPECT_EQ(direct.height_m(2), response.query().height_m(2));
}

TEST_F(Step, ABadQueryStepsNothing) {
  v1::StepSessionRequest request = Request("small", 7);
  *request.mutable_query() = QueryAt("", 1);
  request.mutable_query()->set_x_m(0, std::nan(""));
  v1::StepSessionResponse response;
  EXPECT_EQ(Call(&Stub::StepSession, request, &response).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(Find("small")->View().tick, 0);
}

TEST_F(Step, Errors) {
  v1::StepSessionResponse response;
  EXPECT_EQ(Call(&Stub::StepSession, Request("nobody", 1), &response).error_code(),
            grpc::StatusCode::NOT_FOUND);
  for (std::int64_t bad : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{36'001}}) {
    EXPECT_EQ(Call(&Stub::StepSession, Request("small", bad), &response).error_code(),
              grpc::StatusCode::INVALID_ARGUMENT);
  }
  ASSERT_TRUE(Find("small")->Resume().ok());
  EXPECT_EQ(Call(&Stub::StepSession, Request("small", 1), &response).error_code(),
            grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(Step, TwoParticipantsMeet) {
  for (int round = 1; round <= 5; ++round) {
    auto other = std::async(std::launch::async, [&] {
      v1::StepSessionResponse response;
      EXPECT_TRUE(Call(&Stub::StepSession, Request("lock", 4, "other"), &response).ok());
      return response.tick();
    });
    v1::StepSessionResponse response;
    ASSERT_TRUE(Call(&Stub::StepSession, Request("lock", 4, "me"), &response).ok());
    EXPECT_EQ(response.tick(), 4 * round);
    EXPECT_EQ(other.get(), 4 * round);
  }
}

// A participant whose own deadline passes, or who is cancelled, no longer counts: the next two meet
// without it.
TEST_F(Step, OneWhoGivesUpLeavesTheBarrier) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(50));
  v1::StepSessionResponse response;
  EXPECT_EQ(stub->StepSession(&context, Request("lock", 4, "me"), &response).error_code(),
            grpc::StatusCode::DEADLINE_EXCEEDED);
  // The server hears of it a moment after the client: until then the first one's wish stands.
  const auto insist = [&](const std::string& participant) {
    while (true) {
      v1::StepSessionResponse mine;
      const grpc::Status status = Call(&Stub::StepSession, Request("lock", 9, participant), &mine);
      if (status.error_code() == grpc::StatusCode::FAILED_PRECONDITION) continue;
      if (status.error_code() == grpc::StatusCode::INVALID_ARGUMENT) continue;
      EXPECT_TRUE(status.ok()) << status.error_message();
      return mine.tick();
    }
  };
  auto other = std::async(std::launch::async, [&] { return insist("other"); });
  EXPECT_EQ(insist("me"), 9);
  EXPECT_EQ(other.get(), 9);
}

TEST_F(Step, DeletingTheSessionAnswersThoseWhoWait) {
  auto waiting = std::async(std::launch::async, [&] {
    v1::StepSessionResponse response;
    return Call(&Stub::StepSession, Request("lock", 4, "me"), &response).error_code();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_TRUE(registry.Delete("lock", "test").ok());
  EXPECT_EQ(waiting.get(), grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace onesea::server
