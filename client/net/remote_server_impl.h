#pragma once

#include <grpc/support/time.h>
#include <grpcpp/client_context.h>

#include <memory>

#include "client/net/grpc_status.h"
#include "client/net/remote_server.h"
#include "onesea/v1/onesea.grpc.pb.h"

/// The inside of RemoteServer, shared by the files that implement it.
namespace onesea::client {

struct RemoteServer::Impl {
  std::shared_ptr<v1::OneSea::Stub> stub;
  std::int64_t timeout_ns;

  // One call of `method` with a deadline.
  template <typename Request, typename Response>
  absl::Status Call(grpc::Status (v1::OneSea::Stub::*method)(grpc::ClientContext*, const Request&,
                                                             Response*),
                    const Request& request, Response* response, std::int64_t call_timeout_ns) {
    grpc::ClientContext context;
    context.set_deadline(gpr_time_from_nanos(call_timeout_ns, GPR_TIMESPAN));
    return FromGrpc((stub.get()->*method)(&context, request, response));
  }
  template <typename Request, typename Response>
  absl::Status Call(grpc::Status (v1::OneSea::Stub::*method)(grpc::ClientContext*, const Request&,
                                                             Response*),
                    const Request& request, Response* response) {
    return Call(method, request, response, timeout_ns);
  }
};

}  // namespace onesea::client
