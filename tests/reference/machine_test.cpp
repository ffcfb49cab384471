// The machine's numbers in data/reference.json: the shipped leg, its low level, gait and reported
// tables have them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/config/setting.h"
#include "sinew/control/gait/path.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/setup/installation.h"
#include "sinew/signals/tick.h"
#include "sinew/units/constants.h"
#include "tests/reference/reference.h"

namespace sinew::reference::machine_test {
namespace {

// --- the leg ------------------------------------------------------------------------------------

TEST(Reference, LegHasThePrintedDimensions) {
  for (const experiment::Experiment* e : {&leg(), &as_printed()}) {
    const robot::Robot& r = e->robot;
    SCOPED_TRACE(r.name);
    EXPECT_DOUBLE_EQ(r.links.at(0).length, si("l1"));
    EXPECT_DOUBLE_EQ(r.links.at(1).length, si("l2"));
    for (const robot::Joint& joint : r.joints) EXPECT_DOUBLE_EQ(joint.moment_arm, si("cam_radius"));
    EXPECT_NEAR(r.trolley.total_mass * units::standard_gravity, si("system_weight"), 1e-12);
    EXPECT_EQ(r.converter.bits, reference()["constants"]["adc"]["value"][0].get<int>());
    EXPECT_DOUBLE_EQ(r.converter.full_scale, reference()["constants"]["adc"]["value"][2]);
    EXPECT_EQ(r.low_level.pwm_ticks, static_cast<int>(si("pwm_ticks")));
  }
  EXPECT_EQ(as_printed().robot.name, "leg-as-printed");
  EXPECT_DOUBLE_EQ(as_printed().robot.trolley.drag, si("drag"));
  for (const robot::Muscle& m : as_printed().robot.muscles)
    EXPECT_DOUBLE_EQ(m.mount_length, si("free_length"));

  // [17] to [5]: the model moves 1.483 in, 4.2 measured 1.4.
  EXPECT_NEAR(si("range_of_motion"), si("L_max") - si("L_min"), 0.06 * si("range_of_motion"));
}

TEST(Reference, LegAsPrintedHasThePrintedValves) {
  int valves = 0;
  for (const gas::Valve& v : as_printed().valves) {
    EXPECT_DOUBLE_EQ(v.flow.efficiency, si("valve_eff")) << v.name;
    EXPECT_DOUBLE_EQ(v.flow.area, si("ApCq")) << v.name;
    const bool chapter_3 = v.kind == gas::Valve::Kind::three_way;
    EXPECT_DOUBLE_EQ(v.opening_delay, si(chapter_3 ? "t_valve_open_758" : "t_inlet_open_leg"));
    EXPECT_DOUBLE_EQ(v.closing_delay, si(chapter_3 ? "t_valve_close_758" : "t_inlet_close_leg"));
    ++valves;
  }
  EXPECT_GE(valves, 2);
}

TEST(Reference, Clocks) {
  EXPECT_DOUBLE_EQ(signals::tick_seconds, si("isr_period"));
  EXPECT_DOUBLE_EQ(1 / (si("isr_period") * si("pwm_ticks")), si("pwm_leg"));
  EXPECT_DOUBLE_EQ(as_printed().body_step, si("dt_code"));  // chosen by us; appendix A's step
  EXPECT_DOUBLE_EQ(as_printed().plan.high_level_period, 1 / si("pwm_leg"));
}

// Chapter 3's average; its own model remains below in every swing: "under-damped".
TEST(Reference, DampingRatio) {
  EXPECT_DOUBLE_EQ(printed("zeta"), 0.035);
  for (const char* name : {"A 60psi 6lb", "B 80psi 11lb", "C 60psi 11lb"})
    EXPECT_LT(reference()["verification_summary"][name]["equations"]["zeta_eq1"].get<double>(),
              printed("zeta"));
}

// --- controller ---------------------------------------------------------------------------------

TEST(Reference, Gains) {
  const json& gains = reference()["gains"];
  const double lbf_in = pound_force * inch;
  for (const experiment::Experiment* e : {&leg(), &as_printed()}) {
    ASSERT_EQ(e->plan.joints.size(), 2u);
    for (std::size_t j = 0; j < 2; ++j) {
      const std::string name = e->plan.joints[j].name;
      const json& table = gains["table_6_3"][name];
      const robot::Gains& g = e->plan.joints[j].gains;
      EXPECT_DOUBLE_EQ(100 * g.angle, table["G_theta"]);
      EXPECT_NEAR(100 * g.stiffness * lbf_in, table["G_k"].get<double>(), 1e-13);
      EXPECT_EQ(g.velocity, 0);
      EXPECT_NEAR(100 * g.angle * printed("counts_per_rad"),
                  gains["SI"][name]["G_theta_pct_per_rad"].get<double>(), 1e-12);
      EXPECT_NEAR(100 * g.stiffness, gains["SI"][name]["G_k_pct_per_Nm_rad"].get<double>(), 1e-12);
      EXPECT_NEAR(e->plan.joints[j].stiffness, gains["K_des_Nm_rad"][name].get<double>(), 1e-14);
      EXPECT_NEAR(e->plan.joints[j].stiffness / lbf_in,
                  gains["K_des_lb_in_rad"][name].get<double>(), 1e-13);

      // gain.dat: one row per joint after the cylinder's.
      const json& row = gains["gain_dat_rows"][j + 1];
      EXPECT_EQ(row[0], table["G_theta"]);
      EXPECT_EQ(row[1], table["G_k"]);
    }
  }
  EXPECT_EQ(gains["gain_dat_rows"][0], json({0.9, 35.0, 0}));
  EXPECT_EQ(gains["gain_dat_rows"][0][1].get<double>(), gains["K_des_lb_in_rad"]["hip"]);
  EXPECT_DOUBLE_EQ(config::quantity("0.02 % s/count", "s/count"),
                   gains["gain_dat_rows"][1][2].get<double>() / 100);
  EXPECT_EQ(gains["gain_dat_rows"][2][2], 0);
}

TEST(Reference, ChannelsBitsAndTicks) {
  const json& code = reference()["code_constants"];
  const std::map<std::string, std::string> channels = {{"lin", "cylinder_position"},
                                                       {"hip", "hip_angle"},
                                                       {"knee", "knee_angle"},
                                                       {"hip_flex", "hip_flexor_tension"},
                                                       {"hip_ext", "hip_extensor_tension"},
                                                       {"knee_flex", "knee_flexor_tension"},
                                                       {"knee_ext", "knee_extensor_tension"}};
  const std::map<std::string, std::string> ticks = {
      {"lin_pot", "cylinder_position"},
      {"hip_pot", "hip_angle"},
      {"knee_pot", "knee_angle"},
      {"hip_flex", "hip_flexor_tension"},
      {"hip_ext_and_control", "hip_extensor_tension"},
      {"knee_flex", "knee_flexor_tension"},
      {"knee_ext_and_control", "knee_extensor_tension"}};
  const std::map<std::string, std::string> muscles = {{"hip_flex", "hip_flexor"},
                                                      {"hip_ext", "hip_extensor"},
                                                      {"knee_flex", "knee_flexor"},
                                                      {"knee_ext", "knee_extensor"}};
  for (const experiment::Experiment* e : {&leg(), &as_printed()}) {
    const robot::Robot& r = e->robot;
    EXPECT_EQ(r.sensors.size(), code["adc_channels"].size());
    for (const auto& [key, channel] : code["adc_channels"].items())
      EXPECT_EQ(sensor(r, channels.at(key)).channel, channel) << key;
    for (const auto& [key, tick] : code["isr_read_ticks"].items())
      EXPECT_EQ(sensor(r, ticks.at(key)).tick, tick) << key;

    std::set<int> bits;
    for (const auto& [key, bit] : code["inlet_bits"].items()) {
      bits.insert(bit.get<int>());
      if (key.starts_with("lin")) continue;  // the cylinder has no valves here; 4 and 5 stay free
      const robot::Muscle& m =
          r.muscles.at(static_cast<std::size_t>(robot::find_muscle(r, muscles.at(key))));
      EXPECT_EQ(m.inlet_bit, bit) << key;
      EXPECT_EQ(m.exhaust_bit, 8 + bit.get<int>()) << key;
    }
    EXPECT_EQ(bits, (std::set{0, 1, 2, 3, 4, 5}));

    const char* pots[] = {"cylinder_position", "hip_angle", "knee_angle"};
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(sensor(r, pots[i]).assumed_at_rest, code["potoffset"][i].get<double>()) << pots[i];
  }
  EXPECT_EQ(code["exhaust_channel"], "8 + inlet bit");
  EXPECT_EQ(code["port_polarity"], "active low");
}

TEST(Reference, LowLevelsConstants) {
  const json& code = reference()["code_constants"];
  const control::JointControllerConfig config =
      control::joint_controller_config(run::installation(as_printed()));
  ASSERT_EQ(config.joints, 2u);
  for (std::size_t j = 0; j < 2; ++j) {
    const control::JointConfig& c = config.joint[j];
    EXPECT_EQ(c.flexor.thread_length_squared, printed("b_sq_counts"));
    EXPECT_EQ(c.flexor.free_length, printed("free_length_counts"));
    EXPECT_EQ(c.extensor.free_length, printed("free_length_counts"));
    EXPECT_EQ(c.stiffness_factor, static_cast<float>(printed("stiffness_factor")));
    EXPECT_EQ(c.moment_arm_factor, 1.0f);
    EXPECT_EQ(c.angle_at_rest, code["potoffset"][j + 1].get<int>());
  }
  EXPECT_EQ(config.joint[0].law_tick, code["isr_read_ticks"]["hip_ext_and_control"].get<int>());
  EXPECT_EQ(config.joint[1].law_tick, code["isr_read_ticks"]["knee_ext_and_control"].get<int>());
  EXPECT_EQ(config.period, si("pwm_ticks"));

  // Where the code's whole numbers come from.
  const double counts_per_inch = printed("counts_per_rad") / printed("cam_radius");
  EXPECT_EQ(std::floor(printed("b_thread") * counts_per_inch), 3235);
  EXPECT_EQ(3235 * 3235, printed("b_sq_counts"));
  EXPECT_NEAR(printed("free_length") * counts_per_inch, printed("free_length_counts"), 0.1);

  // Left out of the file, 5.5 follows from the scales.
  experiment::Experiment derived = as_printed();
  derived.robot.low_level.stiffness_factor = 0;
  const double counts_per_volt = derived.robot.converter.counts_per_volt();
  const double exact = printed("counts_per_rad") / (counts_per_volt * printed("force_scale_avg"));
  EXPECT_NEAR(exact, 5.5075, 5e-5);
  EXPECT_NEAR(
      control::joint_controller_config(run::installation(derived)).joint[0].stiffness_factor, exact,
      1e-6);
  EXPECT_NEAR(counts_per_volt * printed("force_scale_avg"), 139.264, 1e-9);
}

TEST(Reference, ScalesOfTheSensors) {
  const robot::Robot& r = leg().robot;
  for (const char* name : {"hip_angle", "knee_angle"}) {
    EXPECT_DOUBLE_EQ(sensor(r, name).scale, si("angle_scale"));
    EXPECT_DOUBLE_EQ(sensor(r, name).assumed_scale, si("counts_per_rad"));
  }
  EXPECT_NEAR(r.converter.counts_per_volt() / si("angle_scale"), 714, 0.5);

  // Table 4-1: the average against each.
  const json& table = reference()["tables"]["t4_1"];
  EXPECT_EQ(table["formula"], "(avg-s)/s");
  const char* names[] = {"hip_flexor_tension", "hip_extensor_tension", "knee_flexor_tension",
                         "knee_extensor_tension"};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const robot::Sensor& s = sensor(r, names[i]);
    EXPECT_DOUBLE_EQ(s.assumed_scale, si("force_scale_avg"));
    EXPECT_NEAR(s.scale * pound_force, table["V_per_lb"][i].get<double>(), 1e-15);
    EXPECT_NEAR(100 * (s.assumed_scale - s.scale) / s.scale, table["pct"][i].get<double>(), 0.05);
    sum += table["V_per_lb"][i].get<double>();
  }
  EXPECT_NEAR(sum / 4, printed("force_scale_avg"), 1e-4);
}

// --- gait ---------------------------------------------------------------------------------------

// The numbers of a printed formula, in their order.
std::vector<double> numbers(std::string text) {
  text = std::regex_replace(text, std::regex("\\^2"), "");
  std::vector<double> all;
  const std::regex number("[-+]?[0-9]+(\\.[0-9]+)?");
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it)
    all.push_back(std::stod(it->str()));
  return all;
}

