#include "sinew/recording/clock_settings.h"

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"

namespace sinew::recording {

double seconds_per_unit(const std::string& unit, const std::string& file) {
  if (unit.empty()) return 1;
  const config::Parsed one = config::parse_quantity("1 " + unit, "s");
  if (!one.mistake) return one.si;
  config::fail({file, 0, 0}, "clock.unit", config::in_quotes(unit), "a unit of time", "\"ms\"");
}

}  // namespace sinew::recording
