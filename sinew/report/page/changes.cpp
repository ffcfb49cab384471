#include "sinew/report/page/changes.h"

#include <optional>

#include "sinew/report/page/parameters.h"
#include "sinew/units/quantity.h"

namespace sinew::report {
namespace {

std::optional<PageChange> change_of(const config::Node& table) {
  const std::string at = value_text(table, "time"), to = value_text(table, "value");
  const units::NumberAndUnit time = units::split_number(at);
  PageChange out{.key = value_text(table, "key"), .unit = "", .leg = value_text(table, "leg")};
  if (time.unit != "s" || out.key.empty()) return std::nullopt;
  out.time = time.number;
  out.release = value_text(table, "release") == "true";
  if (out.release) return out;
  const units::NumberAndUnit value = units::split_number(to);
  if (value.error != std::errc{}) return std::nullopt;
  out.value = value.number;
  out.unit = units::written_unit(to);
  return out;
}

}  // namespace

std::vector<PageChange> changes_of(const config::Node& resolved) {
  std::vector<PageChange> out;
  const config::Node* list = resolved.find("change");
  if (list == nullptr) return out;
  for (const config::Node& table : list->children)
    if (const std::optional<PageChange> change = change_of(table)) out.push_back(*change);
  return out;
}

}  // namespace sinew::report
