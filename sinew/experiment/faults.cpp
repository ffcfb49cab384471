#include "sinew/experiment/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/control/gait/plan.h"
#include "sinew/robot/boards.h"
#include "sinew/units/quantity.h"

namespace sinew::experiment {

namespace {

using What = Fault::What;

constexpr std::array sensor_faults = {
    FaultName{What::open, "open"},      FaultName{What::shorted, "short"},
    FaultName{What::stuck, "stuck"},    FaultName{What::offset, "offset"},
    FaultName{What::slip, "slip"},      FaultName{What::noise, "noise"},
    FaultName{What::dropout, "dropout"}};
constexpr std::array valve_faults = {FaultName{What::stuck_open, "stuck open"},
                                     FaultName{What::stuck_shut, "stuck shut"},
                                     FaultName{What::leaking, "leaking"}};
constexpr std::array muscle_faults = {FaultName{What::leaking, "leaking"},
                                      FaultName{What::ruptured, "ruptured"},
                                      FaultName{What::blocked, "blocked"}};
constexpr std::array supply_faults = {FaultName{What::failed, "failed"}};

}  // namespace

FaultPart::Kind kind_of_valve(std::span<const gas::Valve> valves, const std::string& name) {
  for (const gas::Valve& v : valves)
    if (v.name == name && v.kind == gas::Valve::Kind::regulator) return FaultPart::Kind::regulator;
  return FaultPart::Kind::valve;
}

std::span<const FaultName> faults_of(FaultPart::Kind kind) {
  using enum FaultPart::Kind;
  if (kind == sensor) return sensor_faults;
  if (kind == valve) return valve_faults;
  if (kind == muscle) return muscle_faults;
  return kind == supply ? std::span<const FaultName>(supply_faults) : std::span<const FaultName>();
}

bool can_have(FaultPart::Kind kind, What what) {
  return std::ranges::any_of(faults_of(kind), [&](const FaultName& w) { return w.what == what; });
}

std::string_view name_of(What what) {
  for (const auto kind : {FaultPart::Kind::sensor, FaultPart::Kind::valve, FaultPart::Kind::muscle})
    for (const FaultName& w : faults_of(kind))
      if (w.what == what) return w.text;
  return supply_faults.front().text;
}

namespace {

// Returns the element's muscle as "bpa", with valves also "bpa.inlet", "bpa.exhaust" and "supply";
// and the stand's transducers, so that faults of these can be refused by name. Returns nothing if
// the pressure is prescribed: faults would not change it.
std::vector<FaultPart> parts_of_stand(const Experiment& e) {
  using Kind = FaultPart::Kind;
  const Stand::Element& element = e.stand->element;
  std::vector<FaultPart> out;
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::regulated) return out;
  if (!(element.cylinder.bore > 0)) out.push_back({element.name, Kind::muscle, 0});
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::valves) {
    const auto add = [&](const char* which, const std::string& valve, int index) {
      if (!valve.empty())
        out.push_back({element.name + which, kind_of_valve(e.valves, valve), index});
    };
    add(".inlet", element.inlet, 0);
    add(".exhaust", element.exhaust, 1);
    out.push_back({"supply", Kind::supply, 0});
  }
  for (const robot::Transducer& t : e.stand->sensors) out.push_back({t.name, Kind::transducer, 0});
  return out;
}

}  // namespace

std::vector<FaultPart> fault_parts(const Experiment& e) {
  if (e.stand) return parts_of_stand(e);
  std::vector<FaultPart> out;
  const auto add = [&](std::string name, FaultPart::Kind kind, std::size_t index) {
    out.push_back({std::move(name), kind, static_cast<int>(index)});
  };
  const auto add_pair = [&](const std::string& of, const std::string& inlet,
                            const std::string& exhaust, std::size_t index) {
    add(of + ".inlet", kind_of_valve(e.valves, inlet), index);
    if (!exhaust.empty()) add(of + ".exhaust", kind_of_valve(e.valves, exhaust), index + 1);
  };
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s)
    add(e.robot.sensors[s].name, FaultPart::Kind::sensor, s);
  const std::size_t muscles = e.robot.muscles.size();
  for (std::size_t m = 0; m < muscles; ++m) {
    const robot::Muscle& muscle = e.robot.muscles[m];
    add(muscle.name, FaultPart::Kind::muscle, m);
    add_pair(muscle.name, muscle.inlet, muscle.exhaust, 2 * m);
  }
  const robot::Cylinder& c = e.robot.cylinder;
  if (robot::has_cylinder_joint(e.robot)) {
    add_pair("cylinder_up", c.up.inlet, c.up.exhaust, 2 * muscles);
    add_pair("cylinder_down", c.down.inlet, c.down.exhaust, 2 * muscles + 2);
  }
  add("supply", FaultPart::Kind::supply, 0);
  return out;
}

