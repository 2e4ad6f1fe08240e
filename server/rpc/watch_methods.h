#pragma once

#include "onesea/v1/onesea.grpc.pb.h"

namespace onesea::server {

/// Innermost base of the server's service object: it leaves Watch and WatchStamps to WatchServer,
/// as bytes. The other methods are put around it (WithCallbackMethod_X<WatchMethods>).
using WatchMethods =
    v1::OneSea::WithRawMethod_Watch<v1::OneSea::WithRawMethod_WatchStamps<v1::OneSea::Service>>;

}  // namespace onesea::server
