// thesis/figures/chapter_5.cpp - figure 5-3, the interrupt's timing, from the low level's schedule
// and from the recorded edges of a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sinew/control/setup/joint_controllers.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/run.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using report::Curve;
using signals::Tick;

constexpr double ms_per_tick = signals::tick_seconds * 1e3;
constexpr const char* file = "experiments/walk-test-1.toml";

struct Edge {
  Tick at = 0;
  bool open = false;
};

struct Valve {
  std::string name;   // "hip flexor inlet"
  std::size_t joint;  // index in the low level
  std::vector<Edge> edges;
};

struct Schedule {
  experiment::Experiment experiment;
  control::JointControllerConfig joint_controller;
  std::vector<Valve> valves;
  Tick begin = 0, end = 0;  // range of the plan's phases
  Tick period = 0;          // first tick of the period that is drawn
};

std::vector<Valve> valves_of(const experiment::Experiment& e, const signals::Table& table) {
  std::vector<Valve> out;
  for (const robot::Muscle& m : e.robot.muscles)
    for (const char* which : {"inlet", "exhaust"}) {
      Valve v{m.name + " " + which, 0, {}};
      std::ranges::replace(v.name, '_', ' ');
      v.joint = static_cast<std::size_t>(robot::find_joint(e.robot, m.joint));
      const signals::Series* series = table.find(fmt::format("/valve/{}/{}/open", m.name, which));
      for (std::size_t i = 0; series && i < series->time_ns.size(); ++i)
        v.edges.push_back(
            {series->time_ns[i] / signals::tick_nanoseconds, series->columns[0][i] != 0});
      out.push_back(std::move(v));
    }
  return out;
}

// Returns the first of the periods in which, together with the next one, most valves switch.
Tick busiest(const std::vector<Valve>& valves, Tick period, Tick from, Tick to) {
  std::map<Tick, int> busy;
  for (const Valve& v : valves) {
    std::map<Tick, bool> seen;
    for (const Edge& e : v.edges) {
      const Tick at = e.at / period * period;
      for (const Tick begin : {at - period, at})
        if (begin >= from && begin <= to) seen[begin] = true;
    }
    for (const auto& [at, unused] : seen) ++busy[at];
  }
  Tick best = from;
  for (const auto& [at, count] : busy)
    if (count > busy[best]) best = at;
  return best;
}

Schedule schedule(const Sources& from) {
  Schedule out{.experiment = experiment::load(from.path(file), {"sequence.repeat=1"})};
  out.joint_controller = control::joint_controller_config(run::installation(out.experiment));
  const signals::Table table = run::run(out.experiment).table;
  out.valves = valves_of(out.experiment, table);
  const signals::Series& phase = *table.find("/plan/phase");
  for (std::size_t i = 0; i < phase.time_ns.size(); ++i) {
    if (phase.columns[0][i] < 0) continue;
    out.end = phase.time_ns[i] / signals::tick_nanoseconds / out.joint_controller.period *
              out.joint_controller.period;
    if (out.begin == 0) out.begin = out.end + out.joint_controller.period;
  }
  out.period = busiest(out.valves, out.joint_controller.period, out.begin,
                       out.end - 2 * out.joint_controller.period);
  return out;
}

// Returns the earliest and the latest tick within the period at which valves of a joint open.
std::pair<Tick, Tick> openings(const Schedule& s, std::size_t joint) {
  std::pair<Tick, Tick> out{1'000'000, -1};
  for (const Valve& v : s.valves)
    for (const Edge& e : v.edges) {
      if (v.joint != joint || !e.open || e.at < s.begin || e.at >= s.end) continue;
      const Tick phase = e.at % s.joint_controller.period;
      out = {std::min(out.first, phase), std::max(out.second, phase)};
    }
  return out;
}

// --- the figure: one row per signal, high while it is on ----------------------------------------

class Rows {
 public:
  Rows(double last, std::size_t rows) : last_(last), row_(static_cast<double>(rows) + 1) {}

  // Adds a row that is on in [from, to) of each pair [ms].
  void add(const std::string& name, const std::vector<std::pair<double, double>>& on,
           const std::string& source, int color) {
    row_ -= 1;
    Curve c{.label = name, .style = Curve::Style::steps, .color = color, .source = source};
    const auto point = [&](double x, double height) {
      c.xs.push_back(x);
      c.ys.push_back(row_ + height);
    };
    point(0, 0);
    for (const auto& [begin, end] : on) {
      if (begin >= last_) continue;
      if (begin > 0) point(begin, 0.7);
      if (begin <= 0) c.ys.back() = row_ + 0.7;
      point(std::min(end, last_), 0);
    }
    if (c.xs.back() < last_) point(last_, 0);
    ticks_.push_back({row_ + 0.35, name});
    curves_.push_back(std::move(c));
  }

  report::Plot plot(const std::string& name, const std::string& title) {
    share_instants();
    report::Plot out{.name = name,
                     .title = title,
                     .x = {"time", "ms", 0, last_},
                     .y = {"", "-", 0.7, static_cast<double>(curves_.size()) + 1.2},
                     .curves = curves_};
    out.y.ticks = ticks_;
    out.names = report::Plot::Names::none;
    return out;
  }

