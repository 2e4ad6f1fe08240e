#pragma once

#include "onesea/v1/onesea.grpc.pb.h"
#include "server/rpc/watch_methods.h"

/// Which API serves which method: Watch and WatchStamps are raw async (watch_server.h), the rest is
/// callback.
namespace onesea::server {

template <class Base>
using WithSessionMethods = v1::OneSea::WithCallbackMethod_ListSessions<
    v1::OneSea::WithCallbackMethod_CreateSession<v1::OneSea::WithCallbackMethod_DeleteSession<
        v1::OneSea::WithCallbackMethod_ChangeWeather<v1::OneSea::WithCallbackMethod_HoldSession<
            v1::OneSea::WithCallbackMethod_ResumeSession<v1::OneSea::WithCallbackMethod_SetSpeed<
                v1::OneSea::WithCallbackMethod_StepSession<Base>>>>>>>>;

template <class Base>
using WithQueryMethods = v1::OneSea::WithCallbackMethod_QueryPoints<
    v1::OneSea::WithCallbackMethod_StreamQueries<v1::OneSea::WithCallbackMethod_SyncClock<
        v1::OneSea::WithCallbackMethod_GetStateHash<Base>>>>;

template <class Base>
using WithBodyMethods = v1::OneSea::WithCallbackMethod_SpawnBody<
    v1::OneSea::WithCallbackMethod_RemoveBody<v1::OneSea::WithCallbackMethod_DriveBody<
        v1::OneSea::WithCallbackMethod_ApplyImpulse<v1::OneSea::WithCallbackMethod_TakeLease<
            v1::OneSea::WithCallbackMethod_ReleaseLease<v1::OneSea::WithCallbackMethod_ListBodies<
                v1::OneSea::WithCallbackMethod_GetMesh<v1::OneSea::WithCallbackMethod_ListPresets<
                    v1::OneSea::WithCallbackMethod_StreamBodyPoses<Base>>>>>>>>>>;

template <class Base>
using WithWaterMethods = v1::OneSea::WithCallbackMethod_Explode<
    v1::OneSea::WithCallbackMethod_SetObstacle<v1::OneSea::WithCallbackMethod_RemoveObstacle<
        v1::OneSea::WithCallbackMethod_AddRegion<v1::OneSea::WithCallbackMethod_RemoveRegion<
            v1::OneSea::WithCallbackMethod_AddRope<v1::OneSea::WithCallbackMethod_RemoveRope<
                v1::OneSea::WithCallbackMethod_StreamInstruments<
                    v1::OneSea::WithCallbackMethod_GetTerrain<Base>>>>>>>>>;

using OneSeaMethods =
    WithWaterMethods<WithBodyMethods<WithQueryMethods<WithSessionMethods<WatchMethods>>>>;

}  // namespace onesea::server
