#include "sinew/design/air.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/actuator/body.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/units/quantity.h"

namespace sinew::design {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Yield yield_at_room_temperature(const AirStore& store, const gas::Air& air) {
  const double full = gas::stored_mass(air, store.volume, store.pressure);
  if (!(store.pressure > store.lowest)) return {0, {full, air.temperature}};
  const gas::AirLeft left = gas::left_at_room_temperature(air, store.volume, store.lowest);
  return {full - left.mass, left};
}

Yield yield_without_heat(const AirStore& store, const gas::Air& air) {
  const double full = gas::stored_mass(air, store.volume, store.pressure);
  if (!(store.pressure > store.lowest)) return {0, {full, air.temperature}};
  const gas::AirLeft left = gas::left_without_heat(air, store.volume, store.pressure, store.lowest);
  return {full - left.mass, left};
}

Lasting lasting(double air, const AirUse& use, double compressor_flow) {
  const double filling = std::isfinite(use.filling) ? use.filling : 0.0;
  const double walked = std::max(air - filling, 0.0);
  if (!std::isfinite(use.per_second)) {
    // Without a rate the compressor's share is no_number.
    if (compressor_flow > 0) return {no_number, no_number, no_number};
    return {no_number, walked / use.per_step, walked / use.per_metre};
  }
  const double net = use.per_second - compressor_flow;
  const double time = net > 0 ? walked / net : std::numeric_limits<double>::infinity();
  const double used = time * use.per_second;
  return {time, used / use.per_step, used / use.per_metre};
}

double air_of_filling(const actuator::Actuator& a, double external_volume, double vented_length,
                      double full_length, double pressure, const gas::Air& air) {
  const double vented = gas::density_at_atmosphere(air);
  const double full = vented * (1 + pressure / air.atmosphere);
  return full * actuator::volume(a, full_length) - vented * actuator::volume(a, vented_length) +
         (full - vented) * external_volume;
}

void require_length(const actuator::Actuator& a, double length, std::string_view setting,
                    const std::string& written) {
  constexpr double rounding = 1e-5;  // share by which a message rounds an end [-]
  const double shortest = actuator::shortest_length(a), longest = a.long_end.length;
  if (length >= shortest * (1 - rounding) && length <= longest * (1 + rounding)) return;
  const auto shown = [](double x) { return units::format_quantity(x, "m", "mm"); };
  std::string found = shown(length);
  if (written == found)
    found = config::in_quotes(written);
  else if (!written.empty())
    found = config::in_quotes(written) + ", which is " + found;
  config::refuse_setting(
      setting, found,
      "a length that the muscle can have, " + shown(shortest) + " to " + shown(longest));
}

double quantile(std::vector<double> numbers, double share) {
  std::erase_if(numbers, [](double x) { return std::isnan(x); });
  if (numbers.empty()) return no_number;
  std::ranges::sort(numbers);
  const double at = share * static_cast<double>(numbers.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= numbers.size()) return numbers.back();
  if (numbers[below] == numbers[below + 1]) return numbers[below];
  return numbers[below] + (at - static_cast<double>(below)) * (numbers[below + 1] - numbers[below]);
}

}  // namespace sinew::design
