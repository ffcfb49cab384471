#include "sinew/report/page/changes.h"

#include <charconv>
#include <optional>

#include "sinew/config/quantity.h"
#include "sinew/report/page/parameters.h"

namespace sinew::report {
namespace {

// A number with its unit: "0.004 1/count".
struct Number {
  double value = 0;
  std::string unit;
};

std::optional<Number> number_in(std::string_view text) {
  Number out;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out.value);
  if (error != std::errc{}) return std::nullopt;
  out.unit = config::trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return out;
}

std::optional<PageChange> change_of(const config::Node& table) {
  const std::optional<Number> time = number_in(value_text(table, "time"));
  PageChange out{.key = value_text(table, "key"), .unit = "", .leg = value_text(table, "leg")};
  if (!time || time->unit != "s" || out.key.empty()) return std::nullopt;
  out.time = time->value;
  out.release = value_text(table, "release") == "true";
  if (out.release) return out;
  const std::optional<Number> value = number_in(value_text(table, "value"));
  if (!value) return std::nullopt;
  out.value = value->value;
  out.unit = value->unit.empty() ? "1" : value->unit;
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
