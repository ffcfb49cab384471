// Coil current: the dip caused by the moving shutter shows when the valve is open, figure 4-8.
//
// The current follows gas/coil_current.h: exponentials with one rate towards U/R, reduced by the
// back-EMF while the shutter moves, and towards the holding current after a boost.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/gas/coil_current.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/valve/edges.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

namespace {

constexpr std::size_t fewest = 20;  // samples per pulse

// All pulses superimposed, with time relative to the coil's edge.
struct Pulses {
  std::vector<double> time, current;  // [s], [A]; ascending in time
  double sample = 0;                  // [s]
  double length = 0;                  // length of the shortest pulse [s]
  double largest = 0;                 // [A]
  double decay_time = unbounded;      // time after switching off until less than 5 % remains [s]
  int count = 0;
};

// Finds the edges without a recorded command: the pulse begins where the current rises from zero,
// and ends at the last sample before its final decay.
Edges edges_by_current(const Measured& data) {
  Measured with = data;
  const std::vector<double>& current = data["current"];
  const double threshold = 0.03 * largest(current);
  std::vector<double> command(current.size());
  for (std::size_t i = current.size(), on = 0; i-- > 0;) {
    if (current[i] <= threshold) on = 0;
    const bool last = i + 1 == current.size();
    // Scanned backwards in time, the decay rises; the pulse ends where it stops rising.
    const std::size_t later = std::min(i + 3, current.size() - 1);
    if (current[i] > threshold && (last || current[i] <= current[later] * 1.02)) on = 1;
    command[i] = on ? 1.0 : 0.0;
  }
  with.columns.push_back({"command", "1", command});
  return edges_of(with);
}

Pulses pulses_of(const Measured& data, Report& report) {
  const bool commanded = data.has("command");
  const Edges edges = commanded ? edges_of(data) : edges_by_current(data);
  if (!commanded)
    report.notes.emplace_back("no column command: the current's rise is taken for the edge");
  const std::vector<double>&t = data["time"], &current = data["current"];
  Pulses p{.sample = edges.sample, .length = unbounded, .largest = largest(current)};
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < edges.edges.size(); ++k) {
    const Opening& on = edges.edges[k];
    if (!on.open || on.time < t.front()) continue;
    const bool ends = k + 1 < edges.edges.size();
    const double off = ends ? edges.edges[k + 1].time : t.back();
    const bool enough = off - on.time >= static_cast<double>(fewest) * p.sample;
    if (!ends && !enough && p.count > 0) {
      report.notes.emplace_back("the last pulse is left out: the file ends soon after its edge");
      continue;
    }
    p.length = std::min(p.length, off - on.time);
    ++p.count;
    double last = p.largest;  // current at switching off
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (t[i] > on.time - 2 * p.sample && t[i] < off) {
        points.emplace_back(t[i] - on.time, current[i]);
        last = current[i];
      }
      const bool released = t[i] > off && ends;
      if (released && current[i] < 0.05 * last) {
        p.decay_time = std::min(p.decay_time, t[i] - off);
        break;
      }
    }
  }
  if (p.count == 0 || p.length < static_cast<double>(fewest) * p.sample)
    throw Refusal(data.file + ": current",
                  p.count == 0 ? "no pulse from its beginning"
                               : fmt::format("pulses of {:.0f} samples", p.length / p.sample),
                  fmt::format("at least {} samples from the coil's edge on", fewest),
                  "a faster sampling");
  std::sort(points.begin(), points.end());
  for (const auto& [time, value] : points) {
    if (time >= p.length) continue;
    p.time.push_back(time);
    p.current.push_back(value);
  }
  return p;
}

struct CoilModel {
  std::string_view name, law;
  bool dip = false, boost = false;
};

