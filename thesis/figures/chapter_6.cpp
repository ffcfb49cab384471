// thesis/figures/chapter_6.cpp - walking, 6-1 and 6-3 to 6-11: test 1, which is plotted in 6.3.
#include <algorithm>
#include <cmath>

#include "sinew/analysis/measures/statistics.h"
#include "sinew/units/constants.h"
#include "thesis/figures/leg_run.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using analysis::Column;
using report::Claim, report::Curve;
using Weights = analysis::Column;

constexpr const char* foot = "/foot/position";
constexpr const char* desired_foot = "/desired/foot/position";

// Returns the difference of two columns, row by row.
Column difference(const Column& a, const Column& b) {
  Column out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] - b[i]);
  return out;
}

Weights phase_of(const LegRun& run, std::string_view name) {
  return run.record().part(analysis::find_phase(run.machine(), name), 0, 1);
}

// --- paths --------------------------------------------------------------------------------------

// Returns y of the desired foot over its x by [66], [68], [70] [in].
double planned_y(const std::string& phase, double x) {
  if (phase == "swing") return -0.081 * x * x - 0.2571 * x - 11.75;
  return phase == "foot_plant" ? 0.25 * x - 14 : -13.5;
}

Exhibit figure_6_1(const LegRun& run) {
  report::Plot plot{.x = {"x forward", "in"}, .y = {"y up", "in"}, .equal_scale = true};
  double off = 0;
  int color = 0;
  for (const char* phase : {"swing", "foot_plant", "propulsion"}) {
    // Extended to the next phase's first row, so that lines meet.
    Curve c = run.path(spaced_name(phase), desired_foot, run.phase(phase));
    c.color = color++;
    for (std::size_t i = 0; i + 1 < c.xs.size(); ++i)
      off = std::max(off, std::fabs(c.ys[i] - planned_y(phase, c.xs[i])));
    plot.curves.push_back(std::move(c));
  }
  return {{.name = "6-1",
           .title = "Desired foot position",
           .caption = "One step of the desired path of the ankle about the hip, by the plan of "
                      "experiments/walk-test-1.toml.",
           .plots = {std::move(plot)}},
          {Section("[66], [68], [70]")
               .number(code_against_code, "An arc of second order, then two straight lines", "",
                       "largest distance in y from the equations", off, "in",
                       analysis::another(0, 1e-9), "rounding")}};
}

Exhibit figure_6_3(const LegRun& run) {
  const Weights propulsion = phase_of(run, "propulsion");
  const Column y = run.rows({foot, "y"}), wanted = run.rows({desired_foot, "y"});
  const double table = analysis::mean(y, propulsion);
  return {foot_path(run, "6-3", "Desired and actual foot path",
                    "Four steps over each other, of the measured angles by forward kinematics; the "
                    "path from rest to the first step among them.",
                    run.sequence()),
          {Section("6.3").number(put_in, "The table is at about -13 in", "-13 in",
                                 "mean y of the actual path in propulsion", table, "in",
                                 analysis::another(-13.2, -12.8),
                                 "\"about\": 10 % of the path's height of 2 in"),
           Section("6.3").number(
               put_in, "What is desired in propulsion lies 0.5 in lower than what is possible",
               "0.5 in", "mean y in propulsion, actual less desired",
               table - analysis::mean(wanted, propulsion), "in", analysis::measured(0.5, 0.1), "",
               "angles come from 714 counts/rad and are taken for 767, which lowers "
               "the measured foot to -13.09 in; the true one is at -13.01 in"),
           Section("6.3").number(predicted, "The actual path repeats itself very well", "",
                                 "rms distance of steps from their mean",
                                 run.summary("foot.step_repeat_rms_m") / units::inch, "in",
                                 analysis::another(0, 0.25),
                                 "half of the gap to the table, less than 5 % of the way")}};
}

// --- over time ----------------------------------------------------------------------------------

// Returns the weights of swing with the foot in the air: the leg lags its plan and is still on the
// ground when swing begins.
Weights in_the_air(const LegRun& run) {
  const Column load = run.rows({"/true/foot/force", "y"});
  Weights out = run.record().swing();
  for (std::size_t i = 0; i < out.size(); ++i)
    if (load[i] > 0) out.set(i, 0);
  return out;
}

// Reason that forces do not vanish in swing. With the three links at 0.01 lb each, dampings of 0.8
// lbf in s/rad and no dry friction the torques have 4.5 and 4.9 %, the false reactions 4.3 %.
constexpr const char* moves_against =
    "the muscles carry what the links weigh and what our fitted joints damp and rub; with hardly "
    "any of the three it is under 5 %, without one of them it is not";

// Returns the rms in the air as a share of the range over the walk [%].
double in_the_air_of_range(const LegRun& run, const Column& values) {
  const Weights& walk = run.record().sequence();
  const double range = analysis::largest(values, walk) - analysis::smallest(values, walk);
  return 100 * analysis::rms(values, in_the_air(run)) / range;
}

