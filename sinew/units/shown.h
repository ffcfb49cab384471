// units/shown.h - the units in which people see what Sinew holds in SI: three sets, and any other
// choice for a single quantity on top of one.
//
//   si        m · N · kPa abs · rad · s            the library's own
//   thesis    in · lbf · psi gauge · deg · s       the ones of Colbrunn (2000)
//   metric    mm · N · bar gauge · deg · ms        those of a laboratory with a metric rig
//
//   metric,pressure=kPa gauge,length=cm            the same set but for two quantities
//
// Every table, figure, page and calculator asks here, so a unit that is chosen once is shown
// everywhere. The table itself is units/shown.h, and docs/reference/units.md shows it.
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
#include "sinew/units/unit.h"

namespace sinew::units {

// The sets of units.
enum class UnitSet { si, thesis, metric };

// Returns the word for a set, as files and options say it.
std::string_view to_text(UnitSet set);

// One unit in which a quantity of SI is shown:  shown = (value + offset) * scale
struct ShownUnit {
  std::string name;  // as a file writes it, "psi gauge", "bar diff"; empty for a plain number
  double scale = 1;
  double offset = 0;  // [SI]
  // The number counts from the room's pressure, which `offset` takes off.
  bool gauge = false;

  // Returns the number that is shown for a value of SI.
  double of(double value) const { return (value + offset) * scale; }
  // Returns the value of SI for a number that is shown.
  double back(double number) const { return number / scale - offset; }
  // Returns the name beside an axis or in a column's title, where a difference of pressures needs
  // no word for it.
  std::string label() const;
};

// A set of units with the choices on top of it. A copy is cheap enough to be handed around.
class ShownUnits {
 public:
  // The units of a set, without choices.
  ShownUnits(UnitSet set = UnitSet::si) : set_(set) {}  // NOLINT: a set is its own units

  // Returns the unit for a quantity that the library holds in `unit`, as fields and channels name
  // it: "m", "Pa" (absolute), "Pa diff", "N m/rad", "share" for a share of 1. A unit that the table
  // does not have stays what it is. `largest` is the greatest size of what is shown, in SI: of
  // units that differ by a thousand the first one in which it is below 1000; without it the usual
  // one. Gauges count from the pressure of the `room` [Pa].
  ShownUnit of(std::string_view unit, double largest = not_known, double room = atmosphere) const;

  // Returns the unit for a difference between two such quantities, which counts from nothing.
  ShownUnit of_difference(std::string_view unit, double largest = not_known) const;

  // Returns a value of SI with its unit, "62.31 psi gauge": the usual one, or from 1000 of it on a
  // larger one where there is one.
  std::string text(double value, std::string_view unit, int digits = 4,
                   double room = atmosphere) const;

  // Returns the set, and whether there are choices on top of it.
  UnitSet set() const { return set_; }
  bool has_choices() const { return !choices_.empty(); }
  // Returns what read_shown_units reads: "metric,pressure=kPa gauge".
  std::string text() const;

  // Shows a quantity of that name in this unit; both are known to be right.
  void choose(std::string_view quantity, std::string_view unit);

  // Are set and choices the same?
  bool operator==(const ShownUnits&) const = default;

  // As a size: nobody knows it.
  static constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

 private:
  const std::string* choice(std::string_view quantity) const;

  UnitSet set_;
  std::vector<std::pair<std::string, std::string>> choices_;  // quantity, unit
};

// Units as a text names them, or why it names none: the parts of a message.
struct ShownUnitsReading {
  ShownUnits units;
  std::string found, expected, try_this;  // all empty where the text was understood

  // Was the text understood?
  bool ok() const { return found.empty(); }
};

// Reads "thesis", "metric,pressure=kPa gauge" or "length=cm": the set and then choices. Where no
// set is named, the choices stand on top of `below`.
ShownUnitsReading read_shown_units(std::string_view text, const ShownUnits& below = {});

// A unit as somebody told it, "psi gauge", and what the library holds such a quantity in, "Pa".
struct ToldUnit {
  std::string_view held;
  ShownUnit unit;  // unit.back(62) is 62 psi gauge in SI
};

// Reads a unit of one of the table's quantities; nullopt where it has none. Gauges count from the
// `room` [Pa].
std::optional<ToldUnit> told_unit(std::string_view unit, double room = atmosphere);

// One row of what a page needs: a unit of SI and the one in which it is shown, the usual one first.
struct ShownEntry {
  std::string_view unit;         // of SI
  std::string_view quantity;     // "pressure"
  std::vector<ShownUnit> shown;  // from small to large
  std::size_t usual = 0;         // of these
};

// Returns all that the table has. Offsets of gauges are left out: a page knows its own atmosphere.
std::vector<ShownEntry> shown_entries(const ShownUnits& units);

// Which unit each set shows for each quantity. units/shown.h reads it.

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
