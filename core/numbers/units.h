#pragma once
/// Internal units of Morula: µm, nN, s, amol. Everything without a unit in its name is in these.
///
/// Hence pressure nN/µm² = kPa, tension nN/µm = mN/m, energy nN·µm = fJ, concentration amol/µm³ = mM,
/// friction per area nN·s/µm³. The constants below convert a number in the named unit to the internal one:
/// `18 * units::h` is 18 hours in seconds.
namespace morula::units {

inline constexpr double um = 1.0;
inline constexpr double nm = 1e-3;
inline constexpr double m = 1e6;
inline constexpr double nN = 1.0;
inline constexpr double pN = 1e-3;
inline constexpr double N = 1e9;
inline constexpr double s = 1.0;
inline constexpr double min = 60.0;
inline constexpr double h = 3600.0;
inline constexpr double amol = 1.0;
inline constexpr double mol = 1e18;
inline constexpr double Pa = 1e-3;
inline constexpr double kPa = 1.0;
inline constexpr double mM = 1.0;
inline constexpr double fJ = 1.0;

}  // namespace morula::units
