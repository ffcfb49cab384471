#include "sinew/experiment/rig/check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "sinew/actuator/body.h"
#include "sinew/config/quantity.h"
#include "sinew/config/short_quantity.h"
#include "sinew/experiment/faults.h"
#include "sinew/experiment/rig/fault_parts.h"
#include "sinew/world/stand.h"

namespace sinew::rig {
namespace {

using Kind = Drive::Kind;

class Findings {
 public:
  explicit Findings(const Experiment& e) : e_(e) {}

  void add(std::string key, std::string found, std::string expected, std::string try_this = "") {
    config::Problem p;
    const config::Origin* origin = config::find_origin(e_.origins, key);
    p.where = origin && !origin->is_default ? origin->where : config::Location{e_.path, 0, 0};
    p.key = std::move(key);
    p.found = std::move(found);
    p.expected = std::move(expected);
    p.try_this = std::move(try_this);
    problems_.push_back(std::move(p));
  }
  // A key that its table would not use.
  void unused(bool given, std::string key, std::string_view of) {
    if (given) add(std::move(key), "a key of " + std::string(of), "only what is used");
  }
  template <class Items>
  void need(const std::string& key, const std::string& name, const Items& items) {
    std::vector<std::string_view> names;
    for (const auto& item : items) names.push_back(item.name);
    if (std::ranges::count(names, name) > 0) return;
    add(key, config::in_quotes(name), config::either(names),
        config::closest_in_quotes(name, names));
  }
  bool none() const { return problems_.empty(); }
  void refuse() const {
    if (!none()) throw config::Error(problems_);
  }