// Returns the smallest of the four distances of the joints to the limits of table 6-1; negative if
// one is exceeded [deg].
double to_a_limit(const LegRun& run) {
  const auto degrees = [&](const char* key) { return run.summary(key) * 180 / M_PI; };
  return std::min(
      {307 - degrees("joints.hip.max_angle_rad"), degrees("joints.hip.min_angle_rad") - 249,
       degrees("joints.knee.min_angle_rad") - 289, 343 - degrees("joints.knee.max_angle_rad")});
}

Exhibit figure_6_4(const LegRun& run) {
  Exhibit out{joint_angles(run, "6-4", "Joint angles of test 1"), {}};
  const Column error =
      difference(run.rows({"/joint/hip/angle"}), run.rows({"/desired/joint/hip/angle"}));
  const Column wanted = run.rows({"/desired/joint/knee/angle"});
  Column beyond;
  for (const double a : wanted) beyond.push_back(a < 289 ? 100.0 : 0.0);
  out.claims = {
      Section("6.3").number(predicted, "The joints do not come to their limits", "",
                            "least distance of an angle to a limit of table 6-1", to_a_limit(run),
                            "deg", analysis::at_least(0)),
      Section("6.3").number(
          code_against_code, "The knee is asked for more than it can do in a small part of swing",
          "", "share of swing with a desired knee below 289 deg",
          analysis::mean(beyond, run.record().swing()), "%", analysis::small(100), "",
          "so do [65], [66] and table 6-1: nothing simulated is in this number"),
      Section("6.3").number(predicted, "The angle's error is larger in propulsion than usual", "",
                            "rms error of the hip, propulsion by swing",
                            analysis::rms(error, phase_of(run, "propulsion")) /
                                analysis::rms(error, run.record().swing()),
                            "", analysis::at_least(1))};
  return out;
}

const char* const muscles[] = {"hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor"};

Exhibit figure_6_5(const LegRun& run) {
  std::vector<Curve> curves;
  double others = 0;
  for (int i = 0; i < 4; ++i) {
    const std::string muscle = muscles[i], topic = "/muscle/" + muscle + "/tension";
    curves.push_back(run.curve(spaced_name(muscle), {topic}, run.sequence(), i));
    if (muscle != "hip_extensor")
      others = std::max(others, analysis::largest(run.rows({topic}), run.record().sequence()));
  }
  Exhibit out{{.name = "6-5",
               .title = "Actuator forces",
               .caption = run.caption("Readings of the four force sensors, each by its own scale; "
                                      "the converter has a ceiling."),
               .plots = {over_time(run, "tension", "lbf", std::move(curves))}},
              run.verdicts({"muscles.hip_extensor.own_scale_peak"})};
  out.claims.push_back(Section("6.3").number(
      predicted, "Only the hip's extensor is used to its capacity", "",
      "largest reading of the three others", others, "lbf", analysis::much_less(30)));
  for (const std::string joint : {"hip", "knee"})
    out.claims.push_back(
        report::not_applicable("6.3", "Antagonists pull quite alike in swing: the " + joint, "",
                               "judged once: the same number as 6-7's torque (arm 1 in)"));
  return out;
}

Exhibit figure_6_6(const LegRun& run) {
  report::Plot plot =
      over_time(run, "joint stiffness", "lbf in/rad", of_joints(run, "/stiffness", true));
  return {{.name = "6-6",
           .title = "Desired and actual stiffness",
           .caption = run.caption("As the controller computes it, [27] and [60]."),
           .plots = {std::move(plot)}},
          {Section("6.3").number(
              predicted, "The hip's stiffness is controlled much more tightly than the knee's", "",
              "standard deviation, hip by knee",
              run.summary("joints.hip.stiffness_std_Nm_per_rad") /
                  run.summary("joints.knee.stiffness_std_Nm_per_rad"),
              "", analysis::much_less(1))}};
}

Exhibit figure_6_7(const LegRun& run) {
  Exhibit out{
      {.name = "6-7",
       .title = "Joint torque",
       .caption = run.caption("Of the four force readings; > 0 raises the angle."),
       .plots = {over_time(run, "joint torque", "lbf in", of_joints(run, "/torque", false))}},
      {}};
  for (const std::string joint : {"hip", "knee"})
    out.claims.push_back(
        Section("6.3").number(predicted, "The torque is near zero in swing: the " + joint, "",
                              "rms torque in the air, of its range over the walk",
                              in_the_air_of_range(run, run.rows({"/joint/" + joint + "/torque"})),
                              "%", analysis::negligible(100), "", moves_against));
  return out;
}

// --- ground and trolley -------------------------------------------------------------------------

// Returns the first time in [from, to] at which the values reach a share of their maximum there
// [s].
double begins(const LegRun& run, const Column& values, const report::Span& in, double share) {
  const double start = run.record().sequence_start();
  const auto inside = [&](std::size_t i) {
    const double t = run.record().time(i) - start;
    return t >= in.from && t < in.to;
  };
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (inside(i)) largest = std::fmax(largest, values[i]);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (inside(i) && values[i] >= share * largest) return run.record().time(i) - start;
  return std::nan("");
}

