#include "sinew/report/page/stand.h"

#include <algorithm>
#include <cmath>

#include "sinew/actuator/braid.h"

namespace sinew::report {

namespace {

using signals::Column;

class StandMaker {
 public:
  StandMaker(const Channels& channels, const analysis::Machine& machine, signals::Table& drawn)
      : channels_(channels), machine_(machine), stand_(*machine.stand), drawn_(drawn) {}

  Stand make() {
    out_.element = stand_.element.name;
    out_.length = first("/true/stand/length", robot::Transducer::Of::length);
    if (out_.empty()) return std::move(out_);
    out_.drawn_from = out_.length.topic.starts_with("/true/") ? "true values" : "measured values";
    length_ = channels_.find(out_.length);
    add_element();
    add_air();
    add_load();
    return std::move(out_);
  }

 private:
  // Returns the true channel, or else that of a sensor of the quantity.
  Channel first(const std::string& topic, robot::Transducer::Of of) const {
    if (channels_.has({topic})) return {topic};
    for (const robot::Transducer& s : stand_.sensors)
      if (s.of == of && channels_.has({"/sensor/" + s.name + "/value"}))
        return {"/sensor/" + s.name + "/value"};
    return {};
  }
  Channel draw(const std::string& name, const std::string& unit, const Samples& clock,
               Column values) {
    drawn_.series.push_back(
        {{"/draw/" + name, "", {{"value", unit}}}, *clock.time_ns, {std::move(values)}});
    return {"/draw/" + name};
  }

  void add_element() {
    const auto [least, most] = std::ranges::minmax(*length_.values);
    out_.least = least, out_.most = most;
    const robot::Stand::Element& element = stand_.element;
    out_.count = element.count;
    if (element.cylinder.bore > 0) {
      out_.bore = element.cylinder.bore, out_.rod = element.cylinder.rod_diameter;
      out_.stroke = out_.longest = element.cylinder.stroke;
      return;
    }
    for (const actuator::Actuator& a : machine_.actuators)
      if (a.name == element.actuator) add_braid(a);
  }

  void add_braid(const actuator::Actuator& a) {
    out_.turns = a.braid.turns;
    out_.shortest = actuator::shortest_length(a.braid);
    out_.longest = a.long_end.length;
    Column diameter(length_.values->file());
    for (const double l : *length_.values) diameter.push_back(actuator::diameter(a.braid, l));
    out_.diameter = draw("stand/diameter", "m", length_, std::move(diameter));
  }

  void add_air() {
    using enum Stand::Air;
    using Mode = robot::Stand::Charge::Mode;
    const Mode mode = stand_.charge.mode;
    out_.air = mode == Mode::regulated ? regulated : mode == Mode::valves ? valves : sealed;
    if (out_.air == valves && !valve_of(machine_, stand_.element.inlet).seals())
      out_.air = three_way;
    const std::string valve = "/valve/" + stand_.element.name + "/";
    out_.inlet = channels_.first_of({valve + "inlet/open"});
    out_.exhaust = channels_.first_of({valve + "exhaust/open"});
    const Channel pressure =
        first("/true/muscle/" + stand_.element.name + "/pressure", robot::Transducer::Of::pressure);
    out_.pressure = absolute(pressure);
  }

  // Returns a pressure as an absolute one; transducers read gauge pressures.
  Channel absolute(const Channel& pressure) {
    if (!pressure.topic.starts_with("/sensor/")) return pressure;
    const Samples read = channels_.find(pressure);
    Column values(read.values->file());
    for (const double p : *read.values) values.push_back(p + machine_.atmosphere);
    return draw("stand/pressure", "Pa", read, std::move(values));
  }

  void add_load() {
    out_.desired = channels_.first_of({"/desired/length"});
    out_.tension = first("/true/stand/force", robot::Transducer::Of::force);
    if (stand_.load.mode != robot::Stand::Load::Mode::hanging) {
      out_.load = out_.most > out_.least ? Stand::Load::driven : Stand::Load::clamped;
      // The measured length of a clamped element is never exactly constant.
      if (stand_.load.lengths.empty()) out_.load = Stand::Load::clamped;
      return;
    }
    Column weight(length_.time_ns->file());
    for (const std::int64_t ns : *length_.time_ns) weight.push_back(pull(1e-9 * double(ns)));
    out_.heaviest = std::ranges::max(weight);
    out_.weight_step = smallest_step();
    out_.weight = draw("stand/weight", "N", length_, std::move(weight));
  }

