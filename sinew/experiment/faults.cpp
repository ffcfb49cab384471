#include "sinew/experiment/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "sinew/actuator/braid.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/joint_controllers.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::experiment {
namespace {

using What = Fault::What;
using List = std::vector<robot::Contradiction>;

constexpr double widest_seat = 1e-5;  // [m^2]

struct Word {
  What what;
  std::string_view text;
};
constexpr std::array sensor_words = {Word{What::open, "open"},      Word{What::shorted, "short"},
                                     Word{What::stuck, "stuck"},    Word{What::offset, "offset"},
                                     Word{What::slip, "slip"},      Word{What::noise, "noise"},
                                     Word{What::dropout, "dropout"}};
constexpr std::array valve_words = {Word{What::stuck_open, "stuck open"},
                                    Word{What::stuck_shut, "stuck shut"},
                                    Word{What::leaking, "leaking"}};
constexpr std::array muscle_words = {Word{What::leaking, "leaking"},
                                     Word{What::ruptured, "ruptured"},
                                     Word{What::blocked, "blocked"}};
constexpr std::array supply_words = {Word{What::failed, "failed"}};

// A thing that can break.
struct Part {
  enum class Kind { sensor, valve, regulator, muscle, supply };
  std::string name;
  Kind kind = Kind::sensor;
  int index = 0;  // of its kind; valves as muscle/plumbing.h numbers them
};

std::span<const Word> words_of(Part::Kind kind) {
  using enum Part::Kind;
  if (kind == sensor) return sensor_words;
  if (kind == valve) return valve_words;
  if (kind == muscle) return muscle_words;
  return kind == supply ? std::span<const Word>(supply_words) : std::span<const Word>();
}

bool has_word(Part::Kind kind, What what) {
  return std::ranges::any_of(words_of(kind), [&](const Word& w) { return w.what == what; });
}

std::string_view word_of(What what) {
  for (const auto kind : {Part::Kind::sensor, Part::Kind::valve, Part::Kind::muscle})
    for (const Word& w : words_of(kind))
      if (w.what == what) return w.text;
  return supply_words.front().text;
}

Part::Kind kind_of_valve(const Experiment& e, const std::string& valve) {
  for (const gas::Valve& v : e.valves)
    if (v.name == valve && v.kind == gas::Valve::Kind::regulator) return Part::Kind::regulator;
  return Part::Kind::valve;
}

std::vector<Part> parts_of(const Experiment& e) {
  std::vector<Part> out;
  const auto add = [&](std::string name, Part::Kind kind, std::size_t index) {
    out.push_back({std::move(name), kind, static_cast<int>(index)});
  };
  const auto add_pair = [&](const std::string& of, const std::string& inlet,
                            const std::string& exhaust, std::size_t index) {
    add(of + ".inlet", kind_of_valve(e, inlet), index);
    if (!exhaust.empty()) add(of + ".exhaust", kind_of_valve(e, exhaust), index + 1);
  };
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s)
    add(e.robot.sensors[s].name, Part::Kind::sensor, s);
  const std::size_t muscles = e.robot.muscles.size();
  for (std::size_t m = 0; m < muscles; ++m) {
    const robot::Muscle& muscle = e.robot.muscles[m];
    add(muscle.name, Part::Kind::muscle, m);
    add_pair(muscle.name, muscle.inlet, muscle.exhaust, 2 * m);
  }
  const robot::Cylinder& c = e.robot.cylinder;
  if (has_cylinder_joint(e.robot)) {
    add_pair("cylinder_up", c.up.inlet, c.up.exhaust, 2 * muscles);
    add_pair("cylinder_down", c.down.inlet, c.down.exhaust, 2 * muscles + 2);
  }
  add("supply", Part::Kind::supply, 0);
  return out;
}

// Returns the part of that name, of several the one that the fault's word is for.
std::optional<Part> part_of(const Fault& fault, const std::vector<Part>& parts) {
  std::optional<Part> out;
  for (const Part& p : parts)
    if (p.name == fault.of && (!out || has_word(p.kind, fault.what))) out = p;
  return out;
}

robot::Contradiction no_such_part(const std::string& key, const Fault& fault,
                                  const std::vector<Part>& parts) {
  std::vector<std::string_view> names;
  for (const Part& p : parts)
    if (has_word(p.kind, fault.what)) names.push_back(p.name);
  return {key + ".of", config::in_quotes(fault.of),
          names.empty() ? "a part that can be " + std::string(word_of(fault.what))
                        : config::either(names),
          config::closest_in_quotes(fault.of, names)};
}

