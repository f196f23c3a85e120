#include "core/numbers/unit_table.h"

namespace morula {

std::span<const UnitDefinition> unit_definitions() {
  // Exact by definition: BIPM, The International System of Units, 9th edition (2019), tables 2, 4 and 8.
  static constexpr UnitDefinition kUnits[] = {
      {"m", "meter", "1e6 um"},
      {"", "metre", "1e6 um"},
      {"mol", "mole", "1e18 amol"},
      {"min", "minute", "60 s"},
      {"h", "hour", "3600 s"},
      {"d", "day", "86400 s"},
      {"", "week", "604800 s"},
      {"Hz", "hertz", "s^-1"},
      {"L", "liter", "1e15 um^3"},
      {"l", "litre", "1e15 um^3"},
      {"M", "molar", "1e18 amol/L"},
      {"N", "newton", "1e3 g m/s^2"},
      {"Pa", "pascal", "N/m^2"},
      {"bar", "", "1e5 Pa"},
      {"mmHg", "", "133.322387415 Pa"},
      {"J", "joule", "N m"},
      {"W", "watt", "J/s"},
      {"P", "poise", "0.1 Pa s"},
      {"dyn", "dyne", "1e-5 N"},
      {"erg", "", "1e-7 J"},
      {"deg", "degree", "0.017453292519943295 rad"},
      {"%", "percent", "0.01"},
      {"", "micron", "1 um"},
      {"", "angstrom", "1e-4 um"},
      {"", "sec", "1 s"},
      {"", "hr", "3600 s"},
      {"atm", "atmosphere", "101325 Pa"},
      {"", "torr", "101325/760 Pa"},
  };
  return kUnits;
}

std::span<const UnitPrefix> unit_prefixes() {
  // no hecto: its symbol makes "hh" or "hs" a unit, which is a slip more often than a wish
  static constexpr UnitPrefix kPrefixes[] = {
      {"a", "atto", 1e-18}, {"f", "femto", 1e-15}, {"p", "pico", 1e-12}, {"n", "nano", 1e-9}, {"u", "micro", 1e-6}, {"m", "milli", 1e-3},
      {"c", "centi", 1e-2}, {"d", "deci", 1e-1},   {"k", "kilo", 1e3},   {"M", "mega", 1e6},  {"G", "giga", 1e9},
  };
  return kPrefixes;
}

const WrittenUnits& written_units(Quantity quantity) {
  static constexpr WrittenUnits kWritten[kQuantityCount] = {
      {"1", {}},
      {"1", {}},
      {"rad", {"deg", "rad"}},
      {"um", {"mm", "um", "nm"}},
      {"um^2", {"mm^2", "um^2", "nm^2"}},
      {"um^3", {"mm^3", "um^3", "nm^3"}},
      {"s", {"h", "min", "s", "ms"}},
      {"1/s", {"1/s", "1/min", "1/h"}},
      {"um/s", {"um/s", "um/min", "um/h"}},
      {"g um/s^2", {"uN", "nN", "pN"}},
      {"g/um/s^2", {"MPa", "kPa", "Pa"}},
      {"g/s^2", {"N/m", "mN/m", "uN/m"}},
      {"g/um^2/s^2", {"kPa/um", "Pa/um"}},
      {"g um^2/s^2", {"pJ", "fJ", "aJ"}},
      {"g/um/s", {"kPa s", "Pa s", "mPa s"}},
      {"g/s", {"nN s/um", "pN s/um"}},
      {"g/um^2/s", {"nN s/um^3", "N s/m^3"}},
      {"amol", {"fmol", "amol"}},
      {"amol/s", {"fmol/s", "amol/s", "amol/h"}},
      {"amol/um^3", {"M", "mM", "uM", "nM"}},
      {"um^2/s", {"um^2/s", "um^2/h"}},
      {"um^2 s/g", {"um/s/kPa", "m/s/Pa"}},
  };
  return kWritten[static_cast<std::size_t>(quantity)];
}

std::span<const OtherDimension> other_dimensions() {
  static constexpr OtherDimension kOthers[] = {
      {"g", "a mass"},
      {"K", "a temperature"},
      {"g/um^3", "a mass density"},
      {"um/s^2", "an acceleration"},
      {"g um^2/s^3", "a power"},
      {"rad/s", "an angular speed"},
      {"1/um", "a number per length"},
      {"1/um^2", "a number per area"},
      {"1/um^3", "a number per volume"},
      {"amol/um^2", "an amount per area"},
      {"amol/um^2/s", "a flux of substance"},
      {"amol/um^3/s", "a concentration per time"},
      {"um/(g um/s^2)", "a length per force"},
  };
  return kOthers;
}

QuantityDescription describe(Quantity quantity) noexcept {
  static constexpr QuantityDescription kDescriptions[kQuantityCount] = {
      {"a plain number", "", "3"},
      {"a fraction", "", "10 %"},
      {"an angle", "rad", "30 deg"},
      {"a length", "um", "6 um"},
      {"an area", "um^2", "50 um^2"},
      {"a volume", "um^3", "900 um^3"},
      {"a time", "s", "18 h"},
      {"a rate", "1/s", "0.05 1/h"},
      {"a speed", "um/s", "2 um/h"},
      {"a force", "nN", "10 nN"},
      {"a pressure", "kPa", "2.5 kPa"},
      {"a surface energy or tension", "nN/um", "0.2 mN/m"},
      {"a pressure per length", "kPa/um", "100 kPa/um"},
      {"an energy", "fJ", "1 fJ"},
      {"a viscosity", "kPa s", "1 mPa s"},
      {"a friction coefficient", "nN s/um", "0.5 nN s/um"},
      {"a friction per area", "nN s/um^3", "5e10 N s/m^3"},
      {"an amount of substance", "amol", "40 amol"},
      {"an amount of substance per time", "amol/s", "40 amol/s"},
      {"a concentration", "mM", "0.2 mM"},
      {"a diffusion coefficient", "um^2/s", "2e-9 m^2/s"},
      {"a permeability to water", "um/s/kPa", "1e-12 m/s/Pa"},
  };
  return kDescriptions[static_cast<std::size_t>(quantity)];
}

}  // namespace morula
