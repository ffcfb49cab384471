// The constants of data/reference.json: each is its printed value in SI.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sinew/analysis/measures/laws.h"
#include "sinew/config/setting.h"
#include "sinew/control/gait/path.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/experiment/experiment.h"
#include "sinew/signals/tick.h"
#include "sinew/units/constants.h"
#include "sinew/units/quantity.h"
#include "tests/reference/reference.h"

namespace sinew::reference::constants_test {
namespace {

// --- constants ----------------------------------------------------------------------------------

// The reference's spelling of a unit in ours.
std::string our_unit(const std::string& name, const std::string& unit) {
  static const std::map<std::string, std::string> spelling = {
      {"-", "1"},
      {"psig", "psi gauge"},
      {"psia", "psi abs"},
      {"R", "degR"},
      {"ft^2", "ft2"},
      {"in^3", "in3"},
      {"in/s^2", "in/s2"},
      {"slug/in^3", "slug/in3"},
      {"ft lbf/(lbm R)", "ft lbf/(lb degR)"},
      {"V/lb", "V/lbf"},  // of the force transducers
      {"m^2", "m2"},
      {"m^3", "m3"},
      {"m/s^2", "m/s2"},
      {"kg/m^3", "kg/m3"}};
  if (name == "P_atm") return unit == "psi" ? "psi abs" : "Pa abs";
  if (name == "E_6061") return unit == "psi" ? "psi diff" : "Pa diff";  // a modulus
  const auto it = spelling.find(unit);
  return it == spelling.end() ? unit : it->second;
}

double converted(double value, const std::string& unit, const std::string& si_unit) {
  const std::string number = units::format_number(value);
  return config::quantity(unit == "1" ? number : number + " " + unit, si_unit, "constant");
}

TEST(Reference, EveryConstantIsItsPrintedValueInSi) {
  // Lists, an angle cut for print, roots of units, and counts, which the reference has without a
  // dimension; below.
  const std::set<std::string> exceptions = {"eff_poly",           "theta_max",  "Cm_choked_code",
                                            "Cm_free_code",       "flow_83.66", "b_sq_counts",
                                            "free_length_counts", "beam",       "adc"};
  std::size_t converted_ones = 0;
  for (const auto& [name, c] : reference()["constants"].items()) {
    if (exceptions.contains(name)) continue;
    const double want = c["si"];
    const double got =
        converted(c["value"], our_unit(name, c["unit"]), our_unit(name, c["si_unit"]));
    EXPECT_NEAR(got, want, 4e-15 * std::abs(want)) << name;
    ++converted_ones;
  }
  EXPECT_EQ(converted_ones + exceptions.size(), reference()["constants"].size());
}

TEST(Reference, ConstantsWithSeveralValuesOrCounts) {
  const json& c = reference()["constants"];
  const char* from[] = {"1/psi2", "1/psi", "1"};
  const char* to[] = {"1/Pa2", "1/Pa", "1"};
  for (std::size_t i = 0; i < 3; ++i) {
    const double want = c["eff_poly"]["si"][i];
    EXPECT_NEAR(converted(c["eff_poly"]["value"][i], from[i], to[i]), want, 4e-15 * std::abs(want));
    const double side = c["beam"]["si"][i];
    EXPECT_NEAR(converted(c["beam"]["value"][i], "in", "m"), side, 4e-15 * side);
    EXPECT_EQ(c["adc"]["value"][i], c["adc"]["si"][i]);
  }
  EXPECT_EQ(printed("b_sq_counts"), si("b_sq_counts"));
  EXPECT_EQ(printed("free_length_counts"), si("free_length_counts"));
  EXPECT_EQ(printed("flow_83.66"), si("flow_83.66"));

  // 54.7 deg is printed; the four decimals and the radians are those of acos(1/sqrt 3).
  EXPECT_NEAR(printed("theta_max") * units::degree, si("theta_max"), 5e-5 * units::degree);
  EXPECT_NEAR(si("theta_max"), std::acos(1 / std::sqrt(3.0)), 1e-11);

  // The code's flow: 83.66 in^3/s/psi times its density times its rounded C_m.
  const double per_parameter =
      printed("flow_83.66") * si("density") * std::pow(inch, 3) / units::psi;
  for (const char* name : {"Cm_choked_code", "Cm_free_code"})
    EXPECT_NEAR(per_parameter * printed(name), si(name), 1e-12 * si(name)) << name;
}

// Not modelled, so checked as numbers only: the hip's cylinder and its potentiometer (it remains at
// its stop), the counterweight, the force transducer's beam and amplifier.
TEST(Reference, ConstantsOfWhatIsNotModelled) {
  const std::map<std::string, double> values = {{"cylinder_bore", 0.627}, {"cylinder_stroke", 2},
                                                {"counterweight", 10},    {"lin_pot_scale", 0.57},
                                                {"amp_gain", 800},        {"E_6061", 1e7}};
  for (const auto& [name, value] : values) EXPECT_DOUBLE_EQ(printed(name), value) << name;
  EXPECT_EQ(reference()["constants"]["beam"]["value"], json({0.75, 0.3, 0.15}));
}

}  // namespace
}  // namespace sinew::reference::constants_test