 private:
  const Experiment& e_;
  std::vector<config::Problem> problems_;
};

bool whole_ticks(double seconds) {
  const double ticks = seconds / signals::tick_seconds;
  return std::fabs(ticks - std::round(ticks)) < 1e-6;
}

void check_valves(const Experiment& e, Findings& out) {
  if (e.charge.mode != plant::Charge::Mode::valves) {
    out.unused(e.drive.kind != Kind::none, "drive.kind", "charge.mode = \"valves\"");
    return;
  }
  out.need("element.inlet", e.element.inlet, e.valves);
  const gas::Valve* inlet = find_valve(e, e.element.inlet);
  if (!inlet) return;
  if (inlet->kind == gas::Valve::Kind::regulator)
    out.add("element.inlet", "a regulator", "a valve", "charge.mode = \"regulated\"");
  if (inlet->kind == gas::Valve::Kind::two_way) {
    out.need("element.exhaust", e.element.exhaust, e.valves);
    const gas::Valve* exhaust = find_valve(e, e.element.exhaust);
    if (exhaust && exhaust->kind != gas::Valve::Kind::two_way)
      out.add("element.exhaust", config::in_quotes(e.element.exhaust), "a 2-way valve",
              "a 3-way valve stands at the inlet");
  } else {
    out.unused(!e.element.exhaust.empty(), "element.exhaust", "a 2-way inlet");
  }
}

void check_element(const Experiment& e, Findings& out) {
  const Element::Cylinder& c = e.element.cylinder;
  if (c.bore > 0) {
    out.unused(!e.element.actuator.empty(), "element.actuator", "an element without a cylinder");
    out.unused(e.element.count != 1, "element.count", "a muscle");
    out.unused(e.element.external_volume > 0, "element.external_volume", "a muscle");
    if (e.element.hose.law != gas::Hose::Law::none || e.element.leak.area > 0 ||
        e.element.leak.conductance > 0)
      out.add("element.cylinder", "a hose or a leak beside it", "those of a muscle");
    if (!(c.stroke > 0 && c.dead_volume > 0 && c.rod_diameter < c.bore))
      out.add("element.cylinder", "no cylinder",
              "a stroke, a dead volume, and a rod thinner than the bore");
    using Kinds = Drive::Kind;
    if (e.drive.kind == Kinds::feed_forward ||
        (e.drive.kind == Kinds::feedback && e.element.exhaust.empty()))
      out.add("drive.kind", "a law with the model of a muscle", "pwm or pulses for a cylinder");
    return;
  }
  out.need("element.actuator", e.element.actuator, e.actuators);
}

void check_load(const Experiment& e, Findings& out) {
  const Load& l = e.load;
  if (l.mode == plant::Load::Mode::driven) {
    out.unused(l.mass > 0 || !l.weights.empty(), "load.mass", "mode = \"hanging\"");
    out.unused(l.force != 0 || !l.forces.empty(), "load.force", "mode = \"hanging\"");
    out.unused(e.start_length > 0, "start.length", "mode = \"hanging\"");
    out.unused(e.displacement != 0, "start.displacement", "mode = \"hanging\"");
  } else {
    out.unused(l.length > 0 || !l.lengths.empty(), "load.length", "mode = \"driven\"");
  }
  out.unused(l.mass > 0 && !l.weights.empty(), "load.mass", "a load without weights");
  out.unused(l.force != 0 && !l.forces.empty(), "load.force", "a load without forces");
  out.unused(l.length > 0 && !l.lengths.empty(), "load.length", "a load without lengths");
  const bool regulated = e.charge.mode == plant::Charge::Mode::regulated;
  const bool prescribed = e.charge.pressure > 0 || !e.charge.pressures.empty();
  out.unused(!regulated && prescribed, "charge.pressure", "mode = \"regulated\"");
  out.unused(regulated && e.start_pressure > 0, "start.pressure", "a charge that is not regulated");
}

// No clamp reaches further than the stand itself takes (mechanism/slide), and a length at which the
// chamber holds no air has no pressure.
void check_volumes(const Experiment& e, Findings& out) {
  const auto check = [&](const std::string& key, double length) {
    for (const actuator::Actuator& a : e.actuators) {
      if (a.name != e.element.actuator) continue;
      const double longest = 1.5 * a.braid.thread_length;
      const auto text = [&](double metres) {
        return config::quantity_like(e.origins, key, metres, "m", "in");
      };
      if (length > longest) {
        out.add(key, text(length), "at most " + text(longest) + ", 1.5 threads of the muscle",
                "a length that it can have");
        continue;
      }
      if (length > a.caps.length && actuator::volume(a, length) + e.element.external_volume > 0)
        continue;
      out.add(
          key, "a chamber without volume: the muscle is " + text(length) + " long",
          "above " + text(a.caps.length) + " and below the thread's " + text(a.braid.thread_length),
          "an element.external_volume above 0 where it is longer");
    }
  };
  if (e.element.cylinder.bore > 0) return;
  if (e.load.length > 0) check("load.length", e.load.length);
  for (std::size_t i = 0; i < e.load.lengths.size(); ++i)
    check("load.lengths[" + std::to_string(i) + "].length", e.load.lengths[i].value);
  if (e.start_length > 0) check("start.length", e.start_length);
}

// More memory than there is, for a typing error.
void check_size(const Experiment& e, Findings& out) {
  constexpr double most = 2'000'000;  // samples
  const double period = e.sweep.step > 0 ? e.duration : e.log.period;
  if (e.duration > most * period)
    out.add("log.period", config::format_number(e.duration / period) + " samples",
            "at most 2000000", "a longer period");
}

void check_law(const Experiment& e, Findings& out) {
  const Drive& d = e.drive;
  const bool law = d.kind == Kind::feed_forward || d.kind == Kind::feedback;
  if (law && d.lengths.empty() && !(d.desired > 0))
    out.add("drive.desired", "none", "a length", "desired = \"2.9 in\"");
  out.unused(!law && (d.desired > 0 || !d.lengths.empty()), "drive.desired",
             "kind = \"feed-forward\" or \"feedback\"");
  out.unused(!law && d.believed_load != 0, "drive.believed_load", "kind = \"feed-forward\"");
  out.unused(d.kind != Kind::feedback && !d.sensor.empty(), "drive.sensor", "kind = \"feedback\"");
  out.unused(d.kind != Kind::feedback && (d.gain > 0 || d.dead_band > 0), "drive.gain",
             "kind = \"feedback\"");
  if (d.kind != Kind::feedback) return;
  out.need("drive.sensor", d.sensor, e.sensors);
  for (const plant::Transducer& t : e.sensors)
    if (t.name == d.sensor && t.of != plant::Transducer::Of::length)
      out.add("drive.sensor", "another quantity", "a sensor of the length");
  if (d.law == Drive::Law::proportional && !(d.gain > 0))
    out.add("drive.gain", "none", "a duty per length", "gain = \"5 1/in\"");
}

void check_faults(const Experiment& e, Findings& out) {
  if (e.faults.empty()) return;
  if (e.charge.mode == plant::Charge::Mode::regulated) {
    out.add("fault", "a list of faults",
            "none: the pressure is prescribed, and nothing that breaks would change it",
            "charge.mode = \"sealed\" or \"valves\"");
    return;
  }
  std::vector<robot::Contradiction> found;
  experiment::check_faults(e.faults, fault_parts(e), found);
  for (robot::Contradiction& c : found)
    out.add(std::move(c.key), std::move(c.found), std::move(c.expected), std::move(c.try_this));
}

void check_drive(const Experiment& e, Findings& out) {
  const Drive& d = e.drive;
  if (!whole_ticks(d.period)) out.add("drive.period", "no whole ticks", "a multiple of 0.1 ms");
  if (!whole_ticks(e.log.period)) out.add("log.period", "no whole ticks", "a multiple of 0.1 ms");
  if (e.charge.mode == plant::Charge::Mode::valves && d.kind == Kind::none)
    out.add("drive.kind", "none", "what opens the valves", "charge.mode = \"sealed\"");
  if (e.measured.from >= e.duration)
    out.add("measured.from", "no row before the end", "less than duration");
  out.unused(d.kind != Kind::pwm && (d.duty > 0 || !d.duties.empty()), "drive.duty",
             "kind = \"pwm\"");
  out.unused(d.kind != Kind::pulses && !d.pulses.empty(), "drive.pulses", "kind = \"pulses\"");
  if (d.kind == Kind::pulses && d.pulses.empty())
    out.add("drive.pulses", "none", "at least one", "[[drive.pulses]]");
  for (const plant::Point& p : d.duties)
    if (!(p.value >= 0 && p.value <= 1)) out.add("drive.duties", "no share", "0 to 100 %");
  if (static_cast<double>(e.sensors.size()) + 2 > d.period / signals::tick_seconds)
    out.add("sensor", std::to_string(e.sensors.size()), "fewer than the period has ticks");
  check_law(e, out);
  if (!(e.sweep.step > 0)) return;
  if (d.kind != Kind::pwm) out.add("sweep", "another drive", "drive.kind = \"pwm\"");
  if (!(e.sweep.from < e.sweep.to)) out.add("sweep.to", "no more than from", "an ascending sweep");
  if (e.duration < 5 * d.period) out.add("duration", "no five periods", "longer than the settling");
}

// Lengths and pressures that the plant itself refuses.
void check_plant(const Experiment& e, Findings& out) {
  try {
    plant::Stand stand(setup_of(e));
  } catch (const std::invalid_argument& refused) {
    out.add("load", refused.what(), "a set-up that can be built");
  }
}

}  // namespace

void refuse_contradictions(const Experiment& e) {
  Findings out(e);
  check_element(e, out);
  check_valves(e, out);
  check_load(e, out);
  check_drive(e, out);
  check_faults(e, out);
  check_size(e, out);
  check_volumes(e, out);
  if (out.none()) check_plant(e, out);
  out.refuse();
}

}  // namespace sinew::rig