std::optional<FaultPart> part_of(const Fault& fault, const std::vector<FaultPart>& parts) {
  std::optional<FaultPart> out;
  for (const FaultPart& p : parts)
    if (p.name == fault.of && (!out || can_have(p.kind, fault.what))) out = p;
  return out;
}

namespace {

using List = std::vector<robot::Contradiction>;

constexpr double widest_seat = 1e-5;  // [m^2]

robot::Contradiction no_such_part(const std::string& key, const Fault& fault,
                                  const std::vector<FaultPart>& parts) {
  std::vector<std::string_view> names;
  for (const FaultPart& p : parts)
    if (can_have(p.kind, fault.what)) names.push_back(p.name);
  return {key + ".of", config::in_quotes(fault.of),
          names.empty() ? "a part that can be " + std::string(name_of(fault.what))
                        : config::either(names),
          config::closest_in_quotes(fault.of, names)};
}

robot::Contradiction impossible_fault(const std::string& key, const Fault& fault,
                                      const FaultPart& part) {
  if (part.kind == FaultPart::Kind::regulator)
    return {key + ".of", config::in_quotes(fault.of) + ", a regulator",
            "a valve with a shutter, which can stick or leak", "a leak of its muscle"};
  if (part.kind == FaultPart::Kind::transducer)
    return {key + ".of", config::in_quotes(fault.of) + ", a transducer of the test stand",
            "a part of its air: only that breaks on a test stand",
            "sensor." + fault.of + ".offset, .scale or .noise"};
  std::vector<std::string_view> words;
  for (const FaultName& w : faults_of(part.kind)) words.push_back(w.text);
  const char* const names[] = {"a sensor", "a valve", "a regulator", "a muscle", "the supply"};
  return {key + ".what", config::in_quotes(name_of(fault.what)),
          config::either(words) + ", as " + fault.of + " is " +
              names[static_cast<std::size_t>(part.kind)],
          ""};
}

// Returns whether two faults of the air concern the same part, so that they would contradict each
// other. A muscle's hose and its wall are separate parts.
bool same_part(const Fault& a, const Fault& b) {
  return !is_of_sensor(a.what) && !is_of_sensor(b.what) && a.of == b.of &&
         (a.what == What::blocked) == (b.what == What::blocked);
}

void check_overlaps(std::span<const Fault> faults, List& out) {
  const auto seconds = [](double t) { return units::format_number(t) + " s"; };
  for (std::size_t i = 0; i < faults.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Fault &a = faults[k], &b = faults[i];
      if (!same_part(a, b) || end_of(a) <= b.at || end_of(b) <= a.at) continue;
      const bool ends = std::isfinite(a.lasts) && a.at <= b.at;
      out.push_back({fmt::format("fault[{}].at", i), seconds(b.at),
                     fmt::format("a time at which no other fault of {} acts: fault[{}] is {} ",
                                 b.of, k, to_text(a)),
                     ends ? fmt::format("at = \"{}\"", seconds(end_of(a))) : ""});
    }
}

// Returns the first tick from `at` on at which the sensor is read.
signals::Tick next_reading(const Experiment& e, const std::string& sensor, double at) {
  const auto index = static_cast<std::size_t>(robot::find_sensor(e.robot, sensor));
  const signals::Tick period = e.robot.low_level.pwm_ticks;
  const auto first = static_cast<signals::Tick>(std::ceil(at / signals::tick_seconds - 1e-9));
  const signals::Tick phase = e.robot.sensors[index].tick;
  const signals::Tick wait = (phase - first % period + period) % period;
  return first + wait;
}

}  // namespace

void check_faults(std::span<const Fault> faults, const std::vector<FaultPart>& parts, List& out) {
  const std::size_t before = out.size();
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const Fault& f = faults[i];
    const std::string key = fmt::format("fault[{}]", i);
    const std::optional<FaultPart> part = part_of(f, parts);
    if (!part) {
      out.push_back(no_such_part(key, f, parts));
    } else if (!can_have(part->kind, f.what)) {
      out.push_back(impossible_fault(key, f, *part));
    } else if (part->kind == FaultPart::Kind::muscle && f.share > 0) {
      out.push_back({key + ".share", units::format_number(f.share),
                     "no share, as " + f.of + " is a muscle and has no seat",
                     "an area or a conductance"});
    } else if (part->kind == FaultPart::Kind::valve && f.area > widest_seat) {
      out.push_back({key + ".area", units::format_quantity(f.area, "m2", "mm2"),
                     "at most " + units::format_quantity(widest_seat, "m2", "mm2") +
                         ", as no seat of a valve is wider",
                     "share = \"100 %\""});
    }
  }
  if (out.size() == before) check_overlaps(faults, out);
}

