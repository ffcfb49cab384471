// config/shown_units.h - in whose units numbers are shown, by what people said about it.
//
//   strongest   what is asked for now: an option of the program, an argument of Python
//               SINEW_UNITS          of the environment, for a session or a script
//               page.units           of the run, as its experiment has it
//               settings.toml        of the person (config/user_settings.h)
//   weakest     what the caller shows where nobody said anything
//
// Each of them is a set, "metric", with choices for single quantities on top of it, or such choices
// alone, "pressure=kPa gauge", which change nothing else of what a weaker one says.
#pragma once

#include <string>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/units/complain.h"
#include "sinew/units/field.h"
#include "sinew/units/shown.h"

namespace sinew::config {

// The variable of the environment.
inline constexpr const char* units_variable = "SINEW_UNITS";

// Holds what is said about units beside the environment and the person's settings.
struct UnitsAsked {
  std::string now;               // empty: nothing
  std::string now_is = "units";  // what messages call it
  const Node* run = nullptr;     // an experiment's tree, or a run's resolved.toml; null: none
};

// The units that come of it.
struct UnitsToShow {
  units::ShownUnits units;
  bool asked = false;  // somebody said so: `units` is not just what the caller has
};

// Returns the units to show numbers in. Throws Error, which says where a text that is no units
// stands.
UnitsToShow units_to_show(const UnitsAsked& asked, const units::ShownUnits& otherwise = {});

// Reads a text as units::read_shown_units does; throws Error that begins with `where` and `key`.
units::ShownUnits parse_shown_units(std::string_view text, const Location& where,
                                    const std::string& key, const units::ShownUnits& below = {});

// How people see a run: the table [page] of an experiment.
struct PageTable {
  std::string units;  // empty: as the person who looks has it
};

// Tells a reader what is wrong with the key `units` of its table.
template <class Visitor>
void complain_of_units(Visitor& v, const std::string& text) {
  if (text.empty()) return;
  const units::ShownUnitsReading read = units::read_shown_units(text);
  if (!read.ok()) units::complain(v, "units", read.found, read.expected, read.try_this);
}

// The keys of [page].
template <class Visitor>
void fields(Visitor& v, PageTable& page) {
  v.text({.name = "units",
          .optional = true,
          .doc = "in which its numbers are shown: si, thesis, metric, or metric,length=cm; the log "
                 "is in SI"},
         page.units);
  complain_of_units(v, page.units);
}

}  // namespace sinew::config
