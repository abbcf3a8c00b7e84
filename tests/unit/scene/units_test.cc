#include "comparisons/scene/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace comparisons::scene;

namespace {

Quantity good(const std::string &text) {
  const auto result = parse_quantity(text);
  if (const auto *error = std::get_if<QuantityError>(&result)) {
    ADD_FAILURE() << text << ": " << error->message;
    return {};
  }
  return std::get<Quantity>(result);
}

QuantityError bad(const std::string &text) {
  const auto result = parse_quantity(text);
  if (const auto *error = std::get_if<QuantityError>(&result))
    return *error;
  ADD_FAILURE() << text << " is read as " << std::get<Quantity>(result).value;
  return {};
}

} // namespace

// Decimal prefixes are joined to the digits, so these hold bit for bit.
TEST(SceneUnits, FactorsAreExact) {
  struct Case {
    std::string text;
    double value;
    Dimension dimension;
  };
  const Dimension pressure = dimensions::pressure;
  const Dimension length = dimensions::length;
  const Dimension time = dimensions::time;
  const Dimension force{.mass = 1, .length = 1, .time = -2};
  const std::vector<Case> cases{
      {"226.9 GPa", 226.9e9, pressure},
      {"226.9GPa", 226.9e9, pressure},
      {"2.269e5 MPa", 226.9e9, pressure},
      {"226.9e9 Pa", 226.9e9, pressure},
      {"226900 N/mm^2", 226.9e9, pressure},
      {"1 hPa", 100, pressure},
      {"1 bar", 1e5, pressure},
      {"10 kbar", 1e9, pressure},
      {"1 psi", 6894.757293168361, pressure},
      {"5 mm", 0.005, length},
      {"0.3 um", 0.3e-6, length},
      {"0.3 \xC2\xB5m", 0.3e-6, length},
      {"0.3 \xCE\xBCm", 0.3e-6, length},
      {"3 cm", 0.03, length},
      {"2 km", 2000, length},
      {"7 nm", 7e-9, length},
      {"1 in", 0.0254, length},
      {"1 ft", 0.3048, length},
      {"-5 mm", -0.005, length},
      {"+5 mm", 0.005, length},
      {"\xE2\x88\x92"
       "5 mm",
       -0.005, length},
      {"2 ms", 0.002, time},
      {"10 min", 600, time},
      {"1.5 h", 5400, time},
      {"300 K", 300, dimensions::temperature},
      {"1 kN", 1000, force},
      {"1 kg m s^-2", 1, force},
      {"1e6 N/m", 1e6, dimensions::force_per_length},
      {"1 kN m^-1", 1000, dimensions::force_per_length},
      {"1 kN/mm", 1e6, dimensions::force_per_length},
      {"7850 kg/m^3", 7850, dimensions::density},
      {"7850 kg/m3", 7850, dimensions::density},
      {"7850 kg/m\xC2\xB3", 7850, dimensions::density},
      {"7850 kg m\xE2\x81\xBB\xC2\xB3", 7850, dimensions::density},
      {"7.85 g/cm^3", 7850, dimensions::density},
      {"7.85 t/m^3", 7850, dimensions::density},
      {"1 m/s", 1, dimensions::velocity},
      {"5 km/s", 5000, dimensions::velocity},
      {"36 km/h", 10, dimensions::velocity},
      {"1 N*m", 1, {.mass = 1, .length = 2, .time = -2}},
      {"1 N\xC2\xB7m", 1, {.mass = 1, .length = 2, .time = -2}},
      {"1 J", 1, {.mass = 1, .length = 2, .time = -2}},
      {"1 kW", 1000, {.mass = 1, .length = 2, .time = -3}},
      {"4.18 kJ/(kg K)", 4180, {.length = 2, .time = -2, .temperature = -1}},
      {"4.18 kJ kg^-1 K^-1", 4180, {.length = 2, .time = -2, .temperature = -1}},
      {"12e-6 1/K", 12e-6, {.temperature = -1}},
      {"12e-6 /K", 12e-6, {.temperature = -1}},
      {"2 kHz", 2000, {.time = -1}},
      {"1 m/s/s", 1, {.length = 1, .time = -2}},
      {"1 (m/s)^2", 1, {.length = 2, .time = -2}},
      {"25 %", 0.25, {}},
      {"2 rad", 2, {}},
  };
  for (const auto &[text, value, dimension] : cases) {
    const Quantity quantity = good(text);
    EXPECT_EQ(quantity.value, value) << text;
    EXPECT_EQ(quantity.dimension, dimension) << text;
    EXPECT_TRUE(quantity.has_unit) << text;
  }
  // 180 deg is pi up to the rounding of the factor.
  EXPECT_NEAR(good("180 deg").value, std::numbers::pi, 4e-16 * std::numbers::pi);
}