constexpr std::array coil_models{
    CoilModel{"coil", "L di/dt + R i = U"},
    CoilModel{"coil, boosted", "the same, U lower after the boost", false, true},
    CoilModel{"coil and shutter", "L di/dt + R i = U - E while the shutter moves", true, false},
    CoilModel{"coil and shutter, boosted", "the same, U lower after the boost", true, true}};

// Returns the pieces of the current from parameters: edge, on, rate, [end, motion, dip], [boost,
// hold].
std::vector<gas::CurrentPiece> pieces_of(const CoilModel& model, std::span<const double> p) {
  const double edge = p[0], on = p[1], rate = p[2];
  const double open = model.dip ? p[3] : unbounded, motion = model.dip ? p[4] : 0;
  const double dip = model.dip ? p[5] : 0;
  const std::size_t next = model.dip ? 6 : 3;
  const double boosted = model.boost ? p[next] : unbounded, hold = model.boost ? p[next + 1] : on;
  const double begins = std::max(0.0, open - motion);

  std::array corners{0.0, begins, open, boosted};
  std::sort(corners.begin(), corners.end());
  std::vector<gas::CurrentPiece> out;
  double current = 0;
  for (const double corner : corners) {
    if (!std::isfinite(corner)) break;
    if (!out.empty()) current = out.back().at(edge + corner);
    const bool moves = corner >= begins && corner < open;
    const double end = (corner < boosted ? on : hold) - (moves ? dip : 0);
    out.push_back({edge + corner, current, end, rate});
  }
  return out;
}

std::vector<Parameter> parameters_of(const CoilModel& model, const Pulses& c) {
  double rise = 0.3 * c.length;  // time to 63 %
  for (std::size_t i = 0; i < c.time.size(); ++i)
    if (c.current[i] > 0.63 * c.largest) {
      rise = std::max(c.time[i], c.sample);
      break;
    }
  const double edge = 1.5 * c.sample;
  std::vector<Parameter> p{
      {"edge", "s", 0, -edge, edge, c.sample},
      {"current", "A", 1.1 * c.largest, 0.2 * c.largest, 20 * c.largest, c.largest, true},
      {"rate", "1/s", 1 / rise, 0.02 / rise, 50 / rise, 1 / rise, true}};
  if (model.dip) {
    p.push_back({"opening_delay", "s", rise, 2 * c.sample, c.length, rise});
    p.push_back({"motion_time", "s", 0.3 * rise, c.sample, 0.5 * c.length, rise});
    p.push_back({"dip", "A", c.largest, 0, 20 * c.largest, c.largest, true});
  }
  if (model.boost) {
    p.push_back({"boost_time", "s", 0.5 * c.length, 3 * c.sample, c.length, rise});
    p.push_back({"holding_current", "A", 0.3 * c.largest, 0, c.largest, c.largest});
  }
  return p;
}

// Returns times at which the slope of the current grows most: ends of possible dips.
std::vector<double> dips_of(const Pulses& c, double width) {
  std::vector<std::pair<double, double>> found;  // growth, time
  const auto mean = [&](double from, double to) {
    double sum = 0;
    int n = 0;
    for (std::size_t i = 0; i < c.time.size(); ++i)
      if (c.time[i] >= from && c.time[i] < to) sum += c.current[i], ++n;
    return n > 0 ? sum / n : 0.0;
  };
  for (double t = width; t < c.length - width; t += 0.5 * width)
    found.emplace_back(mean(t + 0.5 * width, t + width) -
                           2 * mean(t - 0.25 * width, t + 0.25 * width) +
                           mean(t - width, t - 0.5 * width),
                       t);
  std::sort(found.rbegin(), found.rend());
  std::vector<double> out;
  for (const auto& [bend, t] : found) {
    const bool near = std::any_of(out.begin(), out.end(), [t = t, width](double other) {
      return std::abs(other - t) < width;
    });
    if (!near) out.push_back(t);
    if (out.size() == 3) break;
  }
  return out;
}

