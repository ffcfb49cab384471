// thesis/figures/chapter_2_stand.cpp - figures 2-8 to 2-13 from the test stand. The
// measurements are lost; in their place are runs of our simulated stand with its transducers,
// labelled as such. The stand uses the laws identified in 2.3, so these runs do not confirm those
// laws.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"
#include "sinew/experiment/measured.h"
#include "sinew/run/simulation/run.h"
#include "sinew/units/constants.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using report::Curve, report::Trace;
using Kind = Curve::Kind;
using Style = Curve::Style;
using units::inch, units::psi, units::pound_force;

// Readings of a stand run in the thesis's units, and the predictions of the laws for them.
struct Loop {
  int nominal = 0;                              // [psi gauge]
  std::vector<double> length, force, pressure;  // [in] [lbf] [psi gauge]
  experiment::Experiment experiment;
  std::vector<double> predicted_pressure, ideal_force, effective_force;
};

Loop measured(const Sources& from, const std::string& name) {
  Loop out{.experiment = experiment::load(from.path("experiments/rig/" + name + ".toml"))};
  const experiment::Notes notes = experiment::notes(out.experiment, run::run(out.experiment).table);
  for (std::size_t s = 0; s < notes.values.size(); ++s) {
    using Of = robot::Transducer::Of;
    const auto of = out.experiment.stand->sensors[s].of;
    const double unit = of == Of::length ? inch : of == Of::force ? pound_force : psi;
    std::vector<double>& to = of == Of::length  ? out.length
                              : of == Of::force ? out.force
                                                : out.pressure;
    for (const double value : notes.values[s]) to.push_back(value / unit);
  }
  return out;
}

// Predicts the pressure by [29]: P V is constant from the first reading on [psi gauge].
void predict_pressure(Loop& loop, double atmosphere) {
  const experiment::Stand::Element& element = loop.experiment.stand->element;
  const auto volume = [&](double length) {
    return actuator::volume(loop.experiment.actuators[0].braid, length * inch) +
           element.external_volume / element.count;
  };
  const double room = atmosphere / psi;
  const double constant = (loop.pressure[0] + room) * volume(loop.length[0]);
  for (const double length : loop.length)
    loop.predicted_pressure.push_back(constant / volume(length) - room);
}

// Predicts the force by [22] at the pressure of [29], without and with the effectiveness [30]
// [lbf].
void predict_force(Loop& loop, const actuator::Effectiveness& effectiveness, double atmosphere) {
  for (std::size_t i = 0; i < loop.length.size(); ++i) {
    const double p = loop.predicted_pressure[i] * psi;
    const double ideal =
        actuator::ideal_tension(loop.experiment.actuators[0].braid, loop.length[i] * inch, p) /
        pound_force;
    loop.ideal_force.push_back(ideal);
    loop.effective_force.push_back(ideal * actuator::effectiveness(effectiveness, p, atmosphere));
  }
}

Loop loop_at(const Sources& from, int nominal) {
  Loop out = measured(from, fmt::format("weights-{}", nominal));
  out.nominal = nominal;
  predict_pressure(out, from.air.atmosphere);
  predict_force(out, from.actuator.effectiveness, from.air.atmosphere);
  return out;
}

std::string stand_of(const Loop& loop) {
  return fmt::format(
      "experiments/rig/weights-{}.toml: our stand with dry friction that sticks, dial and "
      "potentiometer",
      loop.nominal);
}

Curve over_length(const Loop& loop, const std::vector<double>& y, const std::string& label,
                  Kind kind, const std::string& source, int color) {
  return {.label = fmt::format("{}{} psi", label, loop.nominal),
          .xs = loop.length,
          .ys = y,
          .kind = kind,
          .style = kind == Kind::synthetic ? Style::marked : Style::line,
          .color = color,
          .source = source};
}

// Returns the index of the heaviest weight, which divides the readings into loading and unloading.
std::size_t heaviest(const Loop& loop) {
  return static_cast<std::size_t>(std::ranges::max_element(loop.force) - loop.force.begin());
}
Trace way_up(const Loop& loop, const std::vector<double>& y) {
  const std::size_t n = heaviest(loop) + 1;
  return {std::span(loop.length).first(n), std::span(y).first(n)};
}

