#include "core/numbers/unit_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

namespace morula {
namespace {

using Kind = UnitError::Kind;
using testing::HasSubstr;

struct Written {
  const char* text;
  Quantity quantity;
  double internal;
};

// Internal values worked out by hand from the definitions of the SI; all are exact decimal numbers or ratios, so equality is asked for.
const Written kWritten[] = {
    {"18 h", Quantity::kTime, 64800.0},
    {"30 min", Quantity::kTime, 1800.0},
    {"96h", Quantity::kTime, 345600.0},
    {"2 days", Quantity::kTime, 172800.0},
    {"20 ms", Quantity::kTime, 0.02},
    {"1e-4 J/m^2", Quantity::kTension, 0.1},
    {"0.2 mN/m", Quantity::kTension, 0.2},
    {"1 mJ/m^2", Quantity::kTension, 1.0},
    {"2.5 kPa", Quantity::kPressure, 2.5},
    {"800 Pa", Quantity::kPressure, 0.8},
    {"1 mmHg", Quantity::kPressure, 0.133322387415},
    {"1 nN/um^2", Quantity::kPressure, 1.0},
    {"40 amol/s", Quantity::kAmountRate, 40.0},
    {"1 fmol/h", Quantity::kAmountRate, 1000.0 / 3600.0},
    {"1 pmol", Quantity::kAmount, 1e6},
    {"1 mol", Quantity::kAmount, 1e18},
    {"5e10 N s/m^3", Quantity::kFrictionPerArea, 50.0},
    {"1e8 N s/m^3", Quantity::kFrictionPerArea, 0.1},
    {"1 N s/m", Quantity::kFriction, 1000.0},
    {"2e-9 m^2/s", Quantity::kDiffusion, 2000.0},
    {"7e-9 m2/s", Quantity::kDiffusion, 7000.0},
    {"10 %", Quantity::kFraction, 0.1},
    {"7 %", Quantity::kFraction, 0.07},
    {"0.35", Quantity::kFraction, 0.35},
    {"1e-6", Quantity::kFraction, 1e-6},
    {"0.2 mM", Quantity::kConcentration, 0.2},
    {"1 M", Quantity::kConcentration, 1000.0},
    {"30 uM", Quantity::kConcentration, 0.03},
    {"1 mol/m^3", Quantity::kConcentration, 1.0},
    {"1 mmol/L", Quantity::kConcentration, 1.0},
    {"2 um/h", Quantity::kSpeed, 2.0 / 3600.0},
    {"1/h", Quantity::kRate, 1.0 / 3600.0},
    {"0.05 1/h", Quantity::kRate, 0.05 / 3600.0},
    {"0.05/h", Quantity::kRate, 0.05 / 3600.0},
    {"3 Hz", Quantity::kRate, 3.0},
    {"3 s^-1", Quantity::kRate, 3.0},
    {"3 s⁻¹", Quantity::kRate, 3.0},
    {"6 µm", Quantity::kLength, 6.0},
    {"6 μm", Quantity::kLength, 6.0},  // the Greek letter, not the micro sign
    {"6 um", Quantity::kLength, 6.0},
    {"1 m", Quantity::kLength, 1e6},
    {"1 Mm", Quantity::kLength, 1e12},
    {"200 nm", Quantity::kLength, 0.2},
    {"2 micrometers", Quantity::kLength, 2.0},
    {"-3 mm", Quantity::kLength, -3000.0},
    {"50 µm²", Quantity::kArea, 50.0},
    {"1 pL", Quantity::kVolume, 1000.0},
    {"1 m^3", Quantity::kVolume, 1e18},
    {"300 pN", Quantity::kForce, 0.3},
    {"1 N", Quantity::kForce, 1e9},
    {"1 fJ", Quantity::kEnergy, 1.0},
    {"1 J", Quantity::kEnergy, 1e15},
    {"1 mPa s", Quantity::kViscosity, 1e-6},
    {"1 Pa·s", Quantity::kViscosity, 1e-3},
    {"1e14 Pa/m", Quantity::kPressurePerLength, 1e5},
    {"100 kPa/um", Quantity::kPressurePerLength, 100.0},
    {"0.5 rad", Quantity::kAngle, 0.5},
    {"3", Quantity::kNumber, 3.0},
    {".5e1", Quantity::kNumber, 5.0},
    {"  +4.25  ", Quantity::kNumber, 4.25},
};

TEST(UnitConversion, ReadsWhatStudiesWrite) {
  const UnitSystem units;
  for (const Written& written : kWritten) {
    const auto value = units.parse(written.text, written.quantity);
    ASSERT_TRUE(value.ok()) << written.text << " " << value.error().message;
    EXPECT_EQ(value.value(), written.internal) << written.text;
  }
}

TEST(UnitConversion, ReadsDegrees) {
  const UnitSystem units;
  EXPECT_NEAR(units.parse("180 deg", Quantity::kAngle).value(), std::numbers::pi, 4e-16);
  EXPECT_NEAR(units.parse("90°", Quantity::kAngle).value(), std::numbers::pi / 2, 4e-16);
}

struct Wrong {
  const char* text;
  Quantity quantity;
  Kind kind;
  const char* words;
};

const Wrong kWrong[] = {
    {"18", Quantity::kTime, Kind::kNoUnit, "is a time and needs a unit"},
    {"18 parsec", Quantity::kTime, Kind::kUnknownUnit, "unknown unit 'parsec'"},
    {"18 hh", Quantity::kTime, Kind::kUnknownUnit, "unknown unit 'hh'"},
    {"18 H", Quantity::kTime, Kind::kUnknownUnit, "unknown unit 'H'"},
    {"5 @", Quantity::kTime, Kind::kUnknownUnit, "unknown unit"},
    {"1 lg(re 1 W)", Quantity::kTime, Kind::kUnknownUnit, "unknown unit"},
    {"2 m 3", Quantity::kLength, Kind::kUnknownUnit, "unknown unit"},
    {"2 mJ/m^2", Quantity::kPressure, Kind::kWrongDimension, "is a pressure, but 'mJ/m^2' is a surface energy or tension"},
    {"2 h", Quantity::kRate, Kind::kWrongDimension, "is a rate, but 'h' is a time"},
    {"2 1/h", Quantity::kTime, Kind::kWrongDimension, "is a time, but '1/h' is a rate"},
    {"2 m", Quantity::kConcentration, Kind::kWrongDimension, "is a concentration, but 'm' is a length"},
    {"2 M", Quantity::kLength, Kind::kWrongDimension, "is a length, but 'M' is a concentration"},
    {"2 mM", Quantity::kLength, Kind::kWrongDimension, "is a length, but 'mM' is a concentration"},
    {"2 mm", Quantity::kConcentration, Kind::kWrongDimension, "is a concentration, but 'mm' is a length"},
    {"2 kg", Quantity::kLength, Kind::kWrongDimension, "is a length, but 'kg' is a mass"},
    {"2 deg", Quantity::kFraction, Kind::kWrongDimension, "is a fraction, but 'deg' is an angle"},
    {"2 %", Quantity::kAngle, Kind::kWrongDimension, "is an angle, but '%' is a fraction"},
    {"2 rad/s", Quantity::kRate, Kind::kWrongDimension, "is a rate, but 'rad/s' is an angular speed"},
    {"2 s", Quantity::kNumber, Kind::kWrongDimension, "is a plain number, but has the unit 's'"},
    {"6 um^3/kg/s^7", Quantity::kNumber, Kind::kWrongDimension, "is a plain number"},
    {"6 um^3/kg/s^7", Quantity::kLength, Kind::kWrongDimension, "is a unit of something else"},
    {"six um", Quantity::kLength, Kind::kNotANumber, "does not begin with a number"},
    {"", Quantity::kLength, Kind::kNotANumber, "does not begin with a number"},
    {"um", Quantity::kLength, Kind::kNotANumber, "does not begin with a number"},
    {"0x10 um", Quantity::kLength, Kind::kUnknownUnit, "unknown unit"},
    {"1,5 um", Quantity::kLength, Kind::kNotANumber, "is not one number with a unit"},
    {"1 2 um", Quantity::kLength, Kind::kNotANumber, "is not one number with a unit"},
    {"1.2.3", Quantity::kNumber, Kind::kNotANumber, "is not one number with a unit"},
    {"010 um", Quantity::kLength, Kind::kNotANumber, "octal"},
    {"NaN", Quantity::kNumber, Kind::kNotFinite, "not a finite number"},
    {"nan um", Quantity::kLength, Kind::kNotFinite, "not a finite number"},
    {"-.inf", Quantity::kLength, Kind::kNotFinite, "not a finite number"},
    {"Infinity s", Quantity::kTime, Kind::kNotFinite, "not a finite number"},
    {"1e999 s", Quantity::kTime, Kind::kNotFinite, "too large"},
    {"1e9999 s", Quantity::kTime, Kind::kNotFinite, "too large"},
    {"1e305 mol", Quantity::kAmount, Kind::kNotFinite, "too large"},
};

TEST(UnitConversion, SaysWhatIsWrong) {
  const UnitSystem units;
  for (const Wrong& wrong : kWrong) {
    const auto value = units.parse(wrong.text, wrong.quantity);
    ASSERT_FALSE(value.ok()) << wrong.text << " was read as " << value.value();
    EXPECT_EQ(value.error().kind, wrong.kind) << wrong.text << ": " << value.error().message;
    EXPECT_THAT(value.error().message, HasSubstr(wrong.words)) << wrong.text;
    EXPECT_THAT(value.error().help, HasSubstr("for example `"));
  }
}

TEST(UnitConversion, EveryExampleIsAValueOfItsQuantityAndOfNoOther) {
  const UnitSystem units;
  for (int q = 0; q < kQuantityCount; ++q)
    for (int other = 1; other < kQuantityCount; ++other) {
      const auto quantity = static_cast<Quantity>(q);
      const auto value = units.parse(describe(quantity).example, static_cast<Quantity>(other));
      const bool plain_as_fraction = quantity == Quantity::kNumber && other == static_cast<int>(Quantity::kFraction);
      EXPECT_EQ(value.ok(), q == other || plain_as_fraction)
          << describe(quantity).example << " as " << describe(static_cast<Quantity>(other)).name;
    }
}

TEST(UnitConversion, InternalUnitsHaveFactorOne) {
  const UnitSystem units;
  for (int q = 0; q < kQuantityCount; ++q) {
    const auto quantity = static_cast<Quantity>(q);
    const auto factor = units.factor(describe(quantity).internal_unit, quantity);
    ASSERT_TRUE(factor.ok()) << describe(quantity).name << " " << factor.error().message;
    EXPECT_EQ(factor.value(), 1.0) << describe(quantity).name;
  }
}

TEST(UnitConversion, FactorsOfTableHeaders) {
  const UnitSystem units;
  EXPECT_EQ(units.factor("h", Quantity::kTime).value(), 3600.0);
  EXPECT_EQ(units.factor(" mm ", Quantity::kLength).value(), 1000.0);
  EXPECT_EQ(units.factor("", Quantity::kLength).error().kind, Kind::kNoUnit);
  EXPECT_EQ(units.factor("s", Quantity::kLength).error().kind, Kind::kWrongDimension);
  EXPECT_EQ(units.factor("furlongs", Quantity::kLength).error().kind, Kind::kUnknownUnit);
}

TEST(UnitConversion, WritesReadableValues) {
  const UnitSystem units;
  EXPECT_EQ(units.format_value(64800.0, Quantity::kTime), "18 h");
  EXPECT_EQ(units.format_value(1800.0, Quantity::kTime), "30 min");
  EXPECT_EQ(units.format_value(0.02, Quantity::kTime), "20 ms");
  EXPECT_EQ(units.format_value(0.2, Quantity::kLength), "200 nm");
  EXPECT_EQ(units.format_value(6.0, Quantity::kLength), "6 um");
  EXPECT_EQ(units.format_value(2.5, Quantity::kPressure), "2.5 kPa");
  EXPECT_EQ(units.format_value(-0.8, Quantity::kPressure), "-800 Pa");
  EXPECT_EQ(units.format_value(0.2, Quantity::kConcentration), "200 uM");
  EXPECT_EQ(units.format_value(2.0 / 3600.0, Quantity::kSpeed), "2 um/h");
  EXPECT_EQ(units.format_value(0.05 / 3600.0, Quantity::kRate), "0.05 1/h");
  EXPECT_EQ(units.format_value(50.0, Quantity::kFrictionPerArea), "50 nN s/um^3");
  EXPECT_EQ(units.format_value(0.1, Quantity::kFraction), "0.1");
  EXPECT_EQ(units.format_value(0.0, Quantity::kTime), "0 s");
  EXPECT_EQ(units.format_value(std::numeric_limits<double>::infinity(), Quantity::kTime), "inf");
}

TEST(UnitConversion, WritingAndReadingGivesTheSameBits) {
  const UnitSystem units;
  std::mt19937_64 random(7);  // NOLINT(cert-msc51-cpp): a fixed seed is the point
  const auto check = [&](double value, Quantity quantity) {
    const std::string text = units.format_value(value, quantity);
    const auto back = units.parse(text, quantity);
    ASSERT_TRUE(back.ok()) << text << " " << back.error().message;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.value()), std::bit_cast<std::uint64_t>(value)) << text;
  };
  for (int q = 0; q < kQuantityCount; ++q) {
    const auto quantity = static_cast<Quantity>(q);
    for (const double value : {0.0, -0.0, 1.0, 0.1, 1.0 / 3.0, 1e-300, 5e-324, 1e300, std::numeric_limits<double>::max()})
      check(value, quantity);
    for (int i = 0; i < 60; ++i) {
      const double mantissa = 1.0 + std::ldexp(static_cast<double>(random() >> 12), -52);
      check(std::ldexp(mantissa, static_cast<int>(random() % 60) - 30), quantity);
    }
  }
}

TEST(UnitConversion, ThreadsMayReadAtOnce) {
  const UnitSystem units;
  std::vector<int> right(4, 0);
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < right.size(); ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 50; ++i)
          for (const Written& written : kWritten) right[t] += units.parse(written.text, written.quantity).value() == written.internal;
      });
  }
  for (const int count : right) EXPECT_EQ(count, 50 * static_cast<int>(std::size(kWritten)));
}

}  // namespace
}  // namespace morula