const gait::Phase& phase(const gait::Plan& plan, const char* name) {
  return plan.phases.at(static_cast<std::size_t>(gait::find_phase(plan, name)));
}

TEST(Reference, FootPath) {
  const json& t = reference()["trajectory"];
  const auto swing = numbers(t["swing"]), plant = numbers(t["plant"]),
             propulsion = numbers(t["propulsion"]);
  ASSERT_EQ(swing.size(), 5u);
  ASSERT_EQ(plant.size(), 4u);
  ASSERT_EQ(propulsion.size(), 3u);
  for (const experiment::Experiment* e : {&leg(), &as_printed()}) {
    for (int i = 0; i <= 20; ++i) {
      const double s = i / 20.0;
      const robot::Point a = gait::foot_at(phase(e->plan, "swing"), s);
      double x = swing[0] + swing[1] * s;
      EXPECT_NEAR(a.x / inch, x, 1e-12);
      EXPECT_NEAR(a.y / inch, swing[2] * x * x + swing[3] * x + swing[4], 1e-12);

      const robot::Point b = gait::foot_at(phase(e->plan, "foot_plant"), s);
      x = plant[0] + plant[1] * s;
      EXPECT_NEAR(b.x / inch, x, 1e-12);
      EXPECT_NEAR(b.y / inch, plant[2] * x + plant[3], 1e-12);

      const robot::Point c = gait::foot_at(phase(e->plan, "propulsion"), s);
      EXPECT_NEAR(c.x / inch, propulsion[0] + propulsion[1] * s, 1e-12);
      EXPECT_NEAR(c.y / inch, propulsion[2], 1e-12);
    }
  }
}