// Returns how much longer the actuator is during unloading, mean over the weights, as a share of
// the range of lengths.
double opening(const Loop& loop) {
  double sum = 0;
  const std::size_t top = heaviest(loop);
  const std::size_t weights = std::min(top, loop.length.size() - 1 - top);
  for (std::size_t i = 1; i <= weights; ++i) sum += loop.length[top + i] - loop.length[top - i];
  return sum / static_cast<double>(weights) / (loop.length[top] - loop.length.front());
}

// Returns the least squares ratio of measured to predicted force.
double effectiveness_of(const Loop& loop) {
  double both = 0, square = 0;
  for (std::size_t i = 0; i < loop.force.size(); ++i) {
    both += loop.force[i] * loop.ideal_force[i];
    square += loop.ideal_force[i] * loop.ideal_force[i];
  }
  return both / square;
}

double mean(const std::vector<double>& y) { return report::mean({y, y}); }

// Returns the pressure of such a fit: the mean of the readings' pressures, weighted by their
// influence on the fit [psi gauge].
double pressure_of_fit(const Loop& loop) {
  double sum = 0, square = 0;
  for (std::size_t i = 0; i < loop.force.size(); ++i) {
    const double weight = loop.ideal_force[i] * loop.ideal_force[i];
    sum += weight * loop.predicted_pressure[i];
    square += weight;
  }
  return sum / square;
}

template <class Of>
double least_of(const std::vector<Loop>& loops, Of of) {
  double least = 1e300;
  for (const Loop& l : loops) least = std::min(least, of(l));
  return least;
}

Exhibit figure_2_8(const std::vector<Loop>& loops) {
  std::vector<Curve> curves;
  for (const Loop& l : loops)
    curves.push_back(over_length(l, l.force, "", Kind::synthetic, stand_of(l), Curve::next));
  double fall = 0;
  for (const Loop& l : loops) fall = std::max(fall, report::largest_fall(way_up(l, l.force)));
  return {
      {.name = "2-8",
       .title = "Force over length with the air shut in",
       .caption =
           "0 to 15 lb and back in steps of 1 lb at four nominal pressures. The thesis's "
           "measurements are lost: a simulation of our stand replaces them. 45 and 75 psi are "
           "guesses, 60 and 90 psi are named in 2.3.",
       .plots = {{.x = {"length", "in"}, .y = {"force", "lbf"}, .curves = curves}}},
      {Section("2.3").number(
           put_in, "Force is no straight line over length", "",
           "least distance of a way up from a straight line, of its range",
           100 * least_of(loops, [](const Loop& l) { return report::bend(way_up(l, l.force)); }),
           "%", analysis::noticeable(100), "our stand was made with [22]",
           "over these lengths [22] bends by less; 2-8 is lost"),
       Section("2.3").number(
           put_in, "The curves close and show hysteresis, by dry friction of bladder and mesh", "",
           "least mean opening of a loop, of its range of lengths", 100 * least_of(loops, opening),
           "%", analysis::noticeable(100), "our stand was given the friction of 3.4",
           "Q of 3.4, 0.0044 in, opens it by less; what 2-8 showed is lost"),
       Section("6.3").number(put_in, "The more they contract, the less they pull", "",
                             "largest fall of force while the length grows", fall, "lbf",
                             analysis::negligible(15), "the range of the weights is 15 lb")}};
}

