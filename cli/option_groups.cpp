#include "cli/option_groups.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/recording/source.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

void add_units(CLI::App& sub, std::string& units, const std::string& of) {
  const auto wrong = [](const std::string& text) {
    return config::parse_shown_units(text, {}, ""), "";
  };
  sub.add_option("--units", units,
                 "UNITS: si, thesis, metric, or with changes (metric,length=cm): units of " + of)
      ->transform(passes(wrong));
}

config::UnitsToShow chosen_units(const std::string& option, units::UnitSet otherwise,
                                 const config::Node* run) {
  return config::units_to_show({.now = option, .now_is = "--units", .run = run}, otherwise);
}

config::UnitsToShow chosen_units(const std::string& option, units::UnitSet otherwise,
                                 const std::filesystem::path& resolved) {
  if (!std::filesystem::exists(resolved)) return chosen_units(option, otherwise);
  const config::Node run = config::parse_file(resolved.string());
  return chosen_units(option, otherwise, &run);
}

void add_machine(CLI::App& sub, std::string& machine) {
  sub.add_option("--machine", machine, "FILE: machine of a single run; default: its resolved.toml");
}

template <class Settings>
void add_table_options(CLI::App& sub, TableOptions& options, Settings& settings) {
  const auto add = [&](const char* name, auto& value, const char* text) {
    return sub.add_option(name, value, text)->group(table_heading);
  };
  const auto add_each = [&](const char* name, std::vector<std::string>& values, const char* text) {
    add(name, values, text)->allow_extra_args(false);
  };
  add_each("--map", options.maps,
           "NAME=COLUMN: column of the file that is a column of the method, force=F_N, or a "
           "channel, /joint/elbow/angle=Winkel");
  add_each("--unit", options.units, "COLUMN=UNIT: unit of a column whose header has none");
  add_each("--where", options.where,
           "COLUMN=VALUE,...: read only rows whose column has one of these values");
  add_each("--value", options.values,
           "[PART:]NAME=VALUE: value of a column or channel that a file lacks, \"length=80 mm\"; "
           "with PART, only for files with PART in their name, \"p2:pressure=2 bar gauge\"");
  add_each("--offset", options.offsets,
           "NAME=VALUE: offset of the method's (import: the file's) column, \"length=200 mm\"");
  add("--columns", options.columns,
      "HEADER: header of a file without one, \"force [N],time [s]\"; see `sinew identify columns`");
  add("--rate", options.rate,
      "RATE: rate or interval of rows, \"100 Hz\" or \"10 ms\", in place of a column of times");
  add("--part", settings.part, "number of one of several recordings in a file; the first is 1")
      ->transform(between(1, 1000000));
  sub.add_flag("--spread-times", settings.spread_times,
               "spread rows that share a time evenly up to the next time")
      ->group(table_heading);
  sub.add_flag("--drop-incomplete", settings.drop_incomplete,
               "leave out rows with cells that are empty or not numbers, and count them")
      ->group(table_heading);
  add("--encoding", settings.encoding, "encoding of a file, where its letters do not show it")
      ->check(one_of({"utf-8", "utf-16le", "utf-16be", "latin1"}));
  add("--decimal", settings.decimal, "decimal mark, where the numbers do not show it")
      ->check(one_of({".", ","}));
  add("--thousands", settings.thousands, "mark between groups of three digits")
      ->check(one_of({".", ",", " ", "'"}));
  add("--dates", settings.dates, "order of dates such as 11/03/2026, or excel for days since 1900")
      ->check(one_of({"day first", "month first", "excel"}));
}

template void add_table_options(CLI::App&, TableOptions&, recording::TableSettings&);
template void add_table_options(CLI::App&, TableOptions&, recording::Source&);

Pairs pairs_of(const char* option, const std::vector<std::string>& texts, Equals separator,
               const char* expected) {
  Pairs out;
  for (const std::string& text : texts) {
    const std::size_t at = separator == Equals::first ? text.find('=') : text.rfind('=');
    if (at == text.npos || at == 0 || at + 1 == text.size())
      config::fail({option, 0, 0}, "", config::in_quotes(text), expected);
    out.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  return out;
}

void write_output(const std::string& file, const std::string& text, bool quiet) {
  if (file.empty()) return;
  run::write_file(file, text);
  Messages(quiet).note(fmt::format("{}: written", file));
}

void SettingOptions::row(const Row& row, std::string& value) {
  CLI::Option* option = add(row, value);
  if (row.is_required) option->required();
  if (!row.words.empty()) option->check(one_of(row.words));
  if (!value.empty()) option->capture_default_str();
}

void SettingOptions::row(const Row& row, bool& value) {
  sub_.add_flag(names_of(row), value, std::string(row.doc));
}

void SettingOptions::row(const Row& row, std::vector<std::string>& value) {
  CLI::Option* option = add(row, value)->allow_extra_args(false);
  if (row.is_at_commas) option->delimiter(',');
}

void SettingOptions::row(const Row& row, identify::HeldOut& value) {
  CLI::Option* option = add(row, value.texts);
  row.is_repeated ? option->allow_extra_args(false) : option->expected(1);
}

std::string SettingOptions::names_of(const Row& row) {
  if (std::isupper(static_cast<unsigned char>(row.option[0]))) return std::string(row.option);
  std::string out;
  for (const std::string& name : config::at_commas(std::string(row.option)))
    out += (out.empty() ? "--" : ",--") + name;
  std::ranges::replace(out, '_', '-');
  return out;
}

std::string SettingOptions::help_of(const Row& row) {
  const bool file = row.kind == Row::Kind::file && row.option == row.name;  // no argument
  const bool quantity = row.kind == Row::Kind::quantity || row.kind == Row::Kind::quantities;
  return (file ? "FILE: " : quantity ? "QUANTITY: " : "") + std::string(row.doc);
}

}  // namespace sinew::cli
