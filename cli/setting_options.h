// cli/setting_options.h - the rows of a method's settings as options of a command.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "cli/command.h"
#include "sinew/identify/task/settings.h"

namespace sinew::cli {

// Adds an option for each row. A visitor of identify/task/settings.h.
class SettingOptions : public identify::RowVisitor<SettingOptions> {
 public:
  using Row = identify::Setting;
  explicit SettingOptions(CLI::App& sub) : sub_(sub) {}

  void row(const Row& row, std::string& value) {
    CLI::Option* option = sub_.add_option(names_of(row), value, std::string(row.doc));
    if (row.is_required) option->required();
    if (!row.words.empty()) option->check(one_of(row.words));
    if (!value.empty()) option->capture_default_str();
  }
  void row(const Row& row, int& value) {
    sub_.add_option(names_of(row), value, std::string(row.doc))->capture_default_str();
  }
  void row(const Row& row, double& value) {
    sub_.add_option(names_of(row), value, std::string(row.doc))->capture_default_str();
  }
  void row(const Row& row, bool& value) {
    sub_.add_flag(names_of(row), value, std::string(row.doc));
  }
  void row(const Row& row, std::vector<std::string>& value) {
    CLI::Option* option =
        sub_.add_option(names_of(row), value, std::string(row.doc))->allow_extra_args(false);
    if (row.is_at_commas) option->delimiter(',');
  }
  void row(const Row& row, identify::HeldOut& value) {
    CLI::Option* option = sub_.add_option(names_of(row), value.texts, std::string(row.doc));
    row.is_repeated ? option->allow_extra_args(false) : option->expected(1);
  }

 private:
  static std::string names_of(const Row& row) {
    if (std::isupper(static_cast<unsigned char>(row.option[0]))) return std::string(row.option);
    std::string out;
    for (const std::string& name : config::at_commas(std::string(row.option)))
      out += (out.empty() ? "--" : ",--") + name;
    std::ranges::replace(out, '_', '-');
    return out;
  }

  CLI::App& sub_;
};

}  // namespace sinew::cli
