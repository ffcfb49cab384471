#include "sinew/config/write/documenter.h"

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"

namespace sinew::config {

namespace {

std::string range_text(const units::Field& field) {
  const std::string unit(field.unit.empty() ? "1" : field.unit);
  const bool low = field.min != -units::unbounded;
  const bool high = field.max != units::unbounded;
  if (low && high) return format_number(field.min) + " to " + format_quantity(field.max, unit);
  if (low) return "≥ " + format_quantity(field.min, unit);
  if (high) return "≤ " + format_quantity(field.max, unit);
  return "";
}

// Escapes bars, which would end the cell.
std::string cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

void Documenter::add(const Field& field, std::string_view unit) {
  std::string key;
  for (const auto& part : path_) key += part + ".";
  key += field.name;
  fields_.push_back(
      {key, std::string(unit), range_text(field), std::string(field.doc), field.optional});
}

void Documenter::add_choice(const Field& field, const std::vector<std::string_view>& words) {
  std::vector<std::string> quoted;
  for (auto word : words) quoted.push_back(in_quotes(word));
  add(field, either({quoted.begin(), quoted.end()}));
}

void Documenter::enter(const Field& field, std::string_view suffix) {
  path_.push_back(std::string(field.name) + std::string(suffix));
}

std::string Documenter::markdown() const {
  std::string out = "| key | unit | range | what it is |\n| --- | --- | --- | --- |\n";
  for (const auto& f : fields_) {
    out += fmt::format("| `{}`{} | {} | {} | {} |\n", f.key, f.optional ? " (optional)" : "",
                       cell(f.unit), cell(f.range), cell(f.doc));
  }
  return out;
}

}  // namespace sinew::config
