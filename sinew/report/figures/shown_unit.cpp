#include "sinew/report/figures/shown_unit.h"

namespace sinew::report {
namespace {

using enum UnitSystem;

struct Row {
  UnitSystem system;
  std::string_view unit, shown;
  double scale;
};

constexpr double degree = 180 / 3.14159265358979323846;
constexpr double pound_inch = units::pound_force * units::inch;

// Of one unit the smaller before the larger.
constexpr Row rows[] = {
    {si, "1", "-", 1},
    {si, "share", "%", 100},
    {si, "m", "mm", 1e3},
    {si, "m", "m", 1},
    {si, "m/s", "mm/s", 1e3},
    {si, "m/s", "m/s", 1},
    {si, "Pa", "kPa abs", 1e-3},
    {si, "Pa diff", "kPa", 1e-3},
    {si, "kg", "mg", 1e6},
    {si, "kg", "g", 1e3},
    {si, "kg", "kg", 1},
    {thesis, "1", "-", 1},
    {thesis, "share", "%", 100},
    {thesis, "m", "in", 1 / units::inch},
    {thesis, "m/s", "in/s", 1 / units::inch},
    {thesis, "N", "lbf", 1 / units::pound_force},
    {thesis, "Pa", "psi gauge", 1 / units::psi},
    {thesis, "Pa diff", "psi", 1 / units::psi},
    {thesis, "rad", "deg", degree},
    {thesis, "rad/s", "deg/s", degree},
    {thesis, "N m", "lbf in", 1 / pound_inch},
    {thesis, "N m/rad", "lbf in/rad", 1 / pound_inch},
    {thesis, "kg", "mg", 1e6},
    {thesis, "kg", "g", 1e3},
    {thesis, "kg", "kg", 1},
};

}  // namespace

ShownUnit shown_unit(std::string_view unit, UnitSystem system, double largest, double atmosphere) {
  const Row* found = nullptr;
  for (const Row& row : rows) {
    if (row.unit != unit || row.system != system) continue;
    if (!found || found->scale * largest >= 1000) found = &row;
  }
  if (!found) return {unit.empty() ? "-" : std::string(unit)};
  const bool gauge = system == thesis && unit == "Pa";
  return {std::string(found->shown), found->scale, gauge ? -atmosphere : 0};
}

}  // namespace sinew::report
