#include "sinew/analysis/absent.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "sinew/analysis/record/legs.h"
#include "sinew/config/diagnostics.h"
#include "sinew/robot/legs.h"

namespace sinew::analysis {

namespace {

using units::Mistake;
using Names = std::vector<std::string>;

// Splits "a.b.c" into "a" and "b.c".
struct Split {
  std::string_view first, rest;
};

Split split(std::string_view key) {
  const std::size_t dot = key.find('.');
  return {key.substr(0, dot), dot == key.npos ? std::string_view() : key.substr(dot + 1)};
}

template <class Parts>
Names names_of(const Parts& parts) {
  Names out;
  for (const auto& part : parts) out.push_back(part.name);
  return out;
}

// Returns whether the muscle takes a set point instead of duties.
bool has_regulator(const Machine& machine, const robot::Muscle& muscle) {
  return valve_of(machine, muscle.inlet).kind == gas::Valve::Kind::regulator;
}

// Returns the mistake of a passiveness of muscles that all have regulators.
template <class IsOf>
std::optional<Mistake> without_duties(std::string_view leaf, const Machine& machine, IsOf is_of) {
  if (!leaf.starts_with("passiveness")) return std::nullopt;
  std::size_t all = 0;
  for (const robot::Muscle& m : machine.robot.muscles) {
    if (!is_of(m)) continue;
    if (!has_regulator(machine, m)) return std::nullopt;
    ++all;
  }
  if (all == 0) return std::nullopt;
  return Mistake{"a passiveness of muscles with regulators, which have no duties",
                 "a figure that the runs have", ""};
}

// Checks "<name>.<rest>" of one of the machine's groups, such as joints.
std::optional<Mistake> absent_name(std::string_view group, const Names& names,
                                   std::string_view name) {
  if (std::ranges::find(names, name) != names.end()) return std::nullopt;
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near(config::closest(name, known));
  return Mistake{fmt::format("{}.{}", group, name),
                 names.empty() ? fmt::format("another figure, as there are no {}", group)
                               : config::either(known),
                 near.empty() ? "" : config::in_quotes(near)};
}

// Checks a key of a machine with one leg, or of one leg.
std::optional<Mistake> absent_in(std::string_view key, const Machine& machine) {
  const auto [group, rest] = split(key);
  const auto [name, leaf] = split(rest);
  const auto any = [](const robot::Muscle&) { return true; };
  if (rest.empty()) return without_duties(group, machine, any);
  if (group == "joints") {
    if (auto out = absent_name(group, names_of(machine.robot.joints), name)) return out;
    return without_duties(leaf, machine, [&](const robot::Muscle& m) {
      return m.joint == name || m.second.joint == name;
    });
  }
  if (group == "muscles") {
    if (auto out = absent_name(group, names_of(machine.robot.muscles), name)) return out;
    return without_duties(leaf, machine, [&](const robot::Muscle& m) { return m.name == name; });
  }
  if (group == "phases") {
    if (auto out = absent_name(group, machine.phases, name)) return out;
    const std::string_view inner = split(leaf).first;
    return inner == "joints" || inner == "muscles" ? absent_in(leaf, machine) : std::nullopt;
  }
  if (group == "sensors") return absent_name(group, names_of(machine.robot.sensors), name);
  return std::nullopt;
}

// Returns the key of a leg that is probably meant: "legs.left.joints.hip.…" for
// "joints.left_hip.…" and for "joints.hip.…".
std::string within_leg(std::string_view key, const robot::Robot& robot) {
  const auto [group, rest] = split(key);
  for (const robot::Leg& leg : robot.legs)
    if (const std::string own = robot::name_in_leg(leg.name, rest); own != rest)
      return fmt::format("legs.{}.{}.{}", leg.name, group, own);
  return fmt::format("legs.{}.{}", robot.legs.front().name, key);
}

}  // namespace

std::optional<Mistake> absent(std::string_view key, const Machine& machine) {
  constexpr std::array of_a_leg{"joints", "muscles", "phases", "foot", "ground_reaction"};
  const auto [group, rest] = split(key);
  const auto [leg, inner] = split(rest);
  const std::vector<robot::Leg>& legs = machine.robot.legs;
  if (group == "legs" && !rest.empty()) {
    if (auto out = absent_name(group, names_of(legs), leg)) return out;
    for (const MachineLeg& own : legs_of(machine))
      if (own.name == leg) return absent_in(inner, own.machine);
  }
  if (!legs.empty() && !rest.empty() && std::ranges::count(of_a_leg, group) > 0)
    return Mistake{fmt::format("{} of a robot with several legs", group),
                   "a figure of one leg, legs.<name>.…",
                   config::in_quotes(within_leg(key, machine.robot))};
  return absent_in(key, machine);
}

}  // namespace sinew::analysis
