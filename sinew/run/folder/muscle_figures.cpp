#include "sinew/run/folder/muscle_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"

namespace sinew::run {
namespace {

constexpr int intervals = 200;  // of a curve's length
constexpr double most_curves = 6;

// Steps of 1, 2 or 5 times a power of ten, so that there are few curves at round pressures.
double round_step(double top) {
  const double least = top / most_curves;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

double top_pressure(const actuator::Actuator& a) {
  return a.prediction.highest > 0 ? a.prediction.highest : a.effectiveness.valid_to;
}

report::Axis axis(std::string name, const units::ShownUnit& unit) {
  return {.name = std::move(name), .unit = unit.label(), .scale = unit.scale};
}

report::Figure figure_of(const actuator::Actuator& a, const gas::Air& air,
                         const std::string& source, const units::ShownUnits& units) {
  const double shortest = actuator::shortest_length(a), longest = a.long_end.length;
  const actuator::Surroundings around{air.atmosphere, air.polytropic_exponent, 0};
  const double top = top_pressure(a);
  const double largest = actuator::operating_point(a, longest, top, around).tension;
  const units::ShownUnit length = units.of("m", longest), force = units.of("N", largest),
                         pressure = units.of("Pa gauge", top, air.atmosphere);
  report::Plot plot{.x = axis("length", length), .y = axis("tension", force)};
  const double step = round_step(pressure.of(top));
  for (int k = 0; k * step <= pressure.of(top) * (1 + 1e-9); ++k) {
    report::Curve curve{.label = fmt::format("{:.4g} {}", k * step, pressure.name),
                        .source = source};
    for (int i = 0; i <= intervals; ++i) {
      const double at = shortest + (longest - shortest) * i / intervals;
      const double gauge = pressure.back(k * step);
      curve.xs.push_back(length.of(at));
      // A muscle cannot push.
      curve.ys.push_back(
          force.of(std::max(0.0, actuator::operating_point(a, at, gauge, around).tension)));
    }
    plot.curves.push_back(std::move(curve));
  }
  report::Figure out{.name = report::file_name_of(a.name), .title = "Characteristic of " + a.name};
  out.caption = fmt::format(
      "Tension of {} at rest over its length, without losses, at gauge pressures up to {:.4g} {}, "
      "by {}.",
      a.name, pressure.of(top), pressure.name, source);
  out.plots.push_back(std::move(plot));
  return out;
}

}  // namespace

bool is_muscle_file(const std::filesystem::path& named) {
  std::error_code none;
  return named.extension() == ".toml" && std::filesystem::is_regular_file(named, none);
}

std::vector<report::Figure> muscle_figures(const std::filesystem::path& file,
                                           const units::ShownUnits& units) {
  const experiment::Experiment e = experiment::load_machine_file(file.string()).experiment;
  if (e.actuators.empty())
    config::fail({file.string(), 0, 0}, "", "no actuator", "an actuator or a robot file");
  std::vector<report::Figure> out;
  for (const actuator::Actuator& a : e.actuators)
    out.push_back(figure_of(a, e.air, file.filename().string(), units));
  return out;
}

}  // namespace sinew::run
