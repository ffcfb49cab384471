#include "sinew/identify/machine/run_fit.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/config/quantity.h"
#include "sinew/config/write/writer.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

// Puts a node at "joint.hip.damping", with the tables on the way.
void put_at(config::Node& root, std::string_view path, config::Node leaf) {
  const std::size_t dot = path.find('.');
  if (dot == path.npos) {
    root.put(std::move(leaf));
    return;
  }
  const std::string name(path.substr(0, dot));
  config::Node* table = root.find(name);
  if (!table) table = &root.put(config::make_table(name));
  put_at(*table, path.substr(dot + 1), std::move(leaf));
}

}  // namespace

std::string run_file(const RunFitResult& found, const std::string& source, config::Node robot) {
  for (const Estimate& e : found.report.best().parameters) {
    if (!e.identifiable) continue;
    const std::string key = e.name.substr(e.name.rfind('.') + 1);
    const std::string unit(config::difference_unit(e.unit));
    config::Node leaf = config::make_table(key);
    leaf.put(config::make_text("value", config::rounded_quantity(e.value, e.unit)));
    leaf.put(config::make_flag("fit", true));
    const bool told = std::isfinite(e.high - e.low);
    if (told)
      leaf.put(config::make_text("uncertainty",
                                 config::format_quantity(0.5 * (e.high - e.low), unit, unit, 3)));
    leaf.put(config::make_text("source", told ? source : source + "; how far off is not known"));
    put_at(robot, e.name, std::move(leaf));
  }
  return config::to_toml(robot);
}

Json describe(const RunFitResult& found) {
  Json out{{"simulations", found.simulations},
           {"rms_at_start", finite_or_null(found.at_start)},
           {"not_determined", found.undetermined},
           {"rough", found.rough},
           {"roughness", finite_or_null(found.roughness)},
           {"landings", found.landings},
           {"intervals", found.no_intervals.empty()}};
  if (!found.no_intervals.empty()) out["no_intervals_because"] = found.no_intervals;
  out["channels"] = Json::array();
  for (const ChannelScore& c : found.channels)
    out["channels"].push_back({{"channel", c.name},
                               {"unit", c.unit},
                               {"samples", c.samples},
                               {"noise", finite_or_null(c.noise)},
                               {"rms", finite_or_null(c.fitted)},
                               {"rms_held_out", finite_or_null(c.held_out)}});
  return out;
}

}  // namespace sinew::identify
