// cli/figures_stand.cpp - figures of the thesis that a test stand gives: 2-8 to 2-13, and lengths
// over time, 3-6 to 3-11 and 3-14 to 3-23. Measured halves are lost; what stands here in their
// place is our stand's, with its transducers, and says so.
#include <fmt/format.h>

#include <filesystem>

#include "cli/thesis_figures.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"
#include "sinew/experiment/rig/measured.h"
#include "sinew/experiment/rig/run.h"
#include "sinew/robot/sensing.h"
#include "sinew/units/constants.h"

namespace sinew::cli {
namespace {

using Kind = Curve::Kind;
using units::inch, units::psi, units::pound_force;

std::string path_of(const FigureSources& from, const std::string& name) {
  return (std::filesystem::path(from.root) / "experiments/rig" / (name + ".toml")).string();
}

// What was written down at a stand, in the thesis's units: lbf, in, psi gauge.
struct Loop {
  std::vector<double> time, length, force, pressure;  // [s] [in] [lbf] [psi gauge]
  rig::Experiment experiment;
};

Loop measured_loop(const FigureSources& from, const std::string& name) {
  Loop out{.experiment = rig::load(path_of(from, name))};
  const rig::Notes notes = rig::notes(out.experiment, rig::run(out.experiment).table);
  out.time = notes.time;
  for (std::size_t s = 0; s < notes.values.size(); ++s) {
    const auto of = out.experiment.sensors[s].of;
    using Of = plant::Transducer::Of;
    const double unit = of == Of::length ? inch : of == Of::force ? pound_force : psi;
    std::vector<double>& to = of == Of::length  ? out.length
                              : of == Of::force ? out.force
                                                : out.pressure;
    for (const double value : notes.values[s]) to.push_back(value / unit);
  }
  return out;
}

// [29]: P V is what it was at the first reading  [psi gauge].
std::vector<double> predicted_pressure(const Loop& loop, double atmosphere) {
  const rig::Element& element = loop.experiment.element;
  const auto volume = [&](double length) {
    return actuator::volume(loop.experiment.actuators[0].braid, length * inch) +
           element.external_volume / element.count;
  };
  const double room = atmosphere / psi;
  const double constant = (loop.pressure[0] + room) * volume(loop.length[0]);
  std::vector<double> out;
  for (const double length : loop.length) out.push_back(constant / volume(length) - room);
  return out;
}

// [22] at [29]'s pressure  [lbf].
std::vector<double> predicted_force(const Loop& loop, const std::vector<double>& pressure,
                                    const actuator::Effectiveness* effectiveness,
                                    double atmosphere) {
  std::vector<double> out;
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    const double p = pressure[i] * psi;
    const double ideal =
        actuator::ideal_tension(loop.experiment.actuators[0].braid, loop.length[i] * inch, p);
    const double share =
        effectiveness ? actuator::effectiveness(*effectiveness, p, atmosphere) : 1.0;
    out.push_back(ideal * share / pound_force);
  }
  return out;
}

void add_pair(FigureSet& set, const Figure& figure, Kind kind, const std::string& source,
              const std::string& sheet, const std::vector<double>& length, const std::string& y,
              const std::vector<double>& values) {
  Sheet out{sheet, {"length [in]", y}, {}};
  for (std::size_t i = 0; i < length.size(); ++i) out.rows.push_back({length[i], values[i]});
  set.add(figure, kind, source, out);
}

// Ratio of measured to ideal force, and the mean pressure that it belongs to: least squares.
std::vector<double> effectiveness_of(const Loop& loop, const std::vector<double>& pressure,
                                     const std::vector<double>& ideal) {
  double both = 0, square = 0, mean = 0;
  for (std::size_t i = 0; i < ideal.size(); ++i) {
    both += loop.force[i] * ideal[i];
    square += ideal[i] * ideal[i];
    mean += pressure[i] / static_cast<double>(pressure.size());
  }
  return {mean, both / square};
}

const std::string weights_say =
    ": our stand with dry friction that sticks, dial and potentiometer; not the thesis's "
    "measurement, which is lost";

void add_loop(FigureSet& set, const FigureSources& from, int nominal, Sheet& effectiveness) {
  const std::string file = fmt::format("weights-{}", nominal);
  const Loop loop = measured_loop(from, file);
  const double room = from.air.atmosphere;
  const std::string source = "experiments/rig/" + file + ".toml" + weights_say;
  const std::string at = fmt::format("at {} psi", nominal), tail = fmt::format("-{}-psi", nominal);
  const std::vector<double> pressure = predicted_pressure(loop, room);
  const std::vector<double> ideal = predicted_force(loop, pressure, nullptr, room);
  const std::vector<double> effective =
      predicted_force(loop, pressure, &from.actuator.effectiveness, room);
  effectiveness.rows.push_back(effectiveness_of(loop, pressure, ideal));

  add_pair(set, {"2-8", "Force over length, constant air mass"}, Kind::synthetic, source,
           "2-8" + tail, loop.length, "force " + at + " [lbf]", loop.force);
  const Figure second{"2-9", "Internal pressure over length, measured and by [29]"};
  add_pair(set, second, Kind::synthetic, source, "2-9" + tail, loop.length,
           "pressure " + at + " [psi gauge]", loop.pressure);
  add_pair(set, second, Kind::computed, "[29] from the first reading on", "2-9-predicted" + tail,
           loop.length, "predicted pressure " + at + " [psi gauge]", pressure);
  if (nominal != 60 && nominal != 90) return;
  for (const bool with : {false, true}) {
    const std::string number = with ? "2-12" : "2-10";
    const Figure figure{number, with ? "Force over length beside [22] with effectiveness [30]"
                                     : "Force over length beside [22]"};
    add_pair(set, figure, Kind::synthetic, source, number + tail, loop.length,
             "force " + at + " [lbf]", loop.force);
    add_pair(set, figure, Kind::computed, with ? "[22], [29], [30]" : "[22], [29]",
             number + "-predicted" + tail, loop.length, "predicted force " + at + " [lbf]",
             with ? effective : ideal);
  }
}

}  // namespace