TEST(Reference, Timing) {
  const json& t = reference()["trajectory"];
  const char* names[] = {"swing", "foot_plant", "propulsion"};
  for (int test : {1, 2}) {
    const auto e = load("walk-test-" + std::to_string(test));
    const json& table = t["timing_table_6_2"]["test" + std::to_string(test)];
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_DOUBLE_EQ(phase(e.plan, names[i]).duration, table[i]) << names[i];
  }

  const auto e = load("walk-test-1", {"sequence.thesis_timing=true"});
  const json& code = t["timing_code"];
  EXPECT_DOUBLE_EQ(e.plan.high_level_period, code["tick_s"]);
  EXPECT_DOUBLE_EQ(phase(e.plan, "foot_plant").thesis_duration, code["plant_dt_in_code"]);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(gait::periods(e.plan, phase(e.plan, names[i])), code["ticks_inclusive"][i].get<int>())
        << names[i];
}

// No experiment kicks yet; the gait's path has the printed formula, which joins both poses.
TEST(Reference, Kick) {
  const json& kick = reference()["trajectory"]["kick"];
  const auto n = numbers(kick["kick"]);
  ASSERT_EQ(n.size(), 8u);  // the last two: 0 <= t <= 0.1
  EXPECT_EQ(n[2], 0.1);
  EXPECT_EQ(n[7], n[2]);
  gait::Phase p;
  p.duration = n[2];
  p.x = {.from = n[0] * inch, .to = (n[0] + n[1]) * inch};
  p.y.polynomial = {n[5] * inch, n[4], n[3] / inch};
  p.y.of = gait::Coordinate::Of::x;
  const robot::Point start = gait::foot_at(p, 0), end = gait::foot_at(p, 1);
  EXPECT_NEAR(start.x / inch, kick["pre"][0].get<double>(), 1e-12);
  EXPECT_NEAR(start.y / inch, kick["pre"][1].get<double>(), 0.005);
  EXPECT_NEAR(end.x / inch, kick["hold"][0].get<double>(), 1e-12);
  EXPECT_NEAR(end.y / inch, kick["hold"][1].get<double>(), 0.005);

  EXPECT_EQ(numbers(kick["K_hip_ramp"]), (std::vector{-0.25, 10.0}));
  const json& rows = reference()["gains"]["gain_dat_rows"];
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(kick["tgain_pre"][i], rows[i][0]);
  EXPECT_EQ(kick["tgain_kick"], "tgain[1]=tgain[2]=tgain[0]=0.9");
  EXPECT_EQ(kick["tgain_hold"], json({0.9, 0.005, 0.12}));
}

