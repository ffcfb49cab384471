#include "sinew/config/setting_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "sinew/config/diagnostics.h"
#include "sinew/units/quantity.h"

namespace sinew::config {

void SettingValues::row(const Setting& row, const std::string& value) {
  if (row.is_required && value.empty()) refuse_setting(row.name, "nothing", std::string(row.doc));
  if (row.kind == Kind::choice && !value.empty() &&
      std::ranges::find(row.words, value) == row.words.end()) {
    const std::vector<std::string_view> words(row.words.begin(), row.words.end());
    refuse_setting(row.name, in_quotes(value), either(words), closest_in_quotes(value, words));
  }
  if (row.unit.empty()) return;
  quantities_.emplace_back(&value, row);
  if (row.kind == Kind::quantities)
    (void)each(value, at_commas(value).size());
  else if (!value.empty())
    (void)of(value);
}

void SettingValues::row(const Setting& row, double value) {
  (void)number_setting(row.name, value, row.range);
}

void SettingValues::check_one(const Setting& row, std::size_t count) {
  if (!row.is_repeated && count > 1)
    refuse_setting(row.name, fmt::format("{} of them", count), "one");
}

const Setting& SettingValues::row_of(const std::string& member) const {
  const auto at =
      std::ranges::find_if(quantities_, [&](const auto& q) { return q.first == &member; });
  if (at == quantities_.end()) throw std::logic_error("no row of this setting");
  return at->second;
}

double SettingValues::of(const std::string& member, std::string_view text) const {
  const Setting& row = row_of(member);
  if (!member.empty()) text = member;
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  return quantity_setting(row.name, text, row.unit, atmosphere_, row.range);
}

std::optional<double> SettingValues::given(const std::string& member) const {
  return member.empty() ? std::nullopt : std::optional(of(member));
}

std::vector<double> SettingValues::each(const std::string& member, std::size_t tables) const {
  const Setting& row = row_of(member);
  std::vector<double> out;
  for (const std::string& piece : at_commas(member))
    out.push_back(quantity_setting(row.name, piece, row.unit, atmosphere_, row.range));
  if (out.size() == 1) out.resize(tables, out[0]);
  if (out.size() != tables)
    refuse_setting(row.name, fmt::format("{} values", out.size()),
                   fmt::format("one, or {}: one for each file", tables));
  return out;
}

void SettingList::row(const Setting& row, double value) {
  this->row(row, units::format_number(value));
}

void SettingList::row(const Setting& row, const std::string& value) {
  Json one{{"name", row.name}, {"keyword", row.keyword}, {"doc", row.doc}};
  if (!row.unit.empty() && row.unit != "1") one["unit"] = row.unit;
  if (!row.words.empty()) one["words"] = row.words;
  if (!value.empty()) one["default"] = value;
  rows.push_back(one);
}

}  // namespace sinew::config
