// cli/thesis/chapter_7.cpp - what limits the leg, 6-12 to 6-16, and walking without stiffness
// control, 7-1.
#include <algorithm>
#include <cmath>

#include "cli/thesis/chapter_6.h"
#include "sinew/analysis/statistics.h"

namespace sinew::cli::thesis {
namespace {

using enum config::StatementClass;

using report::Curve, report::judge;

Exhibit figure_6_12(const Sources& from) {
  const LegRun slow(from, "walk-test-1"), fast(from, "walk-test-2");
  const char* key = "joints.hip.swing_oscillation_rms_rad";
  Exhibit out{
      joint_angles(fast, "6-12", "Joint angles of test 2"),
      fast.verdicts({"trolley.distance_m", "trolley.mean_speed", "joints.hip.passiveness"})};
  out.claims.push_back(
      judge(predicted, {.where = "6.4",
                        .says = "Less stable than test 1: substantial oscillations at the hip",
                        .quantity = "rms oscillation of the hip in swing, test 2 by test 1",
                        .ours = fast.summary(key) / slow.summary(key),
                        .accept = analysis::at_least(1.5),
                        .why = "\"substantial\": half as much again"}));
  out.claims.push_back(
      Section("6.4").number(predicted, "The trolley goes less than half as far as in test 1",
                            "below 0.5", "distance, test 2 by test 1",
                            fast.summary("trolley.distance_m") / slow.summary("trolley.distance_m"),
                            "", analysis::another(0, 0.5), "half"));
  return out;
}

Exhibits kick(const Sources& from) {
  const LegRun run(from, "kick");
  // From the kick's begin until it has calmed down.
  const double begin = run.phase("kick").from;
  report::Figure path =
      foot_path(run, "6-13", "Desired and actual foot path of a kick",
                "From the begin of the kick on for half a second; a mark for each 10 ms.",
                {begin, begin + 0.5});
  path.plots[0].curves[0].style = Curve::Style::marked;
  const Curve hip = run.curve("", {"/joint/hip/oscillation"}, run.phase("extended"), 0);
  const std::vector<double> seconds(hip.ys.size(), 1.0);
  return {
      {std::move(path), run.verdicts({"foot.extension_time"})},
      {joint_angles(run, "6-14", "Joint angles of the kick"),
       {judge(predicted, {.where = "6.4",
                          .says = "The leg oscillates after the kick: there is not enough damping",
                          .quantity = "rms oscillation of the hip in the extended position",
                          .ours = analysis::rms(hip.ys, seconds),
                          .unit = "deg",
                          .accept = analysis::at_least(0.5),
                          .why = "to be seen in the plot"})}}};
}

// Counts for which the controller takes a radian of the hip.
double hip_scale(const LegRun& run) {
  for (const robot::Sensor& s : run.machine().robot.sensors)
    if (s.name == "hip_angle") return s.assumed_scale;
  return std::nan("");
}

Exhibits derivative_control(const Sources& from) {
  const LegRun run(from, "derivative-control");
  // One step's swing and propulsion: the second one, which starts from walking.
  const std::vector<report::Span> stance = run.stance();
  const Window step{stance.at(0).to, stance.at(1).to};
  Curve speed = run.curve("", {"/joint/hip/velocity_estimate"}, step, 0);
  const double scale = hip_scale(run) * M_PI / 180;
  for (double& y : speed.ys) y *= scale;
  report::Figure velocity{
      .name = "6-15",
      .title = "Calculated velocity of the hip",
      .caption = run.caption("One step's swing and propulsion: the difference of two readings of "
                             "the angle, 10 ms apart."),
      .plots = {{.x = {"time", "s"},
                 .y = {"hip velocity", "count/s"},
                 .curves = {std::move(speed)},
                 .spans = {stance.at(1)}}}};
  Exhibit angles{joint_angles(run, "6-16", "Joint angles with derivative control"),
                 run.verdicts({"joints.hip.excursion", "joints.knee.excursion",
                               "joints.hip.swing_oscillation", "joints.knee.swing_oscillation"})};
  angles.claims.push_back(Section("6.5").number(
      predicted, "The fourth swing seems to head for instability", "",
      "rms oscillation of the hip, fourth swing by the mean of the second and third",
      2 * swing_oscillation(run, 3) / (swing_oscillation(run, 1) + swing_oscillation(run, 2)), "",
      analysis::at_least(1.5), "half as much again", "as above: the fitted joints damp too much"));
  return {{std::move(velocity), run.verdicts({"joints.hip.velocity_jump"})}, std::move(angles)};
}

Exhibit figure_7_1(const Sources& from) {
  const LegRun run(from, "no-stiffness-control");
  Exhibit out{
      foot_path(run, "7-1", "Foot path without stiffness control",
                "Four steps over each other with both stiffness gains at zero, on the lightly "
                "damped leg of robots/leg-lightly-damped.",
                run.sequence()),
      run.verdicts({"foot.", "ground_reaction.", "rollers."})};
  out.claims.push_back(Section("7.2").number(
      predicted, "It is stable all the same", "",
      "rms oscillation of the hip, second half of propulsion",
      analysis::rms(run.rows({"/joint/hip/oscillation"}),
                    run.record().part(analysis::find_phase(run.machine(), "propulsion"), 0.5, 1)),
      "deg", analysis::at_most(1),
      "an unstable leg would not calm down on the ground; its swings are wild, and each another"));
  return out;
}

}  // namespace

Exhibits chapter_6_limits(const Sources& from) {
  Exhibits out{figure_6_12(from)};
  for (Exhibit& e : kick(from)) out.push_back(std::move(e));
  for (Exhibit& e : derivative_control(from)) out.push_back(std::move(e));
  return out;
}

Exhibits chapter_7(const Sources& from) { return {figure_7_1(from)}; }

}  // namespace sinew::cli::thesis
