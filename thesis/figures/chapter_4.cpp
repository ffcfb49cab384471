// thesis/figures/chapter_4.cpp - figures of the leg's valves and force sensors: 4-8, 4-9, 4-14; and
// the choice of its cams and free lengths, 4.2.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/actuator/tension.h"
#include "sinew/config/diagnostics.h"
#include "sinew/design/joint.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/coil_current.h"
#include "sinew/identify/sensor/sensor.h"
#include "sinew/robot/sensing.h"
#include "sinew/units/constants.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using report::Curve;
using Kind = Curve::Kind;
using units::psi, units::pound_force;

constexpr double millisecond = 1e-3;
constexpr const char* bench =
    "an R-L circuit with speed-up drive and back-EMF (gas/coil_current.h); its values are guesses "
    "in robots/leg/valves-at-the-bench.toml";
constexpr const char* as_chosen =
    "the circuit's values were chosen to show this: the claim is met, not found";

// --- 4.2: the choice of the cam and the free length ---------------------------------------------

constexpr double cam = 1 * units::inch, supply = 100 * psi;

design::JointDesign joint(const Sources& from, int count, double free_length) {
  return {from.actuator, count, cam, free_length * units::inch};
}

// Returns the range of motion over the free length, for a cam [in].
Curve motion_over_length(const Sources& from, double radius, const design::Stroke& stroke) {
  Curve c{.label = fmt::format("cam of {:g} in", radius),
          .source = "free length and stroke, design/joint.h"};
  constexpr int steps = 60;
  for (int i = 0; i <= steps; ++i) {
    const double length =
        stroke.shortest + (stroke.longest - stroke.shortest) * static_cast<double>(i) / steps;
    design::JointDesign one{from.actuator, 1, radius * units::inch, length};
    c.xs.push_back(length / units::inch);
    c.ys.push_back(design::motion_of(one, design::Arm::cam, stroke) / units::degree);
  }
  return c;
}

// Returns the torque at the middle over the pressure [lbf in over psi].
Curve torque_over_pressure(const Sources& from, int count) {
  Curve c{.label = fmt::format("{} on each side", count), .source = "[31] and [33]"};
  for (int p = 0; p <= 100; p += 5) {
    const design::JointTask task{.pressure = p * psi};
    c.xs.push_back(p);
    c.ys.push_back(
        design::torque_at(joint(from, count, 3.15), task, 0, p * psi, 0, from.air.atmosphere)
            .value /
        (pound_force * units::inch));
  }
  return c;
}

Exhibit section_4_2(const Sources& from) {
  const design::Stroke stroke = design::stroke_of(from.actuator, supply, from.air.atmosphere);
  const double way = (stroke.longest - stroke.shortest) / units::inch;
  const double middle = 0.5 * (stroke.longest + stroke.shortest) / units::inch;
  const double force =
      actuator::tension(from.actuator, 3.15 * units::inch, 0, supply, from.air.atmosphere) /
      pound_force;
  const double motion =
      design::motion_of(joint(from, 2, middle), design::Arm::cam, stroke) / units::degree;
  const double off = design::motion_of(joint(from, 2, middle - 0.1), design::Arm::cam, stroke) +
                     design::motion_of(joint(from, 2, middle + 0.1), design::Arm::cam, stroke);
  const Section text("4.2");
  const std::string at =
      "at the free length of 3.15 in and at 100 psi, which the text does not state and we chose; "
      "it is "
      "36 lbf with stretched threads";
  return {{.name = "4-2-choice",
           .title = "Choice of the cam and of the free length",
           .caption =
               "Above: the range of motion ends where one actuator is fully contracted, b/sqrt 3, "
               "or where the other one's threads are stretched. Below: torque at the middle with "
               "one actuator at the pressure, by [31] as printed.",
           .plots = {{.name = "motion",
                      .x = {"free length", "in"},
                      .y = {"range of motion", "deg", 0},
                      .curves = {motion_over_length(from, 0.75, stroke),
                                 motion_over_length(from, 1, stroke),
                                 motion_over_length(from, 1.25, stroke)}},
                     {.name = "torque",
                      .x = {"gauge pressure", "psi"},
                      .y = {"torque", "lbf in", 0},
                      .curves = {torque_over_pressure(from, 1), torque_over_pressure(from, 2)}}}},
          {text.number(put_in, "The largest force of an actuator", "15 lb", "force", force, "lbf",
                       analysis::about(15), at),
           text.number(by_construction, "Two side by side pull with", "30 lb", "force", 2 * force,
                       "lbf", analysis::about(30), at),
           text.number(predicted, "The range of motion of an actuator", "1.4 in",
                       "L_max - b/sqrt 3", way, "in", analysis::about(1.4)),
           text.number(by_construction, "With a moment arm of 1 in this is", "1.4 rad, 80 deg",
                       "1.4 in/1 in", 1.4 / 1 / units::degree, "deg", analysis::about(80)),
           text.number(by_construction, "The joint's range of motion", "80 deg", "range of motion",
                       motion, "deg", analysis::about(80)),
           text.number(predicted, "The optimum free length, half the range", "3.15 in",
                       "(L_max + b/sqrt 3)/2", middle, "in", analysis::measured(3.15, 0.01)),
           text.number(by_construction, "Another free length decreases the range of motion", "",
                       "both at 0.1 in less and more, less the range at the optimum",
                       off / units::degree - 2 * motion, "deg", analysis::at_most(0)),
           report::not_applicable("4.2", "One actuator on each side has too little force", "",
                                  "the torque that was needed is not given")}};
}