// --- tables -------------------------------------------------------------------------------------

const config::Reported& reported(const experiment::Experiment& e, const std::string& key) {
  for (const config::Reported& r : e.reported)
    if (r.key == key) return r;
  throw std::out_of_range(key);
}

TEST(Reference, Table61) {
  const auto limits = load("joint-limits");
  const std::map<std::string, std::string> phases = {{"relaxed_from_flexion", "relaxed"},
                                                     {"relaxed_from_extension", "relaxed"},
                                                     {"flexed", "flex"},
                                                     {"extended", "ext"}};
  const json& table = reference()["tables"]["t6_1_deg"];
  for (const char* joint : {"hip", "knee"}) {
    for (const auto& [name, key] : phases) {
      const std::string entry = "phases." + name + ".joints." + joint + ".end_angle_true_rad";
      const double angle = config::quantity(reported(limits, entry).value, "rad");
      EXPECT_NEAR(angle / units::degree, table[joint][key].get<double>(), 1e-12) << entry;
    }
    const robot::Robot& r = leg().robot;
    const double rest = r.joints.at(joint[0] == 'h' ? 0 : 1).rest_angle / units::degree;
    EXPECT_NEAR(rest, table[joint]["relaxed"].get<double>(), 1e-12);
    EXPECT_NEAR(printed("relaxed_" + std::string(joint)) / units::degree, rest, 0.5);
  }
  const json &hip = table["hip"], &knee = table["knee"];
  EXPECT_EQ(hip["flex"].get<int>() - hip["ext"].get<int>(), hip["range_actual"]);
  EXPECT_EQ(hip["range_printed"], 57);  // the thesis's own subtraction
  EXPECT_EQ(knee["ext"].get<int>() - knee["flex"].get<int>(), knee["range"]);
  EXPECT_NEAR(printed("relaxed_hip") / units::degree, 278.343, 5e-4);
  EXPECT_NEAR(printed("relaxed_knee") / units::degree, 314.325, 5e-4);
}

