#pragma once

namespace morula {

/// Time over which the pressure that behaviours see is averaged [s], so that growth does not flicker with single contacts.
inline constexpr double kPressureAveraging = 60.0;

/// The averaged pressure after a step of dt [s] in which the cell had the pressure `now`: p ← p + (1 − e^(−dt/τ))(now − p), exact for a
/// constant pressure whatever the steps. [kPa]
double averaged_pressure(double averaged, double now, double dt, double time_constant = kPressureAveraging);

}  // namespace morula
