#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.h"

namespace morula {

/// What kind of number a value is: fixes its dimension and its internal unit (core/numbers/units.h).
enum class Quantity : std::uint8_t {
  kNumber,             ///< a plain number; a unit is an error
  kFraction,           ///< a part of a whole: 0.1 or 10 %
  kAngle,              ///< rad
  kLength,             ///< µm
  kArea,               ///< µm²
  kVolume,             ///< µm³
  kTime,               ///< s
  kRate,               ///< 1/s
  kSpeed,              ///< µm/s
  kForce,              ///< nN
  kPressure,           ///< kPa = nN/µm²
  kTension,            ///< surface energy or tension: nN/µm = mN/m = mJ/m²
  kPressurePerLength,  ///< kPa/µm
  kEnergy,             ///< fJ = nN·µm
  kViscosity,          ///< kPa·s
  kFriction,           ///< of a point: nN·s/µm
  kFrictionPerArea,    ///< nN·s/µm³
  kAmount,             ///< amol
  kAmountRate,         ///< amol/s
  kConcentration,      ///< mM = amol/µm³
  kDiffusion,          ///< µm²/s
  kPermeability,       ///< of a membrane to water, L_p: µm/(s·kPa)
};
inline constexpr int kQuantityCount = 22;

/// A quantity in words.
struct QuantityDescription {
  std::string_view name;           ///< with its article: "a pressure"
  std::string_view internal_unit;  ///< the unit that numbers inside are in: "kPa"; "" for plain numbers and fractions
  std::string_view example;        ///< a value as one would write it: "2.5 kPa"
};
QuantityDescription describe(Quantity quantity) noexcept;

/// Why a text is not a value of the wanted quantity.
struct UnitError {
  enum class Kind : std::uint8_t {
    kNotANumber,      ///< the text does not begin with one decimal number
    kNotFinite,       ///< NaN, infinity, or too large for a double
    kNoUnit,          ///< a unit is due and there is none
    kUnknownUnit,     ///< the unit cannot be read
    kWrongDimension,  ///< the unit is one of another quantity, or none is allowed
  };
  Kind kind;
  std::string message;  ///< reads on after the name of the key: "is a pressure, but 'mJ/m^2' is a surface energy or tension"
  std::string help;     ///< "for example `2.5 kPa`"
};

/// The units of Morula's texts, on udunits2.
///
/// The unit system is our own, with µm, g, s, amol as base units: these are coherent with nN, kPa and mM, so that most conversions are
/// exact. It knows the SI prefixes, the units of `known_units()`, `M` for molar (mol/L; the metre is `m`), `%`, and µ in both its code
/// points as well as `u`; superscripts (m⁻², µm²) and `·` are read too. One object may be read from several threads at once.
class UnitSystem {
 public:
  UnitSystem();
  ~UnitSystem();
  UnitSystem(UnitSystem&&) noexcept;
  UnitSystem& operator=(UnitSystem&&) noexcept;

  /// Read "2.5 kPa" as a value of this quantity, in internal units: the double nearest to the decimal number times the unit's factor.
  ///
  /// A number is decimal (sign, digits, point, exponent); fractions may go without a unit, plain numbers must, all others must not.
  /// "1/h" and "0.05 1/h" are rates.
  [[nodiscard]] Result<double, UnitError> parse(std::string_view text, Quantity quantity) const;

  /// Number of internal units in one `unit` of this quantity ("h", kTime -> 3600); for texts that carry number and unit apart, such as
  /// the header `x [um]` of a table. Errors: kUnknownUnit, kWrongDimension, kNoUnit.
  [[nodiscard]] Result<double, UnitError> factor(std::string_view unit, Quantity quantity) const;

  /// The shortest text that parse() reads back to the same bits, in the unit that gives a readable number: 64800 -> "18 h".
  /// Infinite and not-a-number values, which parse() refuses, are written "inf", "-inf" and "nan".
  [[nodiscard]] std::string format_value(double internal, Quantity quantity) const;

  /// All unit symbols that may follow a prefix, separated by ", ".
  [[nodiscard]] static std::string known_units();

 private:
  class Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace morula