robot::Contradiction wrong_word(const std::string& key, const Fault& fault, const Part& part) {
  if (part.kind == Part::Kind::regulator)
    return {key + ".of", config::in_quotes(fault.of) + ", a regulator",
            "a valve with a shutter, which can stick or leak", "a leak of its muscle"};
  std::vector<std::string_view> words;
  for (const Word& w : words_of(part.kind)) words.push_back(w.text);
  const char* const names[] = {"a sensor", "a valve", "a regulator", "a muscle", "the supply"};
  return {key + ".what", config::in_quotes(word_of(fault.what)),
          config::either(words) + ", as " + fault.of + " is " +
              names[static_cast<std::size_t>(part.kind)],
          ""};
}

// Faults of the air that would contradict each other are those of one part; a muscle's hose is not
// its wall.
bool same_part(const Fault& a, const Fault& b) {
  return !is_of_sensor(a.what) && !is_of_sensor(b.what) && a.of == b.of &&
         (a.what == What::blocked) == (b.what == What::blocked);
}

double end_of(const Fault& f) {
  return std::isfinite(f.lasts) ? f.at + f.lasts : std::numeric_limits<double>::infinity();
}

void check_overlaps(const Experiment& e, List& out) {
  const auto seconds = [](double t) { return config::format_number(t) + " s"; };
  for (std::size_t i = 0; i < e.faults.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Fault &a = e.faults[k], &b = e.faults[i];
      if (!same_part(a, b) || end_of(a) <= b.at || end_of(b) <= a.at) continue;
      const bool ends = std::isfinite(a.lasts) && a.at <= b.at;
      out.push_back({fmt::format("fault[{}].at", i), seconds(b.at),
                     fmt::format("a time at which no other fault of {} acts: fault[{}] is {} ",
                                 b.of, k, in_words(a)),
                     ends ? fmt::format("at = \"{}\"", seconds(end_of(a))) : ""});
    }
}

// Returns a tenth of the cross-section of one actuator at its mount length: a tear that the braid
// holds together, a guess  [m^2].
double tear_of(const Experiment& e, const robot::Muscle& m) {
  const actuator::Actuator a = robot::actuator_of(m, e.actuators);
  const double d = actuator::diameter(a.braid, m.mount_length - a.caps.length);
  return 0.1 * (0.25 * std::numbers::pi * d * d);
}

double or_none(double x) { return std::isfinite(x) ? x : 0.0; }

air::AirFault air_fault(const Experiment& e, const Fault& f, const Part& part) {
  using To = air::AirFault::What;
  air::AirFault out{.of = part.index,
                    .begin = f.at,
                    .end = end_of(f),
                    .share = f.share,
                    .leak = {.area = or_none(f.area), .conductance = f.conductance}};
  if (f.what == What::stuck_shut) out.what = To::stuck_shut;
  if (f.what == What::leaking) out.what = part.kind == Part::Kind::valve ? To::seat_leak : To::hole;
  if (f.what == What::blocked) out.what = To::blocked;
  if (f.what == What::failed) {
    out.what = To::supply;
    out.pressure = std::isfinite(f.pressure) ? f.pressure : e.air.atmosphere;
  }
  if (f.what == What::ruptured) {
    out.what = To::hole;
    if (!(f.area > 0))
      out.leak.area = tear_of(e, e.robot.muscles[static_cast<std::size_t>(part.index)]);
  }
  return out;
}

// The first tick from `at` on at which the sensor is read.
signals::Tick next_reading(const Experiment& e, const std::string& sensor, double at) {
  const auto index = static_cast<std::size_t>(robot::find_sensor(e.robot, sensor));
  const signals::Tick period = e.robot.low_level.pwm_ticks;
  const auto first = static_cast<signals::Tick>(std::ceil(at / signals::tick_seconds - 1e-9));
  const signals::Tick phase = e.robot.sensors[index].tick;
  const signals::Tick wait = (phase - first % period + period) % period;
  return first + wait;
}

}  // namespace

