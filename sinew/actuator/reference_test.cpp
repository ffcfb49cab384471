// Values of the actuator in data/reference.json: printed ones and those derived from them.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "sinew/actuator/bundle.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/thesis_actuator.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::actuator::reference_test {
namespace {

using nlohmann::json;
using units::atmosphere;
using units::inch;
using units::pound_force;
using units::psi;

const json& reference() {
  static const json data =
      json::parse(std::ifstream(sinew::test::source_dir() + "/data/reference.json"));
  return data;
}

// A constant as printed, and in SI.
double printed(const std::string& name) { return reference()["constants"][name]["value"]; }
double si(const std::string& name) { return reference()["constants"][name]["si"]; }

TEST(ReferenceActuator, ConstantsAreTheirPrintedValuesInSi) {
  const double lbf_per_in = pound_force / inch;
  EXPECT_DOUBLE_EQ(si("trapezoid_side"), printed("trapezoid_side") * inch);
  EXPECT_DOUBLE_EQ(si("L_max"), printed("L_max") * inch);
  EXPECT_DOUBLE_EQ(si("free_length"), printed("free_length") * inch);
  EXPECT_DOUBLE_EQ(si("P_atm"), atmosphere);
  EXPECT_DOUBLE_EQ(si("K_braid"), printed("K_braid") * lbf_per_in);
  EXPECT_DOUBLE_EQ(si("C_braid"), printed("C_braid") * lbf_per_in);
  EXPECT_DOUBLE_EQ(si("c_viscous"), printed("c_viscous") * lbf_per_in);
  EXPECT_DOUBLE_EQ(si("Q_text"), printed("Q_text") * inch);
  EXPECT_DOUBLE_EQ(si("Q_code"), printed("Q_code") * inch);
  EXPECT_DOUBLE_EQ(si("L_init_code"), printed("L_init_code") * inch);

  const json& eff = reference()["constants"]["eff_poly"];
  EXPECT_DOUBLE_EQ(eff["si"][0].get<double>(), eff["value"][0].get<double>() / (psi * psi));
  EXPECT_DOUBLE_EQ(eff["si"][1].get<double>(), eff["value"][1].get<double>() / psi);
  EXPECT_DOUBLE_EQ(eff["si"][2].get<double>(), eff["value"][2].get<double>());
}

TEST(ReferenceActuator, ReadyMadeActuatorHasTheseConstants) {
  const Actuator a = thesis_actuator();
  EXPECT_DOUBLE_EQ(thesis_atmosphere, si("P_atm"));
  EXPECT_DOUBLE_EQ(a.braid.thread_length, si("b_thread"));
  EXPECT_DOUBLE_EQ(a.braid.turns, si("n_turns"));
  EXPECT_DOUBLE_EQ(a.long_end.length, si("L_max"));
  EXPECT_DOUBLE_EQ(a.long_end.stiffness, si("K_braid"));
  EXPECT_DOUBLE_EQ(a.long_end.damping, si("C_braid"));
  EXPECT_DOUBLE_EQ(a.loss.viscous, si("c_viscous"));
  EXPECT_DOUBLE_EQ(a.loss.coulomb_length, si("Q_text"));
  const json& eff = reference()["constants"]["eff_poly"]["si"];
  EXPECT_DOUBLE_EQ(a.effectiveness.c2, eff[0].get<double>());
  EXPECT_DOUBLE_EQ(a.effectiveness.c1, eff[1].get<double>());
  EXPECT_DOUBLE_EQ(a.effectiveness.c0, eff[2].get<double>());
}

TEST(ReferenceActuator, BraidFollowsFromTheMesh) {
  const Braid braid = braid_from_trapezoids(
      si("trapezoids_lengthwise_A"), si("trapezoids_circumferential_B"), si("trapezoid_side"));
  EXPECT_NEAR(braid.thread_length, si("b_thread"), 1e-15);
  EXPECT_DOUBLE_EQ(braid.turns, si("n_turns"));
  EXPECT_NEAR(shortest_length(braid), si("L_min"), 1e-15);
  EXPECT_NEAR(braid_angle(braid, shortest_length(braid)), si("theta_max"), 1e-11);
  EXPECT_NEAR(braid_angle(braid, shortest_length(braid)) / units::degree, printed("theta_max"),
              5e-5);
  EXPECT_NEAR(si("L_max"), braid.thread_length - 0.3 * inch, 1e-15);

  // The model's range of motion; 4.2 measures 1.4 in. Its middle; 4.2 mounts at 3.15 in.
  EXPECT_NEAR((si("L_max") - shortest_length(braid)) / inch, 1.483, 5e-4);
  EXPECT_NEAR((si("L_max") + shortest_length(braid)) / 2 / inch, 3.177, 5e-4);
}

// All rows, to the four decimals printed there.
TEST(ReferenceActuator, Figure26) {
  const Braid braid = thesis_actuator().braid;
  int points = 0;
  for (const auto& [length_text, row] : reference()["fig_2_6"]["rows"].items()) {
    const bool shortest = length_text == "2.4353";  // a rounded key for the exact b/sqrt 3
    const double length = shortest ? shortest_length(braid) : std::stod(length_text) * inch;
    for (const auto& [pressure_text, values] : row.items()) {
      const double gauge = std::stod(pressure_text) * psi;
      const double pull = ideal_tension(braid, length, gauge) / pound_force;
      const double k = ideal_stiffness(braid, length, gauge) / (pound_force / inch);
      EXPECT_NEAR(pull, values[0].get<double>(), 5.1e-5) << length_text << " " << pressure_text;
      EXPECT_NEAR(k, values[1].get<double>(), 5.1e-5) << length_text << " " << pressure_text;
      ++points;
    }
  }
  EXPECT_EQ(points, 180);
}

TEST(ReferenceActuator, EffectivenessByGaugeAndByAbsolutePressure) {
  Effectiveness gauge = thesis_actuator().effectiveness;
  Effectiveness absolute = gauge;
  absolute.argument = Effectiveness::Argument::absolute;
  const double pressures[] = {60, 80, 100};
  const double by_gauge[] = {.955, .909, .847}, by_absolute[] = {.923, .865, .791};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(effectiveness(gauge, pressures[i] * psi, atmosphere), by_gauge[i], 5e-4);
    EXPECT_NEAR(effectiveness(absolute, pressures[i] * psi, atmosphere), by_absolute[i], 5e-4);
  }
}

