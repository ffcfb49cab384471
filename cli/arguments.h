// cli/arguments.h - quantities on the command line: "3.4in", "60 psi gauge", and ranges of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/setting.h"
#include "sinew/gas/air.h"

namespace sinew::cli {

using config::above_zero;
using config::air_pressure;
using config::air_volume;
using config::from_zero;
using config::greatest_pressure;
using config::polytropic;
using config::pulses;
using config::Range;

Range gauge_air_pressure(double atmosphere);

// One quantity in SI; throws config::Error that begins with the option's name.
inline double argument(std::string_view option, std::string_view text, std::string_view unit,
                       double atmosphere, const Range& range = {}) {
  return config::quantity_setting(option, text, unit, atmosphere, range);
}

// "2.5in:3.9in:0.1in", first and last included; or one quantity. A pressure's step is a difference:
// "20 psi gauge:110 psi gauge:10 psi".
struct Values {
  std::vector<double> si;
  std::string display;  // the unit that was written, for columns of a table
};
Values arguments(std::string_view option, std::string_view text, std::string_view unit,
                 double atmosphere, const Range& range = {});

// Returns the unit behind the number of a quantity that was understood: "in" of "3.4 in"; "1" for
// none.
std::string unit_text(std::string_view text);

// "-2 in, -13 in": as many quantities as there are commas and one.
std::vector<double> argument_list(std::string_view option, std::string_view text,
                                  std::string_view unit, const Range& range = {});

}  // namespace sinew::cli