Exhibit figure_2_9(const std::vector<Loop>& loops) {
  std::vector<Curve> curves;
  double largest = 0;
  for (std::size_t n = 0; n < loops.size(); ++n) {
    const Loop& l = loops[n];
    const int color = static_cast<int>(n);
    curves.push_back(over_length(l, l.pressure, "", Kind::synthetic, stand_of(l), color));
    curves.back().style = Style::points;
    curves.push_back(over_length(l, l.predicted_pressure, "[29], ", Kind::computed,
                                 "[29] from the first reading on", color));
    curves.back().in_legend = false;
    for (std::size_t i = 0; i < l.pressure.size(); ++i)
      largest = std::max(largest, std::fabs(l.pressure[i] - l.predicted_pressure[i]));
  }
  return {
      {.name = "2-9",
       .title = "Internal pressure over length",
       .caption = "Points: pressure that the dial of our stand showed. Lines: [29], a shut-in "
                  "mass of air at one temperature.",
       .plots = {{.x = {"length", "in"}, .y = {"pressure", "psi gauge"}, .curves = curves}}},
      {Section("2.3").number(put_in,
                             "The predicted rise of pressure holds; what is left comes from the "
                             "coarse gauge",
                             "", "largest distance of a reading from [29]", largest, "psi",
                             analysis::another(0, 1),
                             "a division of our dial is 1 psi, in a reading and in the first; the "
                             "thesis's gauge is not described")}};
}

// Returns the curves of 2-10 and 2-12, which have the pressures of 2.3.
std::vector<Curve> curves_with_law(const std::vector<Loop>& loops, bool with_effectiveness) {
  std::vector<Curve> out;
  int color = 0;
  for (const Loop& l : loops) {
    if (l.nominal != 60 && l.nominal != 90) continue;
    out.push_back(over_length(l, l.force, "", Kind::synthetic, stand_of(l), color));
    out.back().style = Style::points;
    out.push_back(over_length(l, with_effectiveness ? l.effective_force : l.ideal_force, "model, ",
                              Kind::computed,
                              with_effectiveness ? "[22], [29], [30]" : "[22], [29]", color++));
  }
  return out;
}

// Returns the largest difference between the law's loading and unloading forces over the measured
// lengths [lbf].
double largest_branch_difference(const Loop& l) {
  const Trace up = way_up(l, l.ideal_force);
  double largest = 0;
  for (std::size_t i = heaviest(l); i < l.length.size(); ++i) {
    const double there = report::value_at(up, l.length[i]);
    if (!std::isnan(there)) largest = std::max(largest, std::fabs(there - l.ideal_force[i]));
  }
  return largest;
}

Exhibit figure_2_10(const std::vector<Loop>& loops) {
  double apart = 0;
  for (const Loop& l : loops) apart = std::max(apart, largest_branch_difference(l));
  const auto at = [&](int nominal) {
    return effectiveness_of(*std::ranges::find(loops, nominal, &Loop::nominal));
  };
  return {
      {.name = "2-10",
       .title = "Force predicted and measured",
       .caption = "Readings of our stand and [22] at the pressure of [29], without effectiveness.",
       .plots = {{.x = {"length", "in"},
                  .y = {"force", "lbf"},
                  .curves = curves_with_law(loops, false)}}},
      {Section("2.3").number(
           put_in, "The model predicts more force than was measured", "",
           "least mean of predicted less measured force",
           least_of(loops, [](const Loop& l) { return mean(l.ideal_force) - mean(l.force); }),
           "lbf", analysis::at_least(0), "our stand was made with [30]"),
       Section("2.3").number(
           by_construction, "The model has no hysteresis", "", "largest distance of its two ways",
           apart, "lbf", analysis::negligible(15),
           "one force for each length; what is left are straight lines between readings"),
       Section("2.3").number(put_in, "What is missing depends on the pressure", "",
                             "measured by predicted force, at 60 psi less at 90 psi",
                             at(60) - at(90), "", analysis::noticeable(1),
                             "[30] has 0.075 between them")}};
}

