#pragma once

#include <cstddef>
#include <cstdint>

/// Every limit that a person or the network can meet, with the reason for its size. Errors print
/// these values.
namespace onesea {

// Recipe.
inline constexpr int kCascadesMax = 8;
inline constexpr int kGridSizeMin = 64;
inline constexpr int kGridSizeMax = 1024;
inline constexpr double kCascadeLengthMinM = 1.0;
inline constexpr double kCascadeLengthMaxM = 4096.0;
inline constexpr int kWaveSystemsMax = 8;
inline constexpr int kRegularWavesMax = 32;
// Lattice waves x wave systems of all weather entries: 3 s of one core to build. Default cascades
// with every entry full need 1.6 million.
inline constexpr std::int64_t kBuildWavesMax = 2'000'000;
inline constexpr int kWeatherEntriesMax =
    16;  // entries that still matter; older ones are folded away
inline constexpr int kSpectrumFrequenciesMax = 128;
inline constexpr int kSpectrumDirectionsMax = 180;
inline constexpr int kSeaNameLengthMax = 200;
inline constexpr double kWindSpeedMaxMPerS = 100.0;
inline constexpr double kHsMaxM = 40.0;        // of one wave system
inline constexpr double kSeaHsMaxM = 400.0;    // of all together; PM at kWindSpeedMax has 214
inline constexpr double kHeightMaxM = 1000.0;  // a client believes no more; crests reach 2 Hs
inline constexpr double kPeriodMinS = 0.1;
inline constexpr double kPeriodMaxS = 60.0;
inline constexpr double kDepthMinM = 0.1;
inline constexpr double kDepthMaxM = 12000.0;  // deeper is infinite for every wave here
inline constexpr double kCurrentMaxMPerS = 10.0;
inline constexpr double kLoopPeriodMinS = 1.0;  // 0 is no loop; a shorter one would stop the waves
inline constexpr double kChoppinessMax = 1.5;
inline constexpr int kTickRateMaxHz = 1000;

// Terrain.
inline constexpr double kTerrainCellMinM = 0.01;
inline constexpr double kTerrainCellMaxM = 10'000.0;
inline constexpr int kTerrainSideMax = 4096;                     // samples; 64 MB at most
inline constexpr std::size_t kTerrainBytesMax = 72 << 20;        // encoded; noise doesn't pack
inline constexpr std::size_t kTerrainPieceBytesMax = 512 << 10;  // of one message

// Interaction layer.
inline constexpr int kRegionSideMin = 64;    // cells; room for two absorbing borders
inline constexpr int kRegionSideMax = 1024;  // a step of the largest takes some milliseconds
inline constexpr int kRegionSideStep = 32;   // side of a tile on the wire
inline constexpr double kRegionCellMinM = 0.05;
inline constexpr double kRegionCellMaxM = 1000.0;
inline constexpr int kRegionsMax = 16;  // of one session
inline constexpr std::int64_t kRegionCellsMax =
    4 * 1024 * 1024;                             // of one session; 56 MB at a viewer
inline constexpr double kHeightStepMinM = 1e-4;  // heights on the wire reach 32767 steps
inline constexpr double kHeightStepMaxM = 0.1;
inline constexpr int kFramesPerUpdateMax = 60;
inline constexpr double kRainMaxPerM2S = 20.0;  // a tick of 256² cells of 0.5 m: 5500 drops
inline constexpr int kObstaclesMax = 256;       // of one session
inline constexpr int kObstacleCornersMax = 64;
inline constexpr double kExplosionMaxJ = 1e10;  // 2.4 t of TNT
inline constexpr int kSprayMax = 256;           // events of one frame
inline constexpr double kWaterLevelMaxM = 100.0;
inline constexpr int kWaterLevelsMax = 1024;  // entries of a tide table

// Bodies.
inline constexpr int kBodiesMax = 1024;                      // of one session
inline constexpr std::size_t kHullTrianglesMax = 20'000;     // 0.6 ms a step at 30 ns
inline constexpr std::int64_t kHullFileBytesMax = 16 << 20;  // 20 000 triangles as text STL: 5 MB
inline constexpr double kHullSizeMinM = 0.01;
inline constexpr double kHullSizeMaxM = 1000.0;
inline constexpr double kBodyMassMinKg = 1e-3;
inline constexpr double kBodyMassMaxKg = 1e9;
inline constexpr double kBodySpeedMaxMPerS = 200.0;  // faster is cut
inline constexpr double kBodySpinMaxRadPerS = 50.0;
inline constexpr double kBodyForceMaxN = 1e10;  // of one command
inline constexpr int kThrustersMax = 8;
inline constexpr int kRuddersMax = 4;
inline constexpr int kBodyNameLengthMax = 64;
inline constexpr int kBodyAgeTicksMax =
    10'000;  // of a state in a keyframe; those at rest are older
inline constexpr double kRestAfterMaxS = 3600.0;  // of a region's body
inline constexpr int kRopesMax = 1024;            // of one session
inline constexpr double kRopeLengthMaxM = 1e4;
inline constexpr double kRopeStretchMax = 1.5;         // of a new one
inline constexpr double kRopeStiffnessMaxNPerM = 1e9;  // damping too, in N s/m
inline constexpr int kBodyContactPairsMax = 12;        // of one body; more touch nothing

// Commands on the world.
inline constexpr int kRequestIdLengthMax = 64;
inline constexpr int kLeaseLengthMax = 64;
inline constexpr double kCommandAheadMaxS = 60.0;  // what a session has to keep of future commands
inline constexpr double kImpulseMaxNS = 1e9;
inline constexpr double kLeaseMaxS = 3600.0;
inline constexpr int kInstrumentsMax = 64;  // of one stream
inline constexpr int kTicksPerReadingMax = 3600;

// Service.
inline constexpr int kSessionsMax = 64;
inline constexpr int kSessionNameLengthMax = 64;
inline constexpr std::size_t kErrorLengthMax = 4096;   // of a server's words that a client shows
inline constexpr int kQueryPointsMax = 100'000;        // 0.8 MB of request, under gRPC's 4 MB
inline constexpr double kQueryCoordinateMaxM = 1.0e7;  // a quarter of the way round the globe
inline constexpr double kQueryTimeMaxS = 3.2e9;        // a century either way of tick 0
inline constexpr double kQueryDepthMaxM = 12000.0;
inline constexpr int kQueryDepthPointsMax = 20'000;          // a direct sum each: 0.3 s of one core
inline constexpr std::size_t kCommandsWaitingMax = 4096;     // of a session, for a later tick
inline constexpr std::size_t kRequestsRememberedMax = 4096;  // answers for those who ask again
inline constexpr int kProbesMax = 64;
inline constexpr int kLockStepParticipantsMax = 64;
inline constexpr int kParticipantNameLengthMax = 64;
inline constexpr double kLockStepDeadlineMaxS = 3600.0;
inline constexpr double kWeatherSpanMaxS = 86'400.0;
inline constexpr int kViewersPerSessionMax = 4096;
inline constexpr double kSpeedMin = 0.01;
inline constexpr double kSpeedMax = 100.0;
inline constexpr double kActualSpeedMax = 1.0e6;  // catching up may exceed kSpeedMax
inline constexpr std::int64_t kTickMax =
    3'200'000'000'000;                                 // a century at 1000 Hz; see IsTickInRange
inline constexpr std::int64_t kStepTicksMax = 36'000;  // ten minutes at 60 Hz in one request
inline constexpr std::int64_t kRecipeBytesMax = 16 * 1024;
inline constexpr std::int64_t kReadFileBytesMax = 64 * 1024 * 1024;  // of one file; also unpacked
inline constexpr int kSpectrumRecordsMax = 100'000;  // eleven years of hourly spectra
inline constexpr int kSpectrumPlacesMax = 100'000;   // of one model output file

}  // namespace onesea
