#pragma once

namespace onesea::sea {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kGravity = 9.81;                      // g [m/s²]
inline constexpr double kWaterDensityKgPerM3 = 1025.0;        // rho, sea water
inline constexpr double kSurfaceTensionOverDensity = 7.4e-5;  // sigma / rho [m³/s²]

}  // namespace onesea::sea