 private:
  // Gives all rows the instants of all, so that they form one table of numbers.
  void share_instants() {
    std::vector<double> all;
    for (const Curve& c : curves_) all.insert(all.end(), c.xs.begin(), c.xs.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (Curve& c : curves_) {
      std::vector<double> ys;
      std::size_t i = 0;
      for (const double x : all) {
        while (i + 1 < c.xs.size() && c.xs[i + 1] <= x) ++i;
        ys.push_back(c.ys[i]);
      }
      c.xs = all;
      c.ys = std::move(ys);
    }
  }

  double last_, row_;
  std::vector<report::Axis::Tick> ticks_;
  std::vector<Curve> curves_;
};

report::Plot scan(const Schedule& s) {
  Rows rows(2.0, 1 + s.joint_controller.conversions + 2 * s.joint_controller.joints);
  std::vector<std::pair<double, double>> interrupts;
  for (int k = 0; k < 20; ++k) interrupts.push_back({k * ms_per_tick, (k + 0.3) * ms_per_tick});
  rows.add("interrupt", interrupts, "every 100 us", 6);
  const std::string source = "the low level's scan, from robots/leg/robot.toml";
  for (std::size_t i = 0; i < s.joint_controller.conversions; ++i) {
    const signals::Conversion& c = s.joint_controller.conversion[i];
    rows.add(spaced_name(s.experiment.robot.sensors[c.channel.index].name),
             {{c.start * ms_per_tick, c.read * ms_per_tick}}, source, 0);
  }
  for (std::size_t j = 0; j < s.joint_controller.joints; ++j) {
    const double at = s.joint_controller.joint[j].law_tick * ms_per_tick;
    const std::string name = s.experiment.robot.joints[j].name;
    rows.add(name + " law", {{at, at + ms_per_tick}}, source, 1);
    const double open = static_cast<double>(openings(s, j).first) * ms_per_tick;
    rows.add(name + " valves open", {{open, open + ms_per_tick}},
             std::string(file) + ", the first recorded edge", 2);
  }
  return rows.plot("scan", "Scan, laws, and when valves open");
}

report::Plot pulses(const Schedule& s) {
  const double last = 2 * s.joint_controller.period * ms_per_tick;
  Rows rows(last, s.valves.size());
  for (const Valve& v : s.valves) {
    std::vector<std::pair<double, double>> on;
    double opened = -1;
    bool open = false;
    for (const Edge& e : v.edges) {
      const double at = static_cast<double>(e.at - s.period) * ms_per_tick;
      if (at >= last) break;
      if (e.open && !open) opened = std::max(at, 0.0);
      if (!e.open && open && at > 0) on.push_back({opened, at});
      open = e.open;
    }
    if (open) on.push_back({opened, last});
    rows.add(v.name, on, std::string(file) + ", recorded edges", static_cast<int>(2 * v.joint));
  }
  return rows.plot("valves", "Two periods of commands to the valves");
}

// --- statements of 5.2 --------------------------------------------------------------------------

std::vector<report::Claim> claims_of(const Schedule& s) {
  const Section text("5.2");
  int least_step = 1000, most_step = 0, least_settling = 1000;
  for (std::size_t i = 0; i < s.joint_controller.conversions; ++i) {
    const signals::Conversion& c = s.joint_controller.conversion[i];
    least_settling = std::min(least_settling, c.read - c.start);
    if (i == 0) continue;
    const int step = c.read - s.joint_controller.conversion[i - 1].read;
    least_step = std::min(least_step, step);
    most_step = std::max(most_step, step);
  }
  double latest = 0;  // time from a law to the opening that results from it
  for (std::size_t j = 0; j < s.joint_controller.joints; ++j) {
    const auto [first, last] = openings(s, j);
    for (const Tick at : {first, last})
      latest = std::max(latest,
                        std::fabs(static_cast<double>(at) - s.joint_controller.joint[j].law_tick));
  }
  const double apart =
      static_cast<double>(openings(s, 1).first - openings(s, 0).first) * ms_per_tick;
  const double period = s.joint_controller.period * ms_per_tick;
  return {
      text.number(put_in, "A whole period lasts", "10 ms", "ticks of the low level", period, "ms",
                  analysis::computed(10, 1)),
      text.number(by_construction, "Each hundredth of it is an interrupt", "100 us",
                  "period by 100", 1e3 * period / 100, "us", analysis::computed(100, 1),
                  "a tick is 100 us here"),
      text.number(put_in, "A new channel in every other interrupt, not sooner", "200 us",
                  "least time between readings", 1e3 * least_step * ms_per_tick, "us",
                  analysis::computed(200, 1)),
      text.number(put_in, "A new channel in every other interrupt, not later", "200 us",
                  "longest time between readings", 1e3 * most_step * ms_per_tick, "us",
                  analysis::computed(200, 1)),
      text.number(put_in, "The multiplexer needs to settle before a conversion", "25 us",
                  "least time from choosing a channel to its reading",
                  1e3 * least_settling * ms_per_tick, "us", analysis::at_least(25)),
      text.number(put_in, "The valves' period begins with the interrupt of their law", "at once",
                  "longest time from a law to the opening of its valves, over the run",
                  1e3 * latest * ms_per_tick, "us", analysis::negligible(1e3 * period),
                  "an interrupt sets the valves first and runs the law afterwards"),
      text.number(put_in, "Periods of different valves begin at different times", "",
                  "first opening at the knee less at the hip", 1e3 * apart, "us",
                  analysis::at_least(1e3 * ms_per_tick),
                  "an interrupt is the least by which they can differ")};
}

}  // namespace

Exhibits chapter_5(const Sources& from) {
  const Schedule s = schedule(from);
  return {{{.name = "5-3",
            .title = "Timing of the interrupt",
            .caption = fmt::format(
                "Scan, laws and pulses of the low level as it runs here: seven conversions, each "
                "begun in one interrupt and read in the next, a law after its last reading, and "
                "the valves' period from there on. Pulses are those of walking test 1 from "
                "{:.2f} s on, where most valves are switched.",
                static_cast<double>(s.period) * signals::tick_seconds),
            .plots = {scan(s), pulses(s)}},
           claims_of(s)}};
}

}  // namespace sinew::thesis
