#pragma once

#include <map>
#include <memory>
#include <string>

#include "onesea/v1/command.pb.h"
#include "server/rpc/answer_stream.h"
#include "server/session/registry.h"

/// One StreamBodyPoses call: bodies that the caller integrates.
namespace onesea::server {

/// Poses go to the session's thread, which takes them between two ticks and answers with the forces
/// of the water; nothing here waits for it. A bad request's answer carries its error, and none of
/// its poses is taken.
class StreamPosesReactor final
    : public AnswerStream<v1::StreamBodyPosesRequest, v1::StreamBodyPosesResponse> {
 public:
  /// `registry` outlives it.
  explicit StreamPosesReactor(Registry& registry) : registry_(registry) {}

 private:
  void Take(const v1::StreamBodyPosesRequest& proto) override;
  absl::Status Bring(const v1::StreamBodyPosesRequest& proto);
  absl::Status ChooseSession(const std::string& name);
  void FillInLease(wire::BodyPose& pose);

  Registry& registry_;
  std::shared_ptr<SessionLoop> session_;         // of the first good request
  std::map<std::uint32_t, std::string> leases_;  // as last shown, of at most kBodiesMax bodies
};

}  // namespace onesea::server
