// thesis/figures/chapter_7.cpp - limits of the leg, 6-12 to 6-16, and walking without stiffness
// control, 7-1.
#include <algorithm>
#include <cmath>

#include "sinew/analysis/measures/statistics.h"
#include "thesis/figures/leg_run.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using report::Curve;

// Returns the largest half swing of a joint's error in a swing, mean over the steps, as a share of
// its excursion [%]; a swing without any counts as 0.
double oscillates(const LegRun& run, const std::string& joint) {
  const int steps = static_cast<int>(run.summary("steps"));
  double sum = 0;
  for (int step = 0; step < steps; ++step) sum += swing_amplitude(run, joint, step);
  const double excursion = run.summary("joints." + joint + ".excursion_rad") * 180 / M_PI;
  return 100 * sum / steps / excursion;
}

Exhibit figure_6_12(const Sources& from) {
  const LegRun slow(from, "walk-test-1"), fast(from, "walk-test-2");
  Exhibit out{
      joint_angles(fast, "6-12", "Joint angles of test 2"),
      fast.verdicts({"trolley.distance_m", "trolley.mean_speed", "joints.hip.passiveness"})};
  const Section text("6.4");
  const char* amplitude =
      "largest amplitude of its error in a swing, mean of the steps, of its excursion";
  out.claims.push_back(text.number(predicted, "There are substantial oscillations at the hip", "",
                                   amplitude, oscillates(fast, "hip"), "%",
                                   analysis::substantial(100)));
  out.claims.push_back(text.number(predicted, "There are oscillations at the knee, too", "",
                                   amplitude, oscillates(fast, "knee"), "%",
                                   analysis::noticeable(100)));
  out.claims.push_back(
      text.number(fitted, "The trolley goes less than half as far as in test 1", "below 0.5",
                  "distance, test 2 by test 1",
                  fast.summary("trolley.distance_m") / slow.summary("trolley.distance_m"), "",
                  analysis::at_most(0.5)));
  return out;
}

Exhibits kick(const Sources& from) {
  const LegRun run(from, "kick");
  // Window from the start of the kick until the leg is at rest.
  const double begin = run.phase("kick").from;
  report::Figure path =
      foot_path(run, "6-13", "Desired and actual foot path of a kick",
                "From the begin of the kick on for half a second; a mark for each 10 ms.",
                {begin, begin + 0.5});
  path.plots[0].curves[0].style = Curve::Style::marked;
  return {{std::move(path), run.verdicts({"foot.extension_time_s"})},
          {joint_angles(run, "6-14", "Joint angles of the kick"),
           {Section("6.4").number(
               predicted, "The leg oscillates after the kick: there is not enough damping", "",
               "turning points of the hip's error in the extended position",
               run.summary("phases.extended.joints.hip.turning_points"), "",
               analysis::another(2, 1000), "an oscillation has two turning points at least")}}};
}

// Returns the counts per radian that the controller assumes for the hip.
double hip_scale(const LegRun& run) {
  for (const robot::Sensor& s : run.machine().robot.sensors)
    if (s.name == "hip_angle") return s.assumed_scale;
  return std::nan("");
}

Exhibits derivative_control(const Sources& from) {
  const LegRun run(from, "derivative-control");
  // Swing and propulsion of the second step, which starts from walking.
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
  Exhibit angles{
      joint_angles(run, "6-16", "Joint angles with derivative control"),
      run.verdicts({"joints.hip.excursion", "joints.knee.excursion", "phases.swing.joints."})};
  const double before = swing_amplitude(run, "hip", 1) + swing_amplitude(run, "hip", 2);
  angles.claims.push_back(Section("6.5").number(
      predicted, "The fourth swing seems to head for instability", "",
      "largest amplitude of the hip in it, by the mean of the second and third",
      2 * swing_amplitude(run, "hip", 3) / before, "", analysis::much_more(1)));
  return {{std::move(velocity), run.verdicts({"joints.hip.velocity_jump"})}, std::move(angles)};
}

Exhibit figure_7_1(const Sources& from) {
  const LegRun run(from, "no-stiffness-control");
  Exhibit out{
      foot_path(run, "7-1", "Foot path without stiffness control",
                "Four steps over each other with both stiffness gains at zero.", run.sequence()),
      run.verdicts({"foot.", "ground_reaction.", "rollers."})};
  out.claims.push_back(Section("7.2").number(
      predicted, "It is stable all the same", "",
      "turning points of the hip's error in propulsion, the most in one",
      run.summary("phases.propulsion.joints.hip.most_turning_points"), "", analysis::another(0, 1),
      "\"stable\" is taken to be: no oscillation in propulsion, as one has two turning points"));
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

}  // namespace sinew::thesis