// --- 4-8, 4-9: current through a coil -----------------------------------------------------------

Curve current(const gas::Valve& valve, double pressure, double frequency) {
  const double period = 1 / frequency, step = 0.02 * millisecond;
  const auto pieces = gas::coil_current(valve, pressure * psi, period, 0.5, 2);
  Curve c{.label = fmt::format("{:.0f} psi", pressure), .kind = Kind::synthetic, .source = bench};
  for (int k = 0; k * step <= 2 * period + 1e-9; ++k) {
    c.xs.push_back(k * step / millisecond);
    c.ys.push_back(gas::current(pieces, k * step));
  }
  return c;
}

Curve command(const std::vector<double>& time, double frequency) {
  Curve c{.xs = time, .kind = Kind::desired, .style = Curve::Style::steps, .source = "50 %"};
  for (const double t : time) {
    const double phase = t * millisecond * frequency;
    c.ys.push_back(phase - std::floor(phase + 1e-9) < 0.5 - 1e-9 ? 1.0 : 0.0);
  }
  return c;
}

report::Figure coil(const std::string& name, const std::string& title, double frequency,
                    std::vector<Curve> currents) {
  const Curve wave = command(currents.front().xs, frequency);
  return {.name = name,
          .title = title,
          .caption = fmt::format(
              "{:.0f} Hz square wave at 50 % duty cycle. The dip on the way up is the shutter that "
              "moves. The thesis's oscillograms are lost.",
              frequency),
          .plots = {{.name = "current",
                     .x = {"time", "ms", 0, 1e3 / frequency},
                     .y = {"current", "A"},
                     .curves = std::move(currents)},
                    {.name = "command",
                     .x = {"time", "ms", 0, 1e3 / frequency},
                     .y = {.name = "command",
                           .unit = "-",
                           .from = -0.15,
                           .to = 1.15,
                           .ticks = {{0, "off"}, {1, "on"}}},
                     .curves = {wave}}}};
}

// Returns the time of the dip after the edge [ms].
double dip(const Curve& c) { return report::first_dip(trace(c)); }

// Returns the largest frequency of a square wave that the shutter still follows: half a period is
// longer than either delay [Hz].
double largest_frequency(const gas::Valve& valve, double pressure) {
  return 0.5 / std::max(gas::delay_at(valve, true, pressure * psi),
                        gas::delay_at(valve, false, pressure * psi));
}

