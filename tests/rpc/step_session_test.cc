// What becomes of a step whose query can't be answered once it is made.
#include "server/rpc/step_session.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "absl/synchronization/notification.h"
#include "common/base/check.h"
#include "onesea/v1/onesea.grpc.pb.h"
#include "tests/shared/fake_clock.h"
#include "tests/shared/small_sea.h"

namespace onesea::server {
namespace {

class OnlySteps final : public v1::OneSea::WithCallbackMethod_StepSession<v1::OneSea::Service> {
 public:
  OnlySteps(Registry& registry, QueryDesk& desk, Worker& worker)
      : registry_(registry), desk_(desk), worker_(worker) {}
  grpc::ServerUnaryReactor* StepSession(grpc::CallbackServerContext* /*context*/,
                                        const v1::StepSessionRequest* request,
                                        v1::StepSessionResponse* response) override {
    auto* reactor = new StepReactor(request, response, desk_, worker_);
    StepReactor::Begin(reactor, registry_);
    return reactor;
  }

 private:
  Registry& registry_;
  QueryDesk& desk_;
  Worker& worker_;
};

TEST(StepSession, TellsWhyAQueryFailedAfterTheStep) {
  Registry registry;
  SessionSpec spec = SmallSession("small");
  spec.pace = Pace::kHeld;
  ONESEA_CHECK(registry.Create(spec).ok());
  const FakeClock clock;
  QueryDesk desk(registry, clock, sea::TransformKind::kOwn);
  absl::Notification begun, go_on;
  Worker worker;
  ASSERT_TRUE(worker
                  .Post([&] {
                    begun.Notify();
                    go_on.WaitForNotification();
                  })
                  .ok());
  begun.WaitForNotification();
  while (worker.Post([] {}).ok()) {
  }
  OnlySteps service(registry, desk, worker);
  const std::unique_ptr<grpc::Server> server =
      grpc::ServerBuilder().RegisterService(&service).BuildAndStart();
  const auto stub = v1::OneSea::NewStub(server->InProcessChannel({}));

  v1::StepSessionRequest request;
  request.set_session("small");
  request.set_ticks(7);
  request.mutable_query()->set_id(42);
  request.mutable_query()->add_x_m(1.0);
  request.mutable_query()->add_y_m(2.0);
  v1::StepSessionResponse response;
  grpc::ClientContext context;
  const grpc::Status status = stub->StepSession(&context, request, &response);
  go_on.Notify();
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(response.tick(), 7);
  EXPECT_EQ((*registry.Find("small"))->Hashes().state_hash, response.state_hash());
  EXPECT_EQ(response.query().id(), 42);
  EXPECT_EQ(response.query().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(response.query().error_message(),
            "64 requests wait for the server already; try again later");
  EXPECT_EQ(response.query().height_m_size(), 0);
  server->Shutdown();
}

}  // namespace
}  // namespace onesea::server
