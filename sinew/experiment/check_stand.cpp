// experiment/check_stand.cpp - what the values of a test stand allow, but not all of them together.
#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

#include "sinew/actuator/body.h"
#include "sinew/config/quantity.h"
#include "sinew/config/short_quantity.h"
#include "sinew/experiment/check.h"
#include "sinew/experiment/faults.h"

namespace sinew::experiment {
namespace {

using DriveKind = Stand::Drive::Kind;

class Findings {
 public:
  explicit Findings(std::vector<robot::Contradiction>& out) : out_(out) {}

  void add(std::string key, std::string found, std::string expected, std::string try_this = "") {
    out_.push_back({std::move(key), std::move(found), std::move(expected), std::move(try_this)});
  }
  // Adds a key that its table would not use.
  void unused(bool given, std::string key, std::string_view of) {
    if (given) add(std::move(key), "a key of " + std::string(of), "only what is used");
  }
  template <class Items>
  void need(const std::string& key, const std::string& name, const Items& items) {
    const std::vector<std::string_view> names = config::names_of(items);
    if (std::ranges::count(names, name) > 0) return;
    add(key, config::in_quotes(name), config::either(names),
        config::closest_in_quotes(name, names));
  }
  std::vector<robot::Contradiction>& list() { return out_; }

 private:
  std::vector<robot::Contradiction>& out_;
};

bool whole_ticks(double seconds) {
  const double ticks = seconds / signals::tick_seconds;
  return std::fabs(ticks - std::round(ticks)) < 1e-6;
}

void check_valves_of_stand(const Experiment& e, Findings& out) {
  if (e.stand->charge.mode != robot::Stand::Charge::Mode::valves) {
    out.unused(e.stand->drive.kind != DriveKind::none, "drive.kind", "charge.mode = \"valves\"");
    return;
  }
  out.need("element.inlet", e.stand->element.inlet, e.valves);
  const gas::Valve* inlet = find_valve(e, e.stand->element.inlet);
  if (!inlet) return;
  if (inlet->kind == gas::Valve::Kind::regulator)
    out.add("element.inlet", "a regulator", "a valve", "charge.mode = \"regulated\"");
  if (inlet->kind == gas::Valve::Kind::two_way) {
    out.need("element.exhaust", e.stand->element.exhaust, e.valves);
    const gas::Valve* exhaust = find_valve(e, e.stand->element.exhaust);
    if (exhaust && exhaust->kind != gas::Valve::Kind::two_way)
      out.add("element.exhaust", config::in_quotes(e.stand->element.exhaust), "a 2-way valve",
              "a 3-way valve stands at the inlet");
  } else {
    out.unused(!e.stand->element.exhaust.empty(), "element.exhaust", "a 2-way inlet");
  }
}

void check_element(const Experiment& e, Findings& out) {
  const Stand::Element::Cylinder& c = e.stand->element.cylinder;
  if (c.bore > 0) {
    out.unused(!e.stand->element.actuator.empty(), "element.actuator",
               "an element without a cylinder");
    out.unused(e.stand->element.count != 1, "element.count", "a muscle");
    out.unused(e.stand->element.external_volume > 0, "element.external_volume", "a muscle");
    if (e.stand->element.hose.law != gas::Hose::Law::none || e.stand->element.leak.area > 0 ||
        e.stand->element.leak.conductance > 0)
      out.add("element.cylinder", "a hose or a leak beside it", "those of a muscle");
    if (!(c.stroke > 0 && c.dead_volume > 0 && c.rod_diameter < c.bore))
      out.add("element.cylinder", "no cylinder",
              "a stroke, a dead volume, and a rod thinner than the bore");
    if (e.stand->drive.kind == DriveKind::feed_forward ||
        (e.stand->drive.kind == DriveKind::feedback && e.stand->element.exhaust.empty()))
      out.add("drive.kind", "a law with the model of a muscle", "pwm or pulses for a cylinder");
    return;
  }
  out.need("element.actuator", e.stand->element.actuator, e.actuators);
}

void check_load(const Experiment& e, Findings& out) {
  const Stand::Load& l = e.stand->load;
  if (l.mode == robot::Stand::Load::Mode::driven) {
    out.unused(l.mass > 0 || !l.weights.empty(), "load.mass", "mode = \"hanging\"");
    out.unused(l.force != 0 || !l.forces.empty(), "load.force", "mode = \"hanging\"");
    out.unused(e.stand->start_length > 0, "start.length", "mode = \"hanging\"");
    out.unused(e.stand->displacement != 0, "start.displacement", "mode = \"hanging\"");
  } else {
    out.unused(l.length > 0 || !l.lengths.empty(), "load.length", "mode = \"driven\"");
  }
  out.unused(l.mass > 0 && !l.weights.empty(), "load.mass", "a load without weights");
  out.unused(l.force != 0 && !l.forces.empty(), "load.force", "a load without forces");
  out.unused(l.length > 0 && !l.lengths.empty(), "load.length", "a load without lengths");
  const bool regulated = e.stand->charge.mode == robot::Stand::Charge::Mode::regulated;
  const bool prescribed = e.stand->charge.pressure > 0 || !e.stand->charge.pressures.empty();
  out.unused(!regulated && prescribed, "charge.pressure", "mode = \"regulated\"");
  out.unused(regulated && e.stand->start_pressure > 0, "start.pressure",
             "a charge that is not regulated");
}

// No clamp reaches further than the stand itself takes (run/setup/stand_setup.h), and a length at
// which the chamber holds no air has no pressure.
void check_volumes(const Experiment& e, Findings& out) {
  const auto check = [&](const std::string& key, double length) {
    for (const actuator::Actuator& a : e.actuators) {
      if (a.name != e.stand->element.actuator) continue;
      const double longest = 1.5 * a.braid.thread_length;
      const auto text = [&](double metres) {
        return config::quantity_like(e.origins, key, metres, "m", "in");
      };
      if (length > longest) {
        out.add(key, text(length), "at most " + text(longest) + ", 1.5 threads of the muscle",
                "a length that it can have");
        continue;
      }
      if (length > a.caps.length &&
          actuator::volume(a, length) + e.stand->element.external_volume > 0)
        continue;
      out.add(
          key, "a chamber without volume: the muscle is " + text(length) + " long",
          "above " + text(a.caps.length) + " and below the thread's " + text(a.braid.thread_length),
          "an element.external_volume above 0 where it is longer");
    }
  };
  if (e.stand->element.cylinder.bore > 0) return;
  if (e.stand->load.length > 0) check("load.length", e.stand->load.length);
  for (std::size_t i = 0; i < e.stand->load.lengths.size(); ++i)
    check("load.lengths[" + std::to_string(i) + "].length", e.stand->load.lengths[i].value);
  if (e.stand->start_length > 0) check("start.length", e.stand->start_length);
}

// More memory than there is, for a typing error.
void check_samples(const Experiment& e, Findings& out) {
  constexpr double most = 2'000'000;  // samples
  const double period = e.stand->sweep.step > 0 ? e.stand->duration : e.log.period;
  if (e.stand->duration > most * period)
    out.add("log.period", config::format_number(e.stand->duration / period) + " samples",
            "at most 2000000", "a longer period");
}

void check_law(const Experiment& e, Findings& out) {
  const Stand::Drive& d = e.stand->drive;
  const bool law = d.kind == DriveKind::feed_forward || d.kind == DriveKind::feedback;
  if (law && d.lengths.empty() && !(d.desired > 0))
    out.add("drive.desired", "none", "a length", "desired = \"2.9 in\"");
  out.unused(!law && (d.desired > 0 || !d.lengths.empty()), "drive.desired",
             "kind = \"feed-forward\" or \"feedback\"");
  out.unused(!law && d.believed_load != 0, "drive.believed_load", "kind = \"feed-forward\"");
  out.unused(d.kind != DriveKind::feedback && !d.sensor.empty(), "drive.sensor",
             "kind = \"feedback\"");
  out.unused(d.kind != DriveKind::feedback && (d.gain > 0 || d.dead_band > 0), "drive.gain",
             "kind = \"feedback\"");
  if (d.kind != DriveKind::feedback) return;
  out.need("drive.sensor", d.sensor, e.stand->sensors);
  for (const robot::Transducer& t : e.stand->sensors)
    if (t.name == d.sensor && t.of != robot::Transducer::Of::length)
      out.add("drive.sensor", "another quantity", "a sensor of the length");
  if (d.law == Stand::Drive::Law::proportional && !(d.gain > 0))
    out.add("drive.gain", "none", "a duty per length", "gain = \"5 1/in\"");
}

void check_faults_of_stand(const Experiment& e, Findings& out) {
  if (e.faults.empty()) return;
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::regulated) {
    out.add("fault", "a list of faults",
            "none: the pressure is prescribed, and nothing that breaks would change it",
            "charge.mode = \"sealed\" or \"valves\"");
    return;
  }
  check_faults(e.faults, fault_parts(e), out.list());
}

// A period gives a valve one opening (control/joint/command.h).
void check_pulses(const Stand::Drive& d, Findings& out) {
  const auto ticks = [](double seconds) { return std::llround(seconds / signals::tick_seconds); };
  std::set<std::tuple<bool, bool, std::int64_t>> edges;  // of which valve, opens, in which period
  for (std::size_t i = 0; i < d.pulses.size(); ++i) {
    const Stand::Drive::Pulse& p = d.pulses[i];
    const std::int64_t from = ticks(p.at), until = from + ticks(p.open), period = ticks(d.period);
    const bool begins = edges.insert({p.exhaust, true, from / period}).second;
    const bool ends = edges.insert({p.exhaust, false, until / period}).second;
    if (!begins || !ends)
      out.add("drive.pulses[" + std::to_string(i) + "]",
              std::string("a second pulse of the ") + (p.exhaust ? "exhaust" : "inlet") +
                  " in one drive.period, " + config::format_number(d.period) + " s",
              "at most one that begins and one that ends", "a shorter drive.period");
  }
}

void check_drive(const Experiment& e, Findings& out) {
  const Stand::Drive& d = e.stand->drive;
  if (!whole_ticks(d.period)) out.add("drive.period", "no whole ticks", "a multiple of 0.1 ms");
  if (!whole_ticks(e.log.period)) out.add("log.period", "no whole ticks", "a multiple of 0.1 ms");
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::valves && d.kind == DriveKind::none)
    out.add("drive.kind", "none", "what opens the valves", "charge.mode = \"sealed\"");
  if (e.stand->measured.from >= e.stand->duration)
    out.add("measured.from", "no row before the end", "less than duration");
  out.unused(d.kind != DriveKind::pwm && (d.duty > 0 || !d.duties.empty()), "drive.duty",
             "kind = \"pwm\"");
  out.unused(d.kind != DriveKind::pulses && !d.pulses.empty(), "drive.pulses", "kind = \"pulses\"");
  if (d.kind == DriveKind::pulses && d.pulses.empty())
    out.add("drive.pulses", "none", "at least one", "[[drive.pulses]]");
  for (const signals::Schedule::Point& p : d.duties)
    if (!(p.value >= 0 && p.value <= 1)) out.add("drive.duties", "no share", "0 to 100 %");
  check_pulses(d, out);
  if (static_cast<double>(e.stand->sensors.size()) + 2 > d.period / signals::tick_seconds)
    out.add("sensor", std::to_string(e.stand->sensors.size()), "fewer than the period has ticks");
  if (e.stand->sensors.size() > static_cast<std::size_t>(robot::board_channels))
    out.add("sensor", std::to_string(e.stand->sensors.size()),
            "at most " + std::to_string(robot::board_channels) + ", the channels of a board");
  check_law(e, out);
  if (!(e.stand->sweep.step > 0)) return;
  if (d.kind != DriveKind::pwm) out.add("sweep", "another drive", "drive.kind = \"pwm\"");
  if (!(e.stand->sweep.from < e.stand->sweep.to))
    out.add("sweep.to", "no more than from", "an ascending sweep");
  if (e.stand->duration < 5 * d.period)
    out.add("duration", "no five periods", "longer than the settling");
}

}  // namespace

void check_stand(const Experiment& e, std::vector<robot::Contradiction>& wrong) {
  Findings out(wrong);
  check_element(e, out);
  check_valves_of_stand(e, out);
  check_load(e, out);
  check_drive(e, out);
  check_faults_of_stand(e, out);
  check_samples(e, out);
  check_volumes(e, out);
}

}  // namespace sinew::experiment