Exhibit figure_6_8(const LegRun& run) {
  const Column normal = run.rows({"/foot/force", "y"}), friction = run.rows({"/foot/force", "x"});
  const report::Span step = run.stance().at(1);
  std::vector<Curve> curves;
  for (const auto& [field, label] : {std::pair("y", "normal force Fy (simulated)"),
                                     std::pair("x", "friction force Fx (simulated)")})
    curves.push_back(
        run.curve(label, {"/foot/force", field}, run.sequence(), static_cast<int>(curves.size())));
  return {
      {.name = "6-8",
       .title = "Ground reaction",
       .caption = run.caption("By [75] from measured angles and torques, on the foot; inertia and "
                              "gravity are ignored."),
       .plots = {over_time(run, "ground reaction", "lbf", std::move(curves))}},
      {Section("6.3").number(
           predicted, "False reactions in swing are minimal beside those in propulsion", "",
           "rms normal force in the air, of its range over the walk",
           in_the_air_of_range(run, normal), "%", analysis::negligible(100), "", moves_against),
       Section("6.3").number(
           predicted, "Friction does not begin as soon as the foot is on the ground", "",
           "from half of the largest normal force to half of the largest friction, "
           "second step",
           begins(run, friction, step, 0.5) - begins(run, normal, step, 0.5), "s",
           analysis::noticeable(1.5)),
       Section("6.3").number(
           predicted, "A mass of 5 lb could have been carried", "5 lb", "largest normal force",
           analysis::largest(normal, run.record().sequence()), "lbf", analysis::measured(5, 1))}};
}

Exhibit figure_6_9(const LegRun& run) {
  std::vector<report::Plot> plots;
  for (const auto& [what, unit] : {std::pair("position", "in"), std::pair("velocity", "in/s")}) {
    const std::string topic = std::string("/trolley/") + what;
    plots.push_back(
        over_time(run, std::string("trolley ") + what, unit,
                  {run.curve("from torques (simulated)", {topic}, run.sequence(), 0),
                   run.curve("of the simulated trolley", {"/true" + topic}, run.sequence(), 1)}));
  }
  return {
      {.name = "6-9",
       .title = "Trolley position and velocity",
       .caption = run.caption("The forces of 6-8 integrated twice, as 6.3 does, and the "
                              "trolley itself, which the thesis did not measure."),
       .plots = std::move(plots)},
      run.verdicts({"trolley.distance_m", "trolley.mean_speed", "trolley.distance_from_torques"})};
}

// --- valves -------------------------------------------------------------------------------------

// A row of table 6-4 [%].
struct Duty {
  const char *muscle, *valve;
  double reported;
};

Exhibit duties(const LegRun& run, const std::string& number, const std::string& joint,
               const std::vector<Duty>& table) {
  std::vector<Curve> curves;
  std::vector<Claim> claims;
  for (const Duty& d : table) {
    const std::string topic = std::string("/muscle/") + d.muscle + "/" + d.valve + "_duty";
    const bool flexor = std::string(d.muscle).ends_with("flexor");
    Curve c = run.curve(std::string(flexor ? "flexor " : "extensor ") + d.valve, {topic},
                        run.sequence(), static_cast<int>(curves.size()), flexor ? 1 : -1);
    c.style = Curve::Style::steps;
    curves.push_back(std::move(c));
    claims.push_back(
        Section("table 6-4")
            .number(fitted, "Mean duty cycle of the " + spaced_name(d.muscle) + "'s " + d.valve,
                    std::to_string(static_cast<int>(d.reported)) + " %", "mean over the phases",
                    analysis::mean(run.rows({topic}), run.record().sequence()), "%",
                    analysis::percentage(d.reported)));
  }
  for (Claim& c : run.verdicts({"joints." + joint + ".passiveness"}))
    claims.push_back(std::move(c));
  return {{.name = number,
           .title = "Commanded duty cycles of the " + joint,
           .caption = run.caption("The flexor's valves upwards, the extensor's downwards: a duty "
                                  "cycle is never negative."),
           .plots = {over_time(run, "duty cycle", "%", std::move(curves))}},
          std::move(claims)};
}

}  // namespace

Exhibits chapter_6(const Sources& from) {
  const LegRun run(from, "walk-test-1");
  Exhibits out = {figure_6_1(run),
                  figure_6_3(run),
                  figure_6_4(run),
                  figure_6_5(run),
                  figure_6_6(run),
                  figure_6_7(run),
                  figure_6_8(run),
                  figure_6_9(run),
                  duties(run, "6-10", "hip",
                         {{"hip_flexor", "inlet", 2},
                          {"hip_flexor", "exhaust", 4},
                          {"hip_extensor", "inlet", 3},
                          {"hip_extensor", "exhaust", 3}}),
                  duties(run, "6-11", "knee",
                         {{"knee_flexor", "inlet", 11},
                          {"knee_flexor", "exhaust", 23},
                          {"knee_extensor", "inlet", 2},
                          {"knee_extensor", "exhaust", 3}})};
  add_text_of_test_1(run, from, out);
  return out;
}

}  // namespace sinew::thesis
