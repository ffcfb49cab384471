#include "sinew/identify/machine/machine_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/experiment.fields.h"
#include "sinew/units/each_field.h"

namespace sinew::identify {

namespace {

using experiment::Experiment;

constexpr std::array<std::string_view, 5> group_names = {"friction", "damping", "dead-time",
                                                         "volume", "leak"};

void friction_keys(const Experiment& e, std::vector<std::string>& out) {
  for (const robot::Joint& j : e.robot.joints)
    if (j.kind == robot::Joint::Kind::driven)
      out.push_back(fmt::format("joint.{}.dry_friction", j.name));
  if (e.robot.trolley.present) out.emplace_back("trolley.drag");
  if (e.robot.cylinder.present && e.robot.cylinder.mode != robot::Cylinder::Mode::locked)
    out.emplace_back("cylinder.friction");
}

void damping_keys(const Experiment& e, std::vector<std::string>& out) {
  for (const robot::Joint& j : e.robot.joints)
    if (j.kind == robot::Joint::Kind::driven)
      out.push_back(fmt::format("joint.{}.damping", j.name));
  if (e.robot.cylinder.present && e.robot.cylinder.mode != robot::Cylinder::Mode::locked)
    out.emplace_back("cylinder.damping");
}

void dead_time_keys(const Experiment& e, std::vector<std::string>& out) {
  for (const gas::Valve& v : e.valves) {
    const bool used = std::ranges::any_of(e.robot.muscles, [&](const robot::Muscle& m) {
      return m.inlet == v.name || m.exhaust == v.name;
    });
    if (!used || v.kind == gas::Valve::Kind::regulator || v.profile == gas::Valve::Profile::ideal)
      continue;
    const std::string of = fmt::format("valve.{}.{}", v.name,
                                       v.drive == gas::Valve::Drive::speed_up ? "speed_up." : "");
    out.push_back(of + "opening_delay");
    out.push_back(of + "closing_delay");
  }
}

void volume_keys(const Experiment& e, std::vector<std::string>& out) {
  for (const robot::Muscle& m : e.robot.muscles)
    out.push_back(fmt::format("muscle.{}.external_volume", m.name));
}

void leak_keys(const Experiment& e, std::vector<std::string>& out) {
  for (const robot::Muscle& m : e.robot.muscles)
    out.push_back(
        fmt::format("muscle.{}.leak.{}", m.name, m.leak.area > 0 ? "area" : "conductance"));
}

std::vector<std::string> keys_of_group(std::string_view group, const Experiment& e) {
  std::vector<std::string> out;
  if (group == "friction") friction_keys(e, out);
  if (group == "damping") damping_keys(e, out);
  if (group == "dead-time") dead_time_keys(e, out);
  if (group == "volume") volume_keys(e, out);
  if (group == "leak") leak_keys(e, out);
  return out;
}

[[noreturn]] void refuse_word(const std::string& word, const std::vector<MachineNumber>& numbers) {
  std::vector<std::string_view> known(group_names.begin(), group_names.end());
  for (const MachineNumber& n : numbers) known.push_back(n.key);
  config::fail({"fit", 0, 0}, "", config::in_quotes(word),
               fmt::format("a number's key of this robot, or {}", fmt::join(group_names, ", ")),
               config::closest_in_quotes(word, known));
}

}  // namespace

std::vector<MachineNumber> machine_numbers(Experiment e) {
  std::vector<MachineNumber> out;
  units::EachField visitor([&](const units::VisitedField& f) {
    const bool of_list = f.path.find('[') != f.path.npos;
    if (f.number && !of_list)
      out.push_back(
          {std::string(f.path), std::string(f.field.unit), f.field.min, f.field.max, *f.number});
  });
  experiment::machine_fields(visitor, e);
  visitor.group({.name = "start"}, [&](auto& g) { experiment::fields(g, e.start); });
  return out;
}

std::vector<std::string> machine_keys(const Experiment& e,
                                      const std::vector<std::string>& requested) {
  const std::vector<MachineNumber> numbers = machine_numbers(e);
  std::vector<std::string> out;
  const auto add = [&](const std::string& key) {
    if (std::ranges::find(out, key) == out.end()) out.push_back(key);
  };
  if (requested.empty())
    for (const std::string_view group : group_names)
      for (const std::string& key : keys_of_group(group, e)) add(key);
  for (const std::string& word : requested) {
    if (std::ranges::find(group_names, word) != group_names.end()) {
      const std::vector<std::string> keys = keys_of_group(word, e);
      if (keys.empty())
        config::fail({"fit", 0, 0}, "", config::in_quotes(word) + ", of which this robot has none",
                     "a group with keys of this robot", "its keys by name");
      for (const std::string& key : keys) add(key);
    } else if (std::ranges::find(numbers, word, &MachineNumber::key) != numbers.end()) {
      add(word);
    } else {
      refuse_word(word, numbers);
    }
  }
  return out;
}

double machine_scale(const Experiment& e, const MachineNumber& number) {
  if (number.unit == "rad") return 0.1;
  const double value = std::abs(number.value);
  if (value > 0 && std::isfinite(value)) return value;
  // A leak that empties ten cubic centimetres in about two minutes, as conductance or as area.
  constexpr double volume = 1e-5, time = 100;
  const double conductance = volume / (287.0 * e.air.temperature * time);
  if (number.key.ends_with("leak.conductance")) return conductance;
  if (number.key.ends_with("leak.area")) return conductance * 400;
  if (number.unit == "s") return 1e-3;
  if (number.unit == "m3") return 1e-6;
  if (number.unit == "N m" || number.unit == "N m s/rad") return 0.02;
  if (number.unit == "m") return 1e-3;
  return 1;
}

}  // namespace sinew::identify