TEST(SceneUnits, PlainNumbersHaveNoUnit) {
  for (const auto &[text, value] : std::vector<std::pair<std::string, double>>{
           {"0.33", 0.33}, {" 2 ", 2.0}, {"-1e-3", -0.001}, {".5", 0.5}, {"5.", 5.0}, {"1E3", 1000.0}}) {
    EXPECT_EQ(good(text).value, value) << text;
    EXPECT_FALSE(good(text).has_unit) << text;
  }
}

TEST(SceneUnits, WrongTextsSayWhatToWrite) {
  EXPECT_EQ(bad("226.9 gpa").message, "unknown unit 'gpa'");
  EXPECT_EQ(bad("226.9 gpa").suggestion, "did you mean 'GPa'?");
  EXPECT_EQ(bad("5 mmm").suggestion, "did you mean 'mm'?");
  EXPECT_EQ(bad("226,9 GPa").suggestion, "the decimal sign is a point");
  EXPECT_NE(bad("GPa").message.find("does not begin with a finite number"), std::string::npos);
  EXPECT_NE(bad("1 J/kg K").message.find("ambiguous"), std::string::npos);
  EXPECT_NE(bad("1 J/kg K").suggestion.find("J/(kg K)"), std::string::npos);
  EXPECT_NE(bad("20 \xC2\xB0"
                "C")
                .message.find("kelvin"),
            std::string::npos);
  EXPECT_NE(bad("1 m^0.5").message.find("whole number"), std::string::npos);
  EXPECT_NE(bad("1 m^99").message.find("from -9 to 9"), std::string::npos);
  EXPECT_NE(bad("1e400 m").message.find("beyond the range"), std::string::npos);
  EXPECT_NE(bad("1e300 GGPa").message.find("unknown unit"), std::string::npos);
  EXPECT_NE(bad("1e305 GPa").message.find("beyond the range"), std::string::npos);
  EXPECT_NE(bad("1e99999999999999999999 m").message.find("beyond the range"), std::string::npos);
}

TEST(SceneUnits, NothingElseIsANumber) {
  for (const auto *text :
       {"",     " ",    "nan",    "inf",  "-inf m", "infinity", "m",  "--5 m", "1 m^", "1 (m",   "1 m)",      "1 ()",
        "1 m*", "1 m/", "1 m//s", "0x10", "1 m;",   "1 2 m",    "e5", ".",     "+",    "1 \xFF", "(((((((((("}) {
    EXPECT_FALSE(bad(text).message.empty()) << text;
  }
  EXPECT_NE(bad(std::string(100000, '(')).message.find("too long"), std::string::npos);
}

TEST(SceneUnits, BytesAreCounted) {
  const auto bytes = [](const std::string &text) {
    const auto result = parse_bytes(text);
    const auto *value = std::get_if<std::int64_t>(&result);
    return value != nullptr ? *value : -1;
  };
  EXPECT_EQ(bytes("4 GiB"), std::int64_t{4} << 30);
  EXPECT_EQ(bytes("2 GB"), 2000000000);
  EXPECT_EQ(bytes("500MB"), 500000000);
  EXPECT_EQ(bytes("1.5 KiB"), 1536);
  EXPECT_EQ(bytes("1048576"), 1048576);
  EXPECT_EQ(bytes("7 B"), 7);
  for (const auto *text : {"", "GiB", "4 GiBs", "0 B", "-4 GiB", "1e30 GB", "nan", "4 GPa"})
    EXPECT_EQ(bytes(text), -1) << text;
  EXPECT_EQ(std::get<QuantityError>(parse_bytes("4 gib")).suggestion, "did you mean 'GiB'?");
}

// What is printed reads back as the same bits.
TEST(SceneUnits, PrintedQuantitiesReadBack) {
  const std::vector<std::pair<double, Dimension>> cases{{226.9e9, dimensions::pressure},
                                                        {1e7, dimensions::pressure},
                                                        {0.005, dimensions::length},
                                                        {1.0 / 3.0, dimensions::length},
                                                        {2e-3, dimensions::time},
                                                        {7850, dimensions::density},
                                                        {-1, dimensions::force_per_length},
                                                        {1e300, dimensions::pressure},
                                                        {0.0, dimensions::length},
                                                        {1e-300, dimensions::time},
                                                        {5, {.mass = 2, .length = 3, .time = -1}}};
  for (const auto &[value, dimension] : cases) {
    const Quantity back = good(quantity_text(value, dimension));
    EXPECT_EQ(back.value, value);
    EXPECT_EQ(back.dimension, dimension);
  }
  EXPECT_EQ(quantity_text(226.9e9, dimensions::pressure), "226.9 GPa");
  EXPECT_EQ(quantity_text(1e7, dimensions::pressure), "10 MPa");
  EXPECT_EQ(quantity_text(0.005, dimensions::length), "5 mm");
  EXPECT_EQ(quantity_text(0.33, dimensions::none), "0.33");
  EXPECT_EQ(unit_text({.mass = 2, .length = 3, .time = -1}), "kg^2 m^3 s^-1");
}