void check_faults(const Experiment& e, List& out) {
  const std::vector<Part> parts = parts_of(e);
  std::size_t of_air = 0;
  for (std::size_t i = 0; i < e.faults.size(); ++i) {
    const Fault& f = e.faults[i];
    const std::string key = fmt::format("fault[{}]", i);
    const std::optional<Part> part = part_of(f, parts);
    if (!part) {
      out.push_back(no_such_part(key, f, parts));
    } else if (!has_word(part->kind, f.what)) {
      out.push_back(wrong_word(key, f, *part));
    } else if (part->kind == Part::Kind::muscle && f.share > 0) {
      out.push_back({key + ".share", config::format_number(f.share),
                     "no share, as " + f.of + " is a muscle and has no seat",
                     "an area or a conductance"});
    } else if (part->kind == Part::Kind::valve && f.area > widest_seat) {
      out.push_back({key + ".area", config::format_quantity(f.area, "m2", "mm2"),
                     "at most " + config::format_quantity(widest_seat, "m2", "mm2") +
                         ", as no seat of a valve is wider",
                     "share = \"100 %\""});
    } else if (part->kind == Part::Kind::supply && e.robot.cylinder.present &&
               e.robot.cylinder.mode == robot::Cylinder::Mode::regulator) {
      out.push_back({key + ".of", "the supply of a cylinder behind a regulator",
                     "a robot whose cylinder has valves or is locked",
                     "cylinder.mode = \"locked\""});
    }
    of_air += is_of_sensor(f.what) ? 0 : 1;
  }
  if (of_air > air::FaultSchedule::capacity)
    out.push_back({"fault", std::to_string(of_air) + " faults of the air",
                   fmt::format("at most {}", air::FaultSchedule::capacity), "fewer"});
  if (out.empty()) check_overlaps(e, out);
}

std::vector<air::AirFault> air_faults(const Experiment& e) {
  const std::vector<Part> parts = parts_of(e);
  std::vector<air::AirFault> out;
  for (const Fault& f : e.faults)
    if (const auto part = part_of(f, parts); part && !is_of_sensor(f.what))
      out.push_back(air_fault(e, f, *part));
  return out;
}

std::string topic_of(const Fault& f) {
  if (is_of_sensor(f.what)) return "/true/sensor/" + f.of + "/fault";
  if (f.what == What::failed) return "/true/supply/fault";
  if (f.what == What::blocked) return "/true/hose/" + f.of + "/fault";
  const std::size_t dot = f.of.rfind('.');
  if (dot == f.of.npos) return "/true/muscle/" + f.of + "/fault";
  return "/true/valve/" + f.of.substr(0, dot) + "/" + f.of.substr(dot + 1) + "/fault";
}

std::string in_words(const Fault& f) {
  std::vector<std::string> how;
  if (std::isfinite(f.amount))
    how.push_back(unit_of_amount(f.what) == "count" ? config::format_number(f.amount) + " count"
                                                    : config::format_number(100 * f.amount) + " %");
  if (f.area > 0) how.push_back(config::format_quantity(f.area, "m2", "mm2"));
  if (f.conductance > 0) how.push_back(config::format_quantity(f.conductance, "kg/(s Pa)"));
  if (f.share > 0) how.push_back(config::format_number(100 * f.share) + " % of its area");
  if (std::isfinite(f.pressure)) how.push_back(config::format_quantity(f.pressure, "Pa abs"));
  std::string out = f.of + " " + std::string(word_of(f.what));
  if (!how.empty()) out += fmt::format(" ({})", fmt::join(how, ", "));
  out += fmt::format(" from {:.10g} s", f.at);
  return out + (std::isfinite(f.lasts) ? fmt::format(" to {:.10g} s", end_of(f)) : " on");
}

std::string why_idle(const Experiment& e, const Fault& f, signals::Tick end) {
  const double ends = static_cast<double>(end) * signals::tick_seconds;
  if (f.at > ends)
    return fmt::format("it begins at {:.6g} s, the run ends at {:.4f} s", f.at, ends);
  if (f.amount == 0) return "its amount is 0";
  if (!is_of_sensor(f.what) || robot::find_sensor(e.robot, f.of) < 0) return "";
  const signals::Tick reading = next_reading(e, f.of, f.at);
  if (reading <= end && acts(f, static_cast<double>(reading) * signals::tick_seconds)) return "";
  return fmt::format("it falls between two readings of {}, the later one at {:.4f} s", f.of,
                     static_cast<double>(reading) * signals::tick_seconds);
}

}  // namespace sinew::experiment
