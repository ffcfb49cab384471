// units/shown.h - units in which quantities, stored in SI, are shown: three sets, and a different
// choice for any single quantity.
//
//   si        m · N · kPa abs · rad · s            the library's own
//   thesis    in · lbf · psi gauge · deg · s       those of Colbrunn (2000)
//   metric    mm · N · bar gauge · deg · ms        those of a laboratory with a metric rig
//
//   metric,pressure=kPa gauge,length=cm            a set with two other choices
//
// Every table, figure, page and calculator uses this file, so a choice applies everywhere. The
// table is below, and docs/reference/units.md prints it.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/units/constants.h"
#include "sinew/units/mistake.h"
#include "sinew/units/unit.h"

namespace sinew::units {

// Sets of units.
enum class UnitSet { si, thesis, metric };

// Returns the word for a set in files and options.
std::string_view to_text(UnitSet set);

// A unit in which an SI quantity is shown: shown = (value + offset) * scale
struct ShownUnit {
  std::string name;  // as in a file, "psi gauge", "bar diff"; empty for a plain number
  double scale = 1;
  double offset = 0;  // [SI]
  // The number is relative to the room's pressure, which `offset` subtracts.
  bool gauge = false;

  // Returns the shown number for an SI value.
  double of(double value) const { return (value + offset) * scale; }
  // Returns the SI value for a shown number.
  double back(double number) const { return number / scale - offset; }
  // Returns the name for an axis or a column's title, without the word for a difference of
  // pressures.
  std::string label() const;
};

// A set of units with choices for single quantities. Cheap to copy.
class ShownUnits {
 public:
  // Uses the units of a set, without choices.
  ShownUnits(UnitSet set = UnitSet::si) : set_(set) {}  // NOLINT: a set is its own units

  // Returns the unit for a quantity that the library stores in `unit`, as fields and channels name
  // it: "m", "Pa" (absolute), "Pa diff", "N m/rad", "share" for a share of 1. A unit that the table
  // does not have is returned unchanged. `largest` is the largest magnitude to be shown, in SI: it
  // selects, among units that differ by a thousand, the first in which it is below 1000; without it
  // the usual unit is used. Gauge pressures are relative to the pressure of the `room` [Pa].
  ShownUnit of(std::string_view unit, double largest = unknown_size,
               double room = atmosphere) const;

  // Returns the unit for a difference between two such quantities, without an offset.
  ShownUnit of_difference(std::string_view unit, double largest = unknown_size) const;

  // Returns an SI value with its unit, "62.31 psi gauge": the usual unit, or from 1000 on a larger
  // one if there is one.
  std::string text(double value, std::string_view unit, int digits = 4,
                   double room = atmosphere) const;

  // Return the set, and whether there are choices.
  UnitSet set() const { return set_; }
  bool has_choices() const { return !choices_.empty(); }
  // Returns the text for read_shown_units: "metric,pressure=kPa gauge".
  std::string text() const;

  // Shows the named quantity in this unit; both must be valid.
  void choose(std::string_view quantity, std::string_view unit);

  // Returns whether set and choices are equal.
  bool operator==(const ShownUnits&) const = default;

  // An unknown size.
  static constexpr double unknown_size = std::numeric_limits<double>::quiet_NaN();

 private:
  const std::string* choice(std::string_view quantity) const;

  UnitSet set_;
  std::vector<std::pair<std::string, std::string>> choices_;  // quantity, unit
};

// Units read from a text, or the reason why it is not valid.
struct ShownUnitsReading {
  ShownUnits units;
  std::optional<Mistake> mistake;
};

// Reads "thesis", "metric,pressure=kPa gauge" or "length=cm": the set and then choices. Without a
// set the choices are added to `below`.
ShownUnitsReading read_shown_units(std::string_view text, const ShownUnits& below = {});

// A unit given as text, "psi gauge", and the unit in which the library stores it, "Pa".
struct QuantityUnit {
  std::string_view stored;
  ShownUnit unit;  // unit.back(62) is 62 psi gauge in SI
};

// Reads a unit of one of the table's quantities; nullopt if it is of no such quantity. Gauge
// pressures are relative to the `room` [Pa].
std::optional<QuantityUnit> read_quantity_unit(std::string_view unit, double room = atmosphere);

// One row for a page: an SI unit and the units in which it is shown.
struct ShownEntry {
  std::string_view unit;         // SI
  std::string_view quantity;     // "pressure"
  std::vector<ShownUnit> shown;  // in ascending size
  std::size_t usual = 0;         // index of the usual one
};

// Returns all rows of the table. Offsets of gauges are omitted, since a page has its own
// atmosphere.
std::vector<ShownEntry> shown_entries(const ShownUnits& units);

// The table of units of each set for each quantity.

// Units of one quantity in one set: the usual one, and a smaller or a larger one if sizes differ by
// thousands.
struct ShownChoice {
  std::string_view usual, small = "", large = "";
};

// A quantity with the name that is used to choose its unit.
struct ShownQuantity {
  std::string_view name;
  std::string_view unit;  // SI unit in which the library stores it
  ShownChoice si, thesis, metric;
};

// clang-format off
// All quantities with a choice of units.
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

// Returns whether a shown unit has the dimension of the stored unit.
constexpr bool measures(std::string_view shown, std::string_view unit) {
  const UnitReading a = read_unit(unit_and_reference(shown)[0]);
  const UnitReading b = read_unit(unit_and_reference(unit)[0]);
  return a.ok && b.ok && a.unit.dimension == b.unit.dimension;
}

// Checks every row of the table.
static_assert(std::ranges::all_of(shown_quantities, [](const ShownQuantity& q) {
  return std::ranges::all_of(std::array{q.si, q.thesis, q.metric}, [&](const ShownChoice& c) {
    return measures(c.usual, q.unit) && (c.small.empty() || measures(c.small, q.unit)) &&
           (c.large.empty() || measures(c.large, q.unit));
  });
}));

}  // namespace sinew::units
