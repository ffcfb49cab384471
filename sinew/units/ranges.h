// units/ranges.h - plausible magnitude of a machine's quantity, by its unit.
//
// Robots range from a cricket's size to an elephant's. A value far beyond is a typing error and
// would overflow in some law. A field's own bounds are narrower (field.h).
#pragma once

#include <array>
#include <string_view>

#include "sinew/units/field.h"

namespace sinew::units {

// Largest plausible magnitude of a quantity in one unit, with the reason.
struct Range {
  std::string_view unit;  // SI unit as in a field table
  double most = 0;        // largest magnitude, in that unit
  std::string_view why;
};

inline constexpr std::array ranges = {
    Range{"1", 1e9, "no plain number of a machine is larger"},
    Range{"m", 1e3, "a robot, its track and its hoses lie within a kilometre"},
    Range{"m2", 1, "no passage of a valve or a leak is a square metre wide"},
    Range{"m3", 1e3, "no tank of a robot holds more"},
    Range{"rad", 100, "a joint turns a few times at most"},
    Range{"rad/s", 1e5, "no joint turns faster"},
    Range{"rad/s2", 1e8, "no joint is set in motion faster"},
    Range{"s", 1e6, "a run does not take two weeks"},
    Range{"1/s", 1e6, "a weight of readings per second; no angle is read a million times in one"},
    Range{"Hz", 1e6, "no valve follows a faster wave"},
    Range{"kg", 1e5, "an elephant has 6000 kg"},
    Range{"kg m2", 1e6, "an elephant turns with 10000 kg m2"},
    Range{"m/s2", 1e5, "no load of a stand bears a stronger shock"},
    Range{"N", 1e7, "a thousand tonnes pull a robot apart"},
    Range{"N m", 1e7, "no joint of a robot bears more"},
    Range{"N/m", 1e10, "steel of a robot's size is not stiffer"},
    Range{"N s/m", 1e8, "no damper of a robot's size is stronger"},
    Range{"N m/rad", 1e8, "no joint of a robot is stiffer"},
    Range{"N m s/rad", 1e8, "no damper of a joint is stronger"},
    Range{"N/m2", 1e13, "no bladder is stiffer"},
    Range{"N/m3", 1e16, "no bladder is stiffer"},
    Range{"Pa abs", 1e8, "no robot's air has 1000 bar"},
    Range{"Pa gauge", 1e8, "no robot's air has 1000 bar"},
    Range{"Pa diff", 1e8, "no robot's air has 1000 bar"},
    Range{"m3/(s Pa)", 1, "no valve or hose of a robot is wider"},
    Range{"kg/(s Pa)", 1, "no leak of a robot is wider"},
    Range{"s/Pa", 1e-3, "a bar does not delay a valve by minutes"},
    Range{"K", 1e4, "no air of a robot is hotter"},
    Range{"J/(kg K)", 1e5, "no gas has more"},
    Range{"V", 1e4, "no coil or converter of a robot has more"},
    Range{"W", 1e5, "no coil of a robot takes more"},
    Range{"ohm", 1e9, "a coil conducts"},
    Range{"H", 1e4, "no coil of a valve has more"},
    Range{"count", 1e6, "a converter of 16 bits ends at 65535"},
    Range{"count/rad", 1e6, "a converter of 16 bits ends at 65535"},
    Range{"count/m", 1e9, "a converter of 16 bits ends at 65535"},
    Range{"1/count", 1e3, "one count of error already opens a valve permanently at 1"},
    Range{"s/count", 1e3, "one count a second already opens a valve permanently at 1"},
    Range{"1/(count s)", 1e6, "one count of error already opens a valve permanently"},
    Range{"1/(N m/rad)", 8e4,
          "the joint controller accepts no more, and the least error already opens a valve "
          "permanently"},
    Range{"1/(N m s/rad)", 1e9, "the least error already opens a valve permanently"},
    Range{"rad/V", 1e4, "a joint turns a few times at most over a potentiometer's range"},
    Range{"m/V", 1e3, "a potentiometer is not that long"},
    Range{"V/N", 1e6, "a transducer that the least force saturates"},
    Range{"V/Pa", 1e3, "a transducer that the least pressure saturates"},
    Range{"V s/rad", 1e6, "a spindle that the least speed saturates"},
    Range{"m/N", 1e3, "a newton does not move a path by more"},
    Range{"1/m", 1e6, "a micrometre of error already opens a valve permanently"},
};

// Range for a unit without a row, such as 1/Pa2 of a polynomial.
inline constexpr Range any_range{"", 1e12, "no number of a machine is larger"};

// Returns the range of quantities in that unit; any_range if it is not listed.
constexpr const Range& range_of(std::string_view unit) {
  for (const Range& range : ranges)
    if (range.unit == unit) return range;
  return any_range;
}

// Returns whether a value is within a field's bounds and plausible for its unit.
constexpr bool is_within(const Field& field, double value) {
  const double size = value < 0 ? -value : value;
  return value >= field.min && value <= field.max && !(value != 0 && size < field.least) &&
         size <= range_of(field.unit).most;
}

}  // namespace sinew::units
