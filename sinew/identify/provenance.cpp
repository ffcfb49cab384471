#include "sinew/identify/provenance.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/config/quantity.h"
#include "sinew/config/writer.h"

namespace sinew::identify {

void Provenance::fitted(std::string_view path, const Estimate& estimate, std::string_view source) {
  std::string text(source);
  if (estimate.at_bound) text += "; at the bound of its range";
  if (!estimate.identifiable && !estimate.at_bound) text += "; not identifiable from these data";
  fitted(path, estimate.unit, 0.5 * (estimate.high - estimate.low), text);
  if (estimate.at_bound) origins_.back().uncertainty.clear();
}

void Provenance::fitted(std::string_view path, std::string_view unit, double uncertainty,
                        std::string_view source) {
  config::Origin origin{.path = std::string(path), .unit = std::string(unit)};
  origin.source = source;
  origin.fit = true;
  if (std::isfinite(uncertainty))
    origin.uncertainty = config::format_quantity(uncertainty, config::difference_unit(unit),
                                                 config::difference_unit(unit), 3);
  origins_.push_back(std::move(origin));
}

void Provenance::given(std::string_view path, std::string_view source) {
  config::Origin origin{.path = std::string(path)};
  origin.source = source;
  origins_.push_back(std::move(origin));
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
    if (child.is_table())
      child.put(config::make_text("source", "where none stands: not identified, does nothing"));
    root.put(std::move(child));
  }
  return config::to_toml(root);
}

}  // namespace sinew::identify