void add_static_figures(FigureSet& set, const FigureSources& from) {
  Sheet effectiveness{"2-11-stand", {"mean pressure [psi gauge]", "effectiveness found [-]"}, {}};
  for (const int nominal : {45, 60, 75, 90}) add_loop(set, from, nominal, effectiveness);
  set.add({"2-11", "Effectiveness over pressure"}, Kind::synthetic,
          "least squares of each loop of 2-8 to [22] at [29]'s pressure" + weights_say,
          effectiveness);

  const Loop sweep = measured_loop(from, "length-sweep");
  add_pair(set, {"2-13", "Force over length at constant pressure: the long end effect"},
           Kind::synthetic,
           "experiments/rig/length-sweep.toml: our stand, the thesis's own actuator at 60 psi",
           "2-13-stand", sweep.length, "force measured at 60 psi gauge [lbf]", sweep.force);
}

namespace {

// One pair of figures of chapter 3: a measured one and its simulation.
struct Record {
  std::string measured, simulated, file, what;
  int trial = 1;
};

// Length over time as the stand records it; through the potentiometer where there is one.
Sheet recorded(const rig::Experiment& e, const std::string& name,
               const plant::Transducer* potentiometer) {
  const signals::Table table = rig::run(e).table;
  const signals::Series& length = *table.find("/true/stand/length");
  constexpr std::size_t every = 5;  // rows of the log
  Sheet out{name, {"time [s]", "length [in]"}, {}};
  for (std::size_t row = 0; row < length.time_ns.size(); row += every) {
    double l = length.columns[0][row];
    if (potentiometer) {
      const signals::Tick tick = length.time_ns[row] / signals::tick_nanoseconds;
      const double hiss = robot::noise(static_cast<std::uint64_t>(e.seed), 0, tick);
      l = plant::shown(*potentiometer, plant::counts(*potentiometer, l, hiss));
    }
    out.rows.push_back({static_cast<double>(length.time_ns[row]) * 1e-9, l / inch});
  }
  return out;
}

// Where our stand departs from the simulation, for want of the measurement: the equations, with
// what section 3.4 and our reading of it name as missing from its model.
std::vector<std::string> departures(const Record& record, bool pulsed) {
  std::vector<std::string> sets{"element.actuator=equations",
                                "actuator.equations.loss.coulomb_scale=sealed",
                                fmt::format("seed={}", record.trial)};
  if (!pulsed) return sets;
  for (const char* set : {"air.supply.pressure=100 psi gauge", R"(element.inlet="758")",
                          "drive.duty=50 %", "valve.758.flow.efficiency=1", "element.hose.law=pipe",
                          "element.hose.length=0.5 m", "element.hose.inner_diameter=2.5 mm"})
    sets.emplace_back(set);
  return sets;
}

void add_record(FigureSet& set, const FigureSources& from, const Record& record, bool pulsed) {
  const plant::Transducer potentiometer{.name = "length",
                                        .of = plant::Transducer::Of::length,
                                        .low = 2.2 * inch,
                                        .high = 4.2 * inch,
                                        .noise = 0.002 * inch};
  const std::vector<std::string> sets = departures(record, pulsed);
  const std::string file = "experiments/rig/" + record.file + ".toml";
  const rig::Experiment stand = rig::load(path_of(from, record.file), sets);
  set.add(
      {record.measured, "Length over time, " + record.what + ", measured"}, Kind::synthetic,
      fmt::format("{} with --set {}; 12-bit potentiometer over 2 in with 0.002 in of noise; not "
                  "the thesis's measurement, which is lost",
                  file, fmt::join(sets, " --set ")),
      recorded(stand, record.measured + "-" + record.file, &potentiometer));
  set.add({record.simulated, "Length over time, " + record.what + ", simulation"}, Kind::computed,
          file,
          recorded(rig::load(path_of(from, record.file)), record.simulated + "-" + record.file,
                   nullptr));
}

}  // namespace

void add_dynamic_figures(FigureSet& set, const FigureSources& from) {
  for (const Record& r :
       {Record{"3-6", "3-7", "trapped-60-6", "60 psi and 6 lb, trapped air", 2},
        Record{"3-8", "3-9", "trapped-80-11", "80 psi and 11 lb, trapped air", 1},
        Record{"3-10", "3-11", "trapped-60-11", "60 psi and 11 lb, trapped air", 2}})
    add_record(set, from, r, false);
  for (const Record& r :
       {Record{"3-14", "3-15", "pwm-25hz-5lb", "25 Hz and 5 lb"},
        Record{"3-16", "3-17", "pwm-25hz-1lb", "25 Hz and 1 lb"},
        Record{"3-18", "3-19", "pwm-25hz-15lb", "25 Hz and 15 lb"},
        Record{"3-20", "3-21", "pwm-50hz-1lb", "50 Hz and 1 lb"},
        // The caption says 1 lb once more.
        Record{"3-22", "3-23", "pwm-50hz-5lb-guess", "50 Hz and 5 or 15 lb, guesses for 1 lb"},
        Record{"3-22", "3-23", "pwm-50hz-15lb-guess", "50 Hz and 5 or 15 lb, guesses for 1 lb"}})
    add_record(set, from, r, true);
}

}  // namespace sinew::cli