Exhibit figure_2_11(const Sources& from, const std::vector<Loop>& loops) {
  actuator::Effectiveness text = from.actuator.effectiveness, code = text;
  text.argument = actuator::Effectiveness::Argument::gauge;
  code.argument = actuator::Effectiveness::Argument::absolute;
  Curve by_text{.label = "[30], gauge pressure", .source = "[30] as the text has it"};
  Curve by_code{.label = "[30], absolute pressure", .source = "[30] as appendix A has it"};
  for (double p = 0; p <= 110; p += 5) {
    by_text.xs.push_back(p);
    by_text.ys.push_back(actuator::effectiveness(text, p * psi, from.air.atmosphere));
    by_code.ys.push_back(actuator::effectiveness(code, p * psi, from.air.atmosphere));
  }
  by_code.xs = by_text.xs;
  Curve found{.label = "found on our stand",
              .kind = Kind::synthetic,
              .style = Style::points,
              .source = "least squares of each loop of 2-8 to [22] at [29]'s pressure"};
  double farthest = 0, highest = 0;
  for (const Loop& l : loops) {
    found.xs.push_back(pressure_of_fit(l));
    found.ys.push_back(effectiveness_of(l));
    farthest = std::max(
        farthest, std::fabs(found.ys.back() - report::value_at(trace(by_text), found.xs.back())));
    highest = std::max(highest, found.ys.back());
  }
  return {
      {.name = "2-11",
       .title = "Effectiveness over pressure",
       .caption = "Share of the ideal force that was measured. The text gives [30] gauge pressure, "
                  "the code of appendix A absolute pressure; the points are what a student would "
                  "find on our stand.",
       .plots = {{.x = {"gauge pressure", "psi"},
                  .y = {"effectiveness", "-"},
                  .curves = {by_text, by_code, found}}}},
      {Section("2.3, [30]")
           .number(put_in,
                   "Found for each nominal pressure, then drawn as one function of pressure", "",
                   "largest distance of what our stand finds from [30]", farthest, "",
                   analysis::negligible(report::greatest(trace(by_text)) -
                                        report::least(trace(by_text))),
                   "of the range of [30] in the figure; our stand was made with it, and the dial "
                   "and the "
                   "hysteresis are in such a fit"),
       Section("2.3").number(put_in, "The actual force is less than the predicted one", "below 1",
                             "largest effectiveness found", highest, "", analysis::at_most(1),
                             "our stand was made with [30]"),
       report::not_applicable("[30] and appendix A", "Which pressure the function takes", "",
                              "text and code contradict each other; both are drawn "
                              "(docs/evidence/departures.md)")}};
}

Exhibit figure_2_12(const std::vector<Loop>& loops) {
  double largest = 0;
  for (const Loop& l : loops) {
    if (l.nominal != 60 && l.nominal != 90) continue;
    double sum = 0;
    for (std::size_t i = 0; i < l.force.size(); ++i)
      sum += std::fabs(l.force[i] - l.effective_force[i]);
    largest = std::max(
        largest, sum / static_cast<double>(l.force.size()) / *std::ranges::max_element(l.force));
  }
  return {{.name = "2-12",
           .title = "Force predicted with effectiveness, and measured",
           .caption = "Readings of our stand and [22] with effectiveness [30] at the pressure of "
                      "[29].",
           .plots = {{.x = {"length", "in"},
                      .y = {"force", "lbf"},
                      .curves = curves_with_law(loops, true)}}},
          {Section("2.3").number(
              put_in, "With effectiveness the static model describes the force adequately", "",
              "largest mean distance of a loop from the model, of its largest force", 100 * largest,
              "%", analysis::negligible(100),
              "\"adequate\" is taken as a difference that is negligible; the loop's own "
              "opening is in it")}};
}

}  // namespace

Exhibits weights(const Sources& from) {
  std::vector<Loop> loops;
  for (const int nominal : {45, 60, 75, 90}) loops.push_back(loop_at(from, nominal));
  return {figure_2_8(loops), figure_2_9(loops), figure_2_10(loops), figure_2_11(from, loops),
          figure_2_12(loops)};
}

namespace {

std::vector<double> every(const std::vector<double>& values, std::size_t n) {
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); i += n) out.push_back(values[i]);
  return out;
}

}  // namespace

void add_length_sweep(const Sources& from, Exhibit& figure_2_13) {
  const Loop sweep = measured(from, "length-sweep");
  figure_2_13.figure.plots.at(0).curves.push_back(
      {.label = "our stand, 60 psi",
       .xs = every(sweep.length, 20),
       .ys = every(sweep.force, 20),
       .kind = Kind::synthetic,
       .style = Style::points,
       .color = 1,
       .source = "experiments/rig/length-sweep.toml: our stand, the thesis's own actuator"});
}

}  // namespace sinew::thesis
