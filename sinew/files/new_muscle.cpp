#include "sinew/files/new_muscle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/write/toml_text.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/units/constants.h"

namespace sinew::files {

namespace {

// Holds what the rest of the robot has to know of the muscle.
struct Muscle {
  std::string name;
  double mount = 0;     // [m]
  double arm = 0;       // [m]
  double tension = 0;   // the largest  [N]
  double pressure = 0;  // the highest, gauge  [Pa]
};

// As far as the plan of a new experiment goes from the rest angle: it takes half of the way that
// the muscle has to either side.
constexpr double planned = 20 * std::numbers::pi / 180;  // [rad]
constexpr double share_of_way = 0.5;
constexpr double template_supply = 100 * units::psi;  // gauge [Pa]
constexpr double converter_range = 5;                 // [V]

Muscle muscle_of(const std::string& file) {
  const std::string kind(config::format_kind(config::compose(file)));
  if (kind != "actuator")
    config::fail({file, 0, 0}, "", fmt::format("format = \"sinew.{}/1\"", kind),
                 "an actuator's file, format = \"sinew.actuator/1\"",
                 "sinew identify static, which writes one from forces that you measured");
  const auto machine = experiment::load_machine_file(file);
  const actuator::Actuator& a = machine.experiment.actuators.front();
  const double shortest = std::max(actuator::shortest_length(a), a.bladder.valid_from);
  const double longest = std::min(a.long_end.length, a.bladder.valid_to);
  Muscle m{.name = a.name, .mount = 0.5 * (shortest + longest)};
  m.arm = share_of_way * 0.5 * (longest - shortest) / planned;
  m.pressure = std::min(template_supply, a.effectiveness.valid_to);
  const gas::Air& air = machine.experiment.air;
  m.tension = actuator::operating_point(a, longest, m.pressure,
                                        {air.atmosphere, air.polytropic_exponent, 0})
                  .tension;
  return m;
}

// The line on which `key` stands alone, from `from` on; npos: there is none.
std::size_t line_of(const std::string& text, std::string_view key, std::size_t from = 0) {
  for (std::size_t at = text.find(key, from); at != text.npos; at = text.find(key, at + 1)) {
    const bool begins = at == 0 || text[at - 1] == '\n';
    const char after = text[at + key.size()];
    if (begins && (after == ' ' || after == '=')) return at;
  }
  return text.npos;
}

// Every line of `key` gets `value`; what is aligned stays so.
void set(std::string& text, std::string_view key, const std::string& value) {
  for (std::size_t at = line_of(text, key); at != text.npos; at = line_of(text, key, at + 1)) {
    const std::size_t equals = text.find("= ", at) + 2, end = text.find('\n', at);
    text.replace(equals, end - equals, value);
  }
}

void remove(std::string& text, std::string_view key) {
  for (std::size_t at = line_of(text, key); at != text.npos; at = line_of(text, key, at))
    text.erase(at, text.find('\n', at) + 1 - at);
}

std::string guessed(const std::string& value, std::string_view source) {
  return fmt::format("{{ value = \"{}\", guess = true, source = \"{}\" }}", value, source);
}

// Three digits are as much as a guess is worth.
std::string rounded(double value, std::string_view unit) {
  const double digit = std::pow(10, std::floor(std::log10(std::max(value, 1e-9))) - 2);
  return fmt::format("{:g} {}", std::round(value / digit) * digit, unit);
}

}  // namespace

std::string with_muscle(std::string text, const std::string& file, const std::string& reference,
                        bool metric) {
  const Muscle m = muscle_of(file);
  const auto length = [metric](double si) {
    return metric ? rounded(si * 1e3, "mm") : rounded(si / units::inch, "in");
  };
  const std::string cell =
      metric ? rounded(converter_range / (1.1 * m.tension), "V/N")
             : rounded(converter_range / (1.1 * m.tension / units::pound_force), "V/lbf");
  const std::string supply = metric ? rounded(m.pressure / units::bar, "bar gauge")
                                    : rounded(m.pressure / units::psi, "psi gauge");

  set(text, "files",
      fmt::format("{{ actuator = {}, valves = \"valves.toml\" }}   # the muscle "
                  "that you identified, and valves",
                  reference));
  set(text, "actuator", config::toml_string(m.name));
  set(text, "mount_length",
      guessed(length(m.mount), "replace: half way between the lengths that the muscle knows"));
  set(text, "moment_arm",
      guessed(length(m.arm), "replace: 20 deg take half of the way that the muscle has there"));
  for (const std::string_view key : {"bladder_stiffness", "bladder_rest_length"}) remove(text, key);
  const auto replace_in_line = [&text](std::string_view key, std::string_view begin,
                                       const std::string& with) {
    for (std::size_t at = line_of(text, key); at != text.npos; at = line_of(text, key, at + 1)) {
      const std::size_t line_end = text.find('\n', at), from = text.find(begin, at);
      if (from > line_end) continue;
      const std::size_t value = text.find('"', from) + 1;
      const std::string_view old(text.data() + value, text.find('"', value) - value);
      const bool is_cell = old.ends_with("V/lbf") || old.ends_with("V/N");
      if (key == "supply" || is_cell) text.replace(value, old.size(), with);
    }
  };
  for (const std::string_view key : {"real", "assumed"}) replace_in_line(key, "scale", cell);
  replace_in_line("supply", "pressure = { value", supply);
  return text;
}

}  // namespace sinew::files
