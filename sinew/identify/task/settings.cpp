#include "sinew/identify/task/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sinew/config/diagnostics.h"
#include "sinew/identify/task/tables.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

[[noreturn]] void refuse(std::string_view name, const std::string& found,
                         const std::string& expected) {
  config::fail({std::string(name), 0, 0}, "", found, expected);
}

}  // namespace

std::vector<Source> held_out_tables(const HeldOut& hold_out, const std::vector<Source>& sources,
                                    std::span<const std::string_view> words, bool may_be_fitted) {
  std::vector<Source> out = hold_out.tables;
  for (const std::string& text : hold_out.texts) {
    if (std::ranges::find(words, text) != words.end()) continue;
    if (!may_be_fitted) refuse_fitted(sources, "hold_out", text);
    out.push_back(sources.front());
    out.back().path = text;
    out.back().text.reset();
  }
  return out;
}

void SettingValues::row(const Setting& row, const std::string& value) {
  if (row.is_required && value.empty()) refuse(row.name, "nothing", std::string(row.doc));
  if (row.kind == Kind::choice && !value.empty() &&
      std::ranges::find(row.words, value) == row.words.end()) {
    const std::vector<std::string_view> words(row.words.begin(), row.words.end());
    config::fail({std::string(row.name), 0, 0}, "", config::in_quotes(value), config::either(words),
                 config::closest_in_quotes(value, words));
  }
  if (row.unit.empty()) return;
  quantities_.emplace_back(&value, row);
  (void)each(value, config::at_commas(value).size());
}

void SettingValues::row(const Setting& row, double value) {
  (void)config::number_setting(row.name, value, row.range);
}

void SettingValues::row(const Setting& row, const HeldOut& value) {
  const std::size_t count = value.texts.size() + value.tables.size();
  if (!row.is_repeated && count > 1) refuse(row.name, fmt::format("{} of them", count), "one");
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
  return config::quantity_setting(row.name, text, row.unit, atmosphere_, row.range);
}

std::optional<double> SettingValues::given(const std::string& member) const {
  return member.empty() ? std::nullopt : std::optional(of(member));
}

std::vector<double> SettingValues::each(const std::string& member, std::size_t tables) const {
  const Setting& row = row_of(member);
  std::vector<double> out;
  for (const std::string& piece : config::at_commas(member))
    out.push_back(config::quantity_setting(row.name, piece, row.unit, atmosphere_, row.range));
  if (out.size() == 1) out.resize(tables, out[0]);
  if (out.size() != tables)
    refuse(row.name, fmt::format("{} values", out.size()),
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

}  // namespace sinew::identify
