// units/shown_table.h - which unit each set shows for each quantity. units/shown.h reads it.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "sinew/units/unit.h"

namespace sinew::units {

// The units of one quantity in one set. Where sizes differ by thousands it has a smaller or a
// larger one beside the usual one.
struct ShownChoice {
  std::string_view usual, small = "", large = "";
};

// A quantity by the name under which people choose its unit.
struct ShownQuantity {
  std::string_view name;
  std::string_view unit;  // in which the library holds it, SI
  ShownChoice si, thesis, metric;
};

// clang-format off
// Every quantity that has units to be shown in.
inline constexpr std::array shown_quantities = {
    //            quantity               in SI          si                     thesis            metric
    ShownQuantity{"length",              "m",           {"m", "mm"},           {"in"},           {"mm"}},
    ShownQuantity{"speed",               "m/s",         {"m/s", "mm/s"},       {"in/s"},         {"mm/s"}},
    ShownQuantity{"acceleration",        "m/s2",        {"m/s2"},              {"m/s2"},         {"m/s2"}},
    ShownQuantity{"area",                "m2",          {"m2"},                {"in2"},          {"mm2"}},
    ShownQuantity{"volume",              "m3",          {"m3"},                {"in3"},          {"mL"}},
    ShownQuantity{"time",                "s",           {"s"},                 {"s"},            {"ms", "", "s"}},
    ShownQuantity{"angle",               "rad",         {"rad"},               {"deg"},          {"deg"}},
    ShownQuantity{"angular speed",       "rad/s",       {"rad/s"},             {"deg/s"},        {"deg/s"}},
    ShownQuantity{"mass",                "kg",          {"g", "mg", "kg"},     {"g", "mg", "kg"}, {"g", "mg", "kg"}},
    ShownQuantity{"mass flow",           "kg/s",        {"kg/s"},              {"kg/s"},         {"g/s"}},
    ShownQuantity{"mass per length",     "kg/m",        {"kg/m"},              {"kg/m"},         {"g/m"}},
    ShownQuantity{"force",               "N",           {"N"},                 {"lbf"},          {"N"}},
    ShownQuantity{"torque",              "N m",         {"N m"},               {"lbf in"},       {"N m"}},
    ShownQuantity{"pressure",            "Pa",          {"kPa abs"},           {"psi gauge"},    {"bar gauge"}},
    ShownQuantity{"pressure difference", "Pa diff",     {"kPa diff"},          {"psi diff"},     {"bar diff"}},
    ShownQuantity{"stress",              "N/m2",        {"N/m2"},              {"psi"},          {"MPa"}},
    ShownQuantity{"stiffness",           "N/m",         {"N/m"},               {"lbf/in"},       {"N/mm"}},
    ShownQuantity{"joint stiffness",     "N m/rad",     {"N m/rad"},           {"lbf in/rad"},   {"N m/rad"}},
    ShownQuantity{"damping",             "N s/m",       {"N s/m"},             {"lbf s/in"},     {"N s/m"}},
    ShownQuantity{"joint damping",       "N m s/rad",   {"N m s/rad"},         {"lbf in s/rad"}, {"N m s/rad"}},
    ShownQuantity{"air flow",            "m3/s",        {"m3/s"},              {"L/min"},        {"L/min"}},
    ShownQuantity{"conductance",         "m3/(s Pa)",   {"m3/(s Pa)"},         {"L/(s bar)"},    {"L/(s bar)"}},
    ShownQuantity{"temperature",         "K",           {"K"},                 {"K"},            {"degC"}},
    ShownQuantity{"energy",              "J",           {"J"},                 {"J"},            {"J"}},
    ShownQuantity{"power",               "W",           {"W"},                 {"W"},            {"W"}},
    ShownQuantity{"voltage",             "V",           {"V"},                 {"V"},            {"V"}},
    ShownQuantity{"volts per force",     "V/N",         {"V/N"},               {"V/lbf"},        {"mV/N"}},
    ShownQuantity{"counts per force",    "count/N",     {"count/N"},           {"count/lbf"},    {"count/N"}},
    ShownQuantity{"angle gain",          "1/count",     {"%/count"},           {"%/count"},      {"%/count"}},
    ShownQuantity{"rate gain",           "s/count",     {"% s/count"},         {"% s/count"},    {"% s/count"}},
    ShownQuantity{"stiffness gain",      "1/(N m/rad)", {"% rad/(N m)"},       {"% rad/(lbf in)"}, {"% rad/(N m)"}},
};
// clang-format on

// Splits "psi gauge" into the unit and what a pressure counts from: "gauge", "abs", "diff" or "".
constexpr std::array<std::string_view, 2> unit_and_reference(std::string_view text) {
  for (const std::string_view word : {"gauge", "abs", "diff"}) {
    if (text == word) return {"", word};
    if (text.ends_with(word) && text[text.size() - word.size() - 1] == ' ')
      return {text.substr(0, text.find_last_not_of(' ', text.size() - word.size() - 1) + 1), word};
  }
  return {text, ""};
}

// A unit of the table measures what the quantity is held in.
constexpr bool measures(std::string_view shown, std::string_view unit) {
  const UnitReading a = read_unit(unit_and_reference(shown)[0]);
  const UnitReading b = read_unit(unit_and_reference(unit)[0]);
  return a.ok && b.ok && a.unit.dimension == b.unit.dimension;
}

// Every row was written without a slip.
static_assert(std::ranges::all_of(shown_quantities, [](const ShownQuantity& q) {
  return std::ranges::all_of(std::array{q.si, q.thesis, q.metric}, [&](const ShownChoice& c) {
    return measures(c.usual, q.unit) && (c.small.empty() || measures(c.small, q.unit)) &&
           (c.large.empty() || measures(c.large, q.unit));
  });
}));

}  // namespace sinew::units