  // Returns the downward force without inertia, [36]: M g + F_ext  [N].
  double pull(double t) const {
    const robot::Stand::Load& load = stand_.load;
    const double mass = load.weights.empty() ? load.mass : weights_.at(t);
    const double force = load.forces.empty() ? load.force : forces_.at(t);
    return mass * load.gravity + force;
  }

  // Returns the smallest step of the load's schedules; 0 if the load does not change  [N].
  double smallest_step() const {
    double least = 0;
    const auto look = [&](const std::vector<signals::Schedule::Point>& points, double newtons) {
      for (std::size_t i = 1; i < points.size(); ++i) {
        const double step = newtons * std::abs(points[i].value - points[i - 1].value);
        if (step > 0 && (least == 0 || step < least)) least = step;
      }
    };
    look(stand_.load.weights, stand_.load.gravity);
    look(stand_.load.forces, 1);
    return least;
  }

  const Channels& channels_;
  const analysis::Machine& machine_;
  const analysis::MachineStand& stand_;
  const signals::Schedule weights_{signals::steps_of(stand_.load.weights)};
  const signals::Schedule forces_{stand_.load.forces};
  signals::Table& drawn_;
  Samples length_;
  Stand out_;
};

}  // namespace

Stand stand(const Channels& channels, const analysis::Machine& machine, signals::Table& drawn) {
  return StandMaker(channels, machine, drawn).make();
}

// --- charts ---

namespace {

// Returns whether a channel changes by more than rounding.
bool varies(const Samples& s) {
  if (!s) return false;
  double least = INFINITY, most = -INFINITY;
  for (const double v : *s.values)
    if (std::isfinite(v)) least = std::min(least, v), most = std::max(most, v);
  return most - least > 1e-9 * std::max(std::abs(most), std::abs(least));
}

// Adds a chart of one channel against another, if both vary and have the same times.
void add_loop(const Channels& channels, const std::string& title, const Axis& x, const Channel& xs,
              const Axis& y, const Channel& ys, std::vector<Plot>& out) {
  const Samples a = channels.find(xs), b = channels.find(ys);
  if (!varies(a) || !varies(b) || *a.time_ns != *b.time_ns) return;
  out.push_back({.title = title,
                 .x = x,
                 .y = y,
                 .curves = {{.label = y.name, .x_channel = xs, .y_channel = ys}},
                 .note = "Over the whole run; the dot is its time."});
}

void add_sweep(const Channels& channels, const std::string& title, const std::string& what,
               const std::string& unit, std::vector<Plot>& out) {
  const Samples duty = channels.find({"/sweep/duty"}), values = channels.find({what});
  if (!duty || !values) return;
  const Curve line{
      .label = "settled", .xs = duty.values->in_memory(), .ys = values.values->in_memory()};
  const Curve points{.xs = line.xs, .ys = line.ys, .style = Curve::Style::points};
  out.push_back({.title = title,
                 .x = {"delivered duty", "share"},
                 .y = {title, unit},
                 .curves = {line, points}});
}

}  // namespace

std::vector<Plot> stand_charts(const Channels& channels, const Stand& s) {
  std::vector<Plot> out;
  const Axis length{"length", "m"}, tension{"tension", "N"}, pressure{"pressure", "Pa"};
  if (!s.empty()) {
    add_loop(channels, "Tension against length", length, s.length, tension, s.tension, out);
    add_loop(channels, "Pressure against length", length, s.length, pressure, s.pressure, out);
    if (s.load == Stand::Load::clamped)
      add_loop(channels, "Tension against pressure", pressure, s.pressure, tension, s.tension, out);
  }
  add_sweep(channels, "Length", "/true/sweep/length", "m", out);
  add_sweep(channels, "Ripple of the length", "/true/sweep/ripple", "m", out);
  add_sweep(channels, "Pressure", "/true/sweep/pressure", "Pa", out);
  add_sweep(channels, "Tension", "/true/sweep/force", "N", out);
  return out;
}

}  // namespace sinew::report