Exhibit figure_4_8(const Sources& from) {
  const Curve at_supply = current(from.inlet, 100, 125);
  const double off = 500.0 / 125;  // [ms]
  const double gone = report::first_at_most(trace(at_supply), 0, off) - off;
  const double later = dip(at_supply) - dip(current(from.inlet, 0, 125));
  const auto after_off = report::part(trace(at_supply), off + 0.01, 2 * off);
  double rise = 0;
  for (std::size_t i = 1; i < after_off.y.size() && after_off.x[i] < 2 * off - 0.01; ++i)
    rise = std::max(rise, after_off.y[i] - after_off.y[i - 1]);
  const Section text("4.3");
  return {
      coil("4-8", "Coil current of the inlet valve", 125, {at_supply}),
      {text.number(put_in, "The shutter opens after about", "0.5 ms", "dip of the current",
                   dip(at_supply), "ms", analysis::about(0.5), as_chosen),
       text.number(put_in, "When it opens does not depend on the pressure", "",
                   "dip at 100 psi less at 0", later, "ms", analysis::negligible(dip(at_supply)),
                   as_chosen),
       text.number(put_in, "The current has gone after the edge by about", "0.5 ms", "first zero",
                   gone, "ms", analysis::about(0.5), as_chosen),
       text.number(by_construction, "Nothing in the current tells when it shuts", "no kick",
                   "largest rise after the edge", rise, "A",
                   analysis::negligible(report::greatest(trace(at_supply))), "our coil has none"),
       text.number(put_in, "Its largest audible frequency exceeds", "400 Hz",
                   "half a period lasts as long as the slower delay",
                   largest_frequency(from.inlet, 100), "Hz", analysis::at_least(400),
                   "heard in the thesis, computed here from both delays, which were put in: 0.5 ms "
                   "each, as 4.3 has them")}};
}

Exhibit figure_4_9(const Sources& from) {
  std::vector<Curve> currents;
  for (const double p : {0.0, 30.0, 60.0, 90.0}) currents.push_back(current(from.exhaust, p, 100));
  double least_step = 1e300;
  for (std::size_t i = 1; i < currents.size(); ++i)
    least_step = std::min(least_step, dip(currents[i]) - dip(currents[i - 1]));
  const double slower = dip(currents[0]) - dip(current(from.inlet, 100, 125));
  const double at_90 = largest_frequency(from.exhaust, 90);
  const Section text("4.3");
  return {
      coil("4-9", "Coil current of the exhaust valve", 100, currents),
      {text.number(put_in, "It answers more slowly than the inlet", "",
                   "dip at 0 psi less the inlet's", slower, "ms", analysis::at_least(0), as_chosen),
       text.number(put_in, "It opens later the more pressure there is", "",
                   "least shift of the dip from curve to curve", least_step, "ms",
                   analysis::at_least(0), as_chosen),
       text.number(put_in, "Its largest audible frequency rises with pressure", "",
                   "at 90 psi less at 0 psi", at_90 - largest_frequency(from.exhaust, 0), "Hz",
                   analysis::at_least(0),
                   "computed from both delays, whose slopes were chosen to show this"),
       text.number(
           put_in, "The exhaust's largest audible frequency at 90 psi", "350 Hz",
           "half a period lasts as long as the slower delay", at_90, "Hz", analysis::about(350),
           "computed from both delays, which are guesses",
           "the bench's delays are guesses, the numbers of 4-9 being lost; and a valve may be "
           "heard to fail before it stays shut")}};
}

// --- 4-14: calibration of the force sensors -----------------------------------------------------

// In the order of table 4-1, which the leg's file assumes.
constexpr std::array<const char*, 4> transducers = {"hip_flexor_tension", "hip_extensor_tension",
                                                    "knee_flexor_tension", "knee_extensor_tension"};
constexpr std::array<double, 4> printed_scale = {0.1689, 0.1610, 0.1694, 0.1809};  // [V/lb]
constexpr std::array<double, 4> printed_error = {0.7, 5.6, 0.4, -6.0};             // [%]