std::vector<std::vector<double>> starts_of(const CoilModel& model, const Pulses& c,
                                           std::span<const Parameter> parameters) {
  std::vector<double> middle = starts_of(parameters);
  const std::size_t top = static_cast<std::size_t>(
      std::max_element(c.current.begin(), c.current.end()) - c.current.begin());
  if (model.boost) {  // the boost ends at the largest current
    middle[parameters.size() - 2] = c.time[top];
    middle[parameters.size() - 1] = c.current.back();
  }
  if (!model.dip) return {middle};
  std::vector<std::vector<double>> out;
  for (const double width : {0.05 * c.length, 0.015 * c.length})
    for (const double end : dips_of(c, std::max(width, 3 * c.sample))) {
      out.push_back(middle);
      out.back()[3] = end;
      out.back()[4] = std::min(0.3 * end, 4 * width);
    }
  if (out.empty()) out.push_back(middle);
  return out;
}

Candidate candidate_of(const CoilModel& model, const Pulses& c) {
  Candidate out{.model = std::string(model.name),
                .law = std::string(model.law),
                .source = "gas/coil_current.h, 4.3",
                .parameters = parameters_of(model, c),
                .options = {.correlated = true, .most_steps = 80, .difference = 1e-3},
                .may_be_at_bound = {"edge"}};
  out.starts = starts_of(model, c, out.parameters);
  out.predict = [&model, &c](std::span<const double> p, std::span<double> current) {
    const std::vector<gas::CurrentPiece> pieces = pieces_of(model, p);
    for (std::size_t i = 0; i < current.size(); ++i) current[i] = gas::current(pieces, c.time[i]);
    return true;
  };
  return out;
}

}  // namespace

ValveResult identify_coil(const Measured& data, const ValveOptions& options) {
  ValveResult out = before(options);
  Report& report = out.report;
  refuse_constant(data, "current", 0.0, "a current that is switched", "the columns");
  refuse_clipped(data, "current", "a larger range of the converter");
  const Pulses c = pulses_of(data, report);
  report.set_subject(fmt::format("opening delay of a valve by the current of {} pulse{}", c.count,
                                 c.count == 1 ? "" : "s"),
                     "current", "A", "the largest current");
  report.full_scale = c.largest;
  report.held_out_is = "every second sample";
  report.not_shown = {"how the delay changes with the pressure and with the supply's voltage"};
  report.notes.insert(report.notes.end(), data.notes.begin(), data.notes.end());
  report.rows = {.x = "time", .x_unit = "s", .at = c.time, .measured = c.current};
  std::vector<Candidate> candidates;
  for (const CoilModel& model : coil_models) candidates.push_back(candidate_of(model, c));
  Trial trial{.measured = c.current};
  std::vector<int> parity;
  for (std::size_t i = 0; i < c.time.size(); ++i) parity.push_back(i % 2);
  trial.splits = {each_part_held_out(parity).back()};
  fit_candidates(candidates, trial, report);
  conclude(report, 0.1, 0.01);
  if (!coil_models[report.chosen].dip)
    throw Refusal(data.file + ": current", "no dip in its rise: a coil without a moving shutter",
                  "the back-EMF of the opening shutter",
                  "a faster sampling, and whether the valve opens");

  const Estimate& delay = *report.best().estimate("opening_delay");
  out.valve.opening_delay = delay.value;
  out.opening_known = true;
  out.valve.profile = gas::Valve::Profile::dead_time;
  out.provenance.fitted("valve." + options.name + ".opening_delay", delay,
                        "sinew identify valve " + data.file + ", the current's dip");
  report.notes.push_back(fmt::format(
      "closing_delay is not in the current{}: a closing shutter gives no sign once the current has "
      "gone (4.3); a pressure record shows it",
      std::isfinite(c.decay_time)
          ? fmt::format(", which has gone {:.3g} ms after it is switched off", 1e3 * c.decay_time)
          : ""));
  return out;
}

}  // namespace sinew::identify
