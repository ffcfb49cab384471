#include "sinew/experiment/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/fault_parts.h"

namespace sinew::experiment {
namespace {

using What = Fault::What;
using List = std::vector<robot::Contradiction>;

constexpr double widest_seat = 1e-5;  // [m^2]

robot::Contradiction no_such_part(const std::string& key, const Fault& fault,
                                  const std::vector<FaultPart>& parts) {
  std::vector<std::string_view> names;
  for (const FaultPart& p : parts)
    if (has_word(p.kind, fault.what)) names.push_back(p.name);
  return {key + ".of", config::in_quotes(fault.of),
          names.empty() ? "a part that can be " + std::string(word_of(fault.what))
                        : config::either(names),
          config::closest_in_quotes(fault.of, names)};
}

robot::Contradiction wrong_word(const std::string& key, const Fault& fault, const FaultPart& part) {
  if (part.kind == FaultPart::Kind::regulator)
    return {key + ".of", config::in_quotes(fault.of) + ", a regulator",
            "a valve with a shutter, which can stick or leak", "a leak of its muscle"};
  if (part.kind == FaultPart::Kind::transducer)
    return {key + ".of", config::in_quotes(fault.of) + ", a transducer of the test stand",
            "a part of its air: only that breaks on a test stand",
            "sensor." + fault.of + ".offset, .scale or .noise"};
  std::vector<std::string_view> words;
  for (const FaultWord& w : words_of(part.kind)) words.push_back(w.text);
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

void check_overlaps(std::span<const Fault> faults, List& out) {
  const auto seconds = [](double t) { return config::format_number(t) + " s"; };
  for (std::size_t i = 0; i < faults.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Fault &a = faults[k], &b = faults[i];
      if (!same_part(a, b) || end_of(a) <= b.at || end_of(b) <= a.at) continue;
      const bool ends = std::isfinite(a.lasts) && a.at <= b.at;
      out.push_back({fmt::format("fault[{}].at", i), seconds(b.at),
                     fmt::format("a time at which no other fault of {} acts: fault[{}] is {} ",
                                 b.of, k, in_words(a)),
                     ends ? fmt::format("at = \"{}\"", seconds(end_of(a))) : ""});
    }
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

void check_faults(std::span<const Fault> faults, const std::vector<FaultPart>& parts, List& out) {
  const std::size_t before = out.size();
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const Fault& f = faults[i];
    const std::string key = fmt::format("fault[{}]", i);
    const std::optional<FaultPart> part = part_of(f, parts);
    if (!part) {
      out.push_back(no_such_part(key, f, parts));
    } else if (!has_word(part->kind, f.what)) {
      out.push_back(wrong_word(key, f, *part));
    } else if (part->kind == FaultPart::Kind::muscle && f.share > 0) {
      out.push_back({key + ".share", config::format_number(f.share),
                     "no share, as " + f.of + " is a muscle and has no seat",
                     "an area or a conductance"});
    } else if (part->kind == FaultPart::Kind::valve && f.area > widest_seat) {
      out.push_back({key + ".area", config::format_quantity(f.area, "m2", "mm2"),
                     "at most " + config::format_quantity(widest_seat, "m2", "mm2") +
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

}  // namespace sinew::experiment