// A joint is as passive as the busier of its muscles, the robot as its busiest joint.
TEST(Reference, Table64) {
  const json& table = reference()["tables"]["t6_4_pct"];
  analysis::Machine machine;
  machine.robot = leg().robot;
  double total = 100;
  for (const char* joint : {"hip", "knee"}) {
    const json& row = table[joint];
    const auto duty = [&](const char* key) { return row[key].get<double>() / 100; };
    const auto passive_of = [&](const char* role, const char* in, const char* out) {
      const int muscle = robot::find_muscle(machine.robot, joint + std::string(role));
      return analysis::passive(machine, machine.robot.muscles.at(static_cast<std::size_t>(muscle)),
                               duty(in), duty(out));
    };
    const double passive = 100 * std::min(passive_of("_flexor", "fi", "fe"),  //
                                          passive_of("_extensor", "ei", "ee"));
    EXPECT_NEAR(passive, row["passive"].get<double>(), 1e-12) << joint;
    total = std::min(total, passive);
    const std::string key = "joints." + std::string(joint) + ".passiveness";
    EXPECT_NEAR(100 * config::quantity(reported(leg(), key).value, "1"), passive, 1e-12);
  }
  EXPECT_NEAR(total, table["total"].get<double>(), 1e-12);
}

// A section that is added to the file must be added here.
TEST(Reference, NoSectionIsWithoutATest) {
  std::set<std::string> sections;
  for (const auto& [name, section] : reference().items()) sections.insert(name);
  EXPECT_EQ(sections,
            (std::set<std::string>{"constants", "gains", "code_constants", "trajectory", "tables",
                                   "fig_2_6", "predict_dat", "verification_summary"}));
}

}  // namespace
}  // namespace sinew::reference::machine_test