void check_faults(const Experiment& e, List& out) {
  check_faults(e.faults, fault_parts(e), out);
  const bool prescribed =
      e.robot.cylinder.present && e.robot.cylinder.mode == robot::Cylinder::Mode::regulator;
  for (std::size_t i = 0; prescribed && i < e.faults.size(); ++i)
    if (e.faults[i].what == What::failed)
      out.push_back({fmt::format("fault[{}].of", i), "the supply of a cylinder behind a regulator",
                     "a robot whose cylinder has valves or is locked",
                     "cylinder.mode = \"locked\""});
}

std::string topic_of(const Fault& f) {
  if (is_of_sensor(f.what)) return "/true/sensor/" + f.of + "/fault";
  if (f.what == What::failed) return "/true/supply/fault";
  if (f.what == What::blocked) return "/true/hose/" + f.of + "/fault";
  const std::size_t dot = f.of.rfind('.');
  if (dot == f.of.npos) return "/true/muscle/" + f.of + "/fault";
  return "/true/valve/" + f.of.substr(0, dot) + "/" + f.of.substr(dot + 1) + "/fault";
}

bool FaultsOfPart::acted(double time, double period) const {
  return std::ranges::any_of(
      faults, [&](const Fault& f) { return f.at <= time && !(time - period >= f.at + f.lasts); });
}

std::vector<FaultsOfPart> by_part(std::span<const Fault> faults) {
  std::vector<FaultsOfPart> out;
  for (const Fault& f : faults) {
    const std::string topic = topic_of(f);
    auto part = std::ranges::find(out, topic, &FaultsOfPart::topic);
    if (part == out.end()) part = out.insert(out.end(), {topic, {}});
    part->faults.push_back(f);
  }
  return out;
}

std::string to_text(const Fault& f) {
  std::vector<std::string> how;
  if (std::isfinite(f.amount))
    how.push_back(unit_of_amount(f.what) == "count" ? units::format_number(f.amount) + " count"
                                                    : units::format_number(100 * f.amount) + " %");
  if (f.area > 0) how.push_back(units::format_quantity(f.area, "m2", "mm2"));
  if (f.conductance > 0) how.push_back(units::format_quantity(f.conductance, "kg/(s Pa)"));
  if (f.share > 0) how.push_back(units::format_number(100 * f.share) + " % of its area");
  if (std::isfinite(f.pressure)) how.push_back(units::format_quantity(f.pressure, "Pa abs"));
  std::string out = f.of + " " + std::string(name_of(f.what));
  if (!how.empty()) out += fmt::format(" ({})", fmt::join(how, ", "));
  out += fmt::format(" from {:.10g} s", f.at);
  return out + (std::isfinite(f.lasts) ? fmt::format(" to {:.10g} s", end_of(f)) : " on");
}

std::string why_idle(const Fault& f, signals::Tick end) {
  const double ends = static_cast<double>(end) * signals::tick_seconds;
  if (f.at > ends)
    return fmt::format("it begins at {:.6g} s, the run ends at {:.4f} s", f.at, ends);
  return f.amount == 0 ? "its amount is 0" : "";
}

std::string why_idle(const Experiment& e, const Fault& f, signals::Tick end) {
  if (std::string why = why_idle(f, end); !why.empty()) return why;
  if (!is_of_sensor(f.what) || robot::find_sensor(e.robot, f.of) < 0) return "";
  const signals::Tick reading = next_reading(e, f.of, f.at);
  if (reading <= end && acts(f, static_cast<double>(reading) * signals::tick_seconds)) return "";
  return fmt::format("it falls between two readings of {}, the later one at {:.4f} s", f.of,
                     static_cast<double>(reading) * signals::tick_seconds);
}

std::string why_idle(const Experiment& e, const gait::Change& change, double end) {
  if (e.stand) return "";
  const double period = e.plan.high_level_period;
  const double plan_ends = static_cast<double>(gait::periods(e.robot, e.plan)) * period;
  const double ends = std::min(end, plan_ends);
  // A change takes effect at the first start of a period at or after its time.
  if (period * std::ceil(change.time / period - 1e-9) < ends - 1e-9 * period) return "";
  return fmt::format("its time is {:.6g} s, the {} ends at {:.4f} s", change.time,
                     end < plan_ends ? "run" : "plan", ends);
}

}  // namespace sinew::experiment