// Returns the converter's readings for a series of weights.
identify::SensorData hung(const robot::Robot& robot) {
  identify::SensorData out{.file = "figure 4-14", .kind = identify::SensorKind::tension};
  for (double load = 0; load <= 16; load += 2) out.known.push_back(load * pound_force);
  for (std::size_t t = 0; t < transducers.size(); ++t) {
    const robot::Sensor& sensor = config::named(robot.sensors, transducers[t], "4-14", "sensor");
    identify::SensorReadings readings{.name = transducers[t]};
    for (std::size_t i = 0; i < out.known.size(); ++i) {
      const double added_noise =
          robot::noise(1, static_cast<int>(t), static_cast<signals::Tick>(i));
      readings.volts.push_back(robot::counts(sensor, robot.converter, out.known[i], added_noise) /
                               robot.converter.counts_per_volt());
    }
    out.sensors.push_back(std::move(readings));
  }
  return out;
}

std::vector<report::Claim> claims_of(const identify::Calibration& found) {
  std::vector<report::Claim> out;
  std::array<double, 4> scale{};
  for (std::size_t t = 0; t < transducers.size(); ++t) {
    scale[t] = found.sensors[t].sensitivity * pound_force;
    const std::string of = fmt::format(" of transducer {}", t + 1);
    out.push_back(Section("table 4-1")
                      .number(put_in, "Scale factor" + of,
                              fmt::format("{:.4f} V/lb", printed_scale[t]),
                              "slope through our readings", scale[t], "V/lb",
                              analysis::measured(printed_scale[t], 1e-4),
                              "counts of 1.2 mV and one count of noise; the scale was "
                              "put in, so the way back is what is "
                              "tested"));
    out.push_back(Section("table 4-1")
                      .number(put_in, "Error from the average" + of,
                              fmt::format("{:.1f} %", printed_error[t]), "(average - s)/s",
                              100 * found.sensors[t].deviation, "%",
                              analysis::percentage(printed_error[t]), "of two such slopes"));
  }
  out.push_back(
      Section("4.4").number(put_in, "Transducers 1 and 3 are alike, 2 and 4 less so", "",
                            "difference of 2 and 4 by that of 1 and 3",
                            std::fabs(scale[1] - scale[3]) / std::fabs(scale[0] - scale[2]), "",
                            analysis::much_more(1), "table 4-1 has 40"));
  out.push_back(report::not_applicable("4.4", "The calibration's own points", "",
                                       "lost with the figure; the weights between 0 and 16 lb are "
                                       "not given"));
  return out;
}

Exhibit figure_4_14(const Sources& from) {
  const robot::Robot robot =
      experiment::load_machine_file(from.path("robots/leg/robot.toml")).experiment.robot;
  const identify::SensorData data = hung(robot);
  const identify::CountScale converter{robot.converter.bits, robot.converter.full_scale};
  std::vector<Curve> curves;
  for (std::size_t t = 0; t < transducers.size(); ++t) {
    Curve points{
        .label = fmt::format("{}", t + 1),
        .ys = data.sensors[t].volts,
        .kind = Kind::synthetic,
        .style = Curve::Style::points,
        .color = static_cast<int>(t),
        .source = "robots/leg/robot.toml through its converter, 0 to 16 lb in steps of 2 lb"};
    for (const double known : data.known) points.xs.push_back(known / pound_force);
    Curve line{.label = fmt::format("{}, {:.4f} V/lb", t + 1, printed_scale[t]),
               .xs = points.xs,
               .color = static_cast<int>(t),
               .source = "table 4-1"};
    for (const double load : line.xs) line.ys.push_back(load * printed_scale[t]);
    curves.push_back(std::move(points));
    curves.push_back(std::move(line));
  }
  return {{.name = "4-14",
           .title = "Calibration of the force transducers",
           .caption = "Dead weights up to 16 lb. Lines have the scale factors of table 4-1; the "
                      "points, which are lost, are the leg's sensors as its file describes them.",
           .plots = {{.x = {"load", "lb"}, .y = {"output", "V"}, .curves = curves}}},
          claims_of(identify::identify_sensors(data, converter))};
}

}  // namespace

Exhibits chapter_4(const Sources& from) {
  return {section_4_2(from), figure_4_8(from), figure_4_9(from), figure_4_14(from)};
}

}  // namespace sinew::thesis
