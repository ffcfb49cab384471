#include "sinew/identify/fit/provenance.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/config/quantity.h"
#include "sinew/config/write/writer.h"

namespace sinew::identify {

Provenance::Provenance(config::Origins start, std::string_view file)
    : origins_(std::move(start)), elsewhere_(fmt::format("where none stands: as in {}", file)) {}

// A new origin, in place of one that the path has already.
config::Origin& Provenance::put(std::string_view path) {
  std::erase_if(origins_, [path](const config::Origin& o) { return o.path == path; });
  return origins_.emplace_back(config::Origin{.path = std::string(path)});
}

void Provenance::fitted(std::string_view path, const Estimate& estimate, std::string_view source) {
  std::string text(source);
  if (!estimate.known.empty()) text += "; " + estimate.known;
  if (!estimate.free && estimate.low == estimate.high) return given(path, text);
  if (estimate.at_bound) text += "; at the bound of its range";
  if (!estimate.identifiable && !estimate.at_bound) text += "; not identifiable from these data";
  fitted(path, estimate.unit, 0.5 * (estimate.high - estimate.low), text);
  if (estimate.at_bound) origins_.back().uncertainty.clear();
}

void Provenance::fitted(std::string_view path, std::string_view unit, double uncertainty,
                        std::string_view source) {
  config::Origin& origin = put(path);
  origin.unit = unit;
  origin.source = source;
  origin.fit = true;
  if (std::isfinite(uncertainty))
    origin.uncertainty = config::format_quantity(uncertainty, config::difference_unit(unit),
                                                 config::difference_unit(unit), 3);
}

void Provenance::given(std::string_view path, std::string_view source) {
  put(path).source = source;
}

void Provenance::guessed(std::string_view path, std::string_view source) {
  given(path, source);
  origins_.back().guess = true;
}

std::string actuator_file(actuator::Actuator actuator, const Provenance& provenance) {
  const std::string name = actuator.name;
  config::Writer writer(&provenance.origins());
  std::vector<actuator::Actuator> one{std::move(actuator)};
  actuator::fields(writer, one);

  // A file alone has at its root what an experiment has in actuator.<name>.
  config::Node root = config::make_table("");
  root.put(config::make_text("format", "sinew.actuator/1"));
  root.put(config::make_text("name", name));
  for (config::Node child : writer.root().find("actuator")->find(name)->children) {
    child.erase("trapezoids");  // thread_length and turns say it all
    if (child.is_table()) child.put(config::make_text("source", provenance.elsewhere()));
    root.put(std::move(child));
  }
  return config::to_toml(root);
}

}  // namespace sinew::identify