// 4.2: "about 15 lb", and the force of two actuators at full length.
TEST(ReferenceActuator, GreatestTension) {
  const Actuator a = thesis_actuator();
  const double gauge = 100 * psi;
  const double middle = clamped_tension(a, si("free_length"), 0, gauge, atmosphere) / pound_force;
  EXPECT_NEAR(middle, printed("F_actuator_max_text"), 0.1);
  EXPECT_NEAR(middle, 15.1, 0.05);
  EXPECT_NEAR(clamped_tension(a, si("L_max"), 0, gauge, atmosphere) / pound_force, 35.6, 0.05);
  const Bundle two{.actuator = a, .count = 2};
  EXPECT_NEAR(clamped_tension(two, si("L_max"), 0, gauge, atmosphere) / pound_force, 71, 0.5);
}

// Returns the length at which a load is in equilibrium on an actuator at a gauge pressure.
double hanging_length(const Actuator& a, double load, double gauge) {
  double low = shortest_length(a.braid), high = a.long_end.length;
  while (high - low > 1e-15) {
    const double middle = (low + high) / 2;
    (clamped_tension(a, middle, 0, gauge, atmosphere) < load ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Section 3.4, air trapped: the "nominal pressure" is the gauge pressure with the load at rest, so
// neither the air's exponent nor the external volume affects the equilibrium.
TEST(ReferenceActuator, EquilibriaOfTheTrappedAirTests) {
  struct Setup {
    const char* name;
    double pressure, load;
  };
  for (const Setup& setup :
       {Setup{"A 60psi 6lb", 60, 6}, {"B 80psi 11lb", 80, 11}, {"C 60psi 11lb", 60, 11}}) {
    const json& expected = reference()["verification_summary"][setup.name];
    const double load = setup.load * pound_force, gauge = setup.pressure * psi;

    Actuator a = thesis_actuator();
    EXPECT_NEAR(hanging_length(a, load, gauge) / inch, expected["Leq_eq"].get<double>(), 1e-12);
    a.effectiveness.argument = Effectiveness::Argument::absolute;
    EXPECT_NEAR(hanging_length(a, load, gauge) / inch, expected["Leq_code"].get<double>(), 1e-12);
  }
}

// docs/evidence/departures.md on [33] with [45]: secant over sealed stiffness at these equilibria.
TEST(ReferenceActuator, SecantIsWellBelowTheSealedStiffness) {
  const double pressure[] = {60, 80, 60}, load[] = {6, 11, 11}, ratio[] = {.82, .74, .62};
  for (int i = 0; i < 3; ++i) {
    const Actuator a = thesis_actuator();
    const double gauge = pressure[i] * psi;
    const double length = hanging_length(a, load[i] * pound_force, gauge);
    const double secant = secant_stiffness(a, length, gauge, atmosphere);
    const double sealed = stiffness_sealed(a, length, gauge + atmosphere, atmosphere,
                                           si("V_ext_const_mass"), si("gamma"));
    EXPECT_NEAR(secant / sealed, ratio[i], 0.002);
  }
}

}  // namespace
}  // namespace sinew::actuator::reference_test
