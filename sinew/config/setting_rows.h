// config/setting_rows.h - declaration of the settings of a calculation, one row for each.
//
// In addition to its struct of settings, a calculation has one function template:
//
//   template <class Visitor>
//   void fields(Visitor& v, GeometrySettings& s) {
//     v.method({"geometry", "thread length and turns of a braid"});
//     v.quantity({"side", "of one trapezoid", "m"}, s.side);
//   }
//
// The options of its command with their help, the keywords of Python with their docstrings and the
// checks of SettingValues come from these rows. Defaults are those of the struct. A visitor has
// these functions:
//
//   v.method(MethodRow)                           once, before the rows
//   v.quantity(Setting, std::string&)             text with a unit; empty: not given
//   v.quantities(Setting, std::string&)           one, or one for each table with commas between
//   v.integer(Setting, int&), v.number(Setting, double&)
//   v.flag(Setting, bool&)
//   v.choice(Setting, std::string&, words)        one of these words, or empty
//   v.text(Setting, std::string&)
//   v.file(Setting, std::string&)                 the path of a file
//   v.texts(Setting, std::vector<std::string>&)   one more each time that it is named
//   v.hold_out(Setting, HeldOut&)                 data that are not fitted (identify)
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/config/setting.h"
#include "sinew/json/json.h"

namespace sinew::config {

// Whether a method reads tables of measurements.
enum class Tables { needed, optional, none };

// Name and purpose of a method.
struct MethodRow {
  std::string_view name, doc;  // one line
  Tables tables = Tables::needed;
  std::size_t laws = 0;  // laws that it tries, for a progress bar; 0: unknown
};

// One setting.
struct Setting {
  // Kind of the value; the list of visitor functions above describes each.
  enum class Kind {
    quantity,
    quantities,
    number,
    integer,
    flag,
    choice,
    text,
    file,
    texts,
    hold_out
  };

  std::string_view name;       // as in messages; the option has hyphens
  std::string_view doc;        // one line
  std::string_view unit = "";  // SI, as in units/field.h; empty: depends on the data
  config::Range range = {};    // for a quantity or an integer

  // Set by the visitor's function; the functions below change them.
  Kind kind = Kind::text;
  std::vector<std::string> words = {};
  std::string_view option = name, keyword = name;
  bool is_required = false, is_repeated = false, is_at_commas = false, is_of_file = false;

  // Return the row with other names: on the command line, "start,set" for options or "RUN" for a
  // positional argument; and a keyword in Python.
  Setting called(std::string_view names) && { return option = names, std::move(*this); }
  Setting in_python(std::string_view other) && { return keyword = other, std::move(*this); }
  // Return the row of a setting that is required; that may be repeated; whose texts may be
  // joined by commas; and that concerns the parameter file only.
  Setting required() && { return is_required = true, std::move(*this); }
  Setting repeated() && { return is_repeated = true, std::move(*this); }
  Setting at_commas() && { return is_at_commas = true, std::move(*this); }
  Setting of_file() && { return is_of_file = true, std::move(*this); }
};

// Base of a visitor that only needs overloads of row(Setting, value) for the types of values.
template <class Visitor>
class RowVisitor {
 public:
  using Kind = Setting::Kind;
  // Forward a row and its value; the head of this file describes them.
  void method(const MethodRow& row) { (void)row; }
  void quantity(Setting row, std::string& value) { visit(Kind::quantity, row, value); }
  void quantities(Setting row, std::string& value) { visit(Kind::quantities, row, value); }
  void integer(Setting row, int& value) { visit(Kind::integer, row, value); }
  void number(Setting row, double& value) { visit(Kind::number, row, value); }
  void flag(Setting row, bool& value) { visit(Kind::flag, row, value); }
  void text(Setting row, std::string& value) { visit(Kind::text, row, value); }
  void file(Setting row, std::string& value) { visit(Kind::file, row, value); }
  void texts(Setting row, std::vector<std::string>& value) { visit(Kind::texts, row, value); }
  void hold_out(Setting row, auto& value) { visit(Kind::hold_out, row, value); }
  void choice(Setting row, std::string& value, std::vector<std::string> words) {
    row.words = std::move(words);
    visit(Kind::choice, row, value);
  }

 private:
  void visit(Kind kind, Setting& row, auto& value) {
    row.kind = kind;
    static_cast<Visitor&>(*this).row(row, value);
  }
};

// The settings of a method in SI. The constructor checks each row. It throws config::Error, which
// begins with the setting's name, for a value outside its range, a word that is not a choice, and a
// missing required setting.
class SettingValues : public RowVisitor<SettingValues> {
 public:
  // `atmosphere` is the ambient pressure of gauges [Pa]. `settings` must outlive this object.
  template <class Settings>
  explicit SettingValues(const Settings& settings, double atmosphere = units::atmosphere)
      : atmosphere_(atmosphere) {
    fields(*this, const_cast<Settings&>(settings));  // rows are only read
  }

  // Returns a quantity that is a member of the settings; NaN if not given. `text` is the default.
  double of(const std::string& member, std::string_view text = "") const;
  // Returns a quantity; empty if not given.
  std::optional<double> given(const std::string& member) const;
  // Returns quantities, one for each table. Throws config::Error for a different number.
  std::vector<double> each(const std::string& member, std::size_t tables) const;

  // Functions of the visitor.
  void row(const Setting& row, const std::string& value);
  void row(const Setting& row, double value);
  void row(const Setting& row, int value) { this->row(row, static_cast<double>(value)); }
  void row(const Setting& row, const auto& held_out) requires requires {
    held_out.texts, held_out.tables;
  }
  { check_one(row, held_out.texts.size() + held_out.tables.size()); }
  void row(const Setting& row, bool) { (void)row; }
  void row(const Setting& row, const std::vector<std::string>&) { (void)row; }

 private:
  const Setting& row_of(const std::string& member) const;
  static void check_one(const Setting& row, std::size_t count);

  double atmosphere_;
  std::vector<std::pair<const std::string*, Setting>> quantities_;
};

// Rows of a method as JSON: name, keyword, doc, unit, words and default of each setting.
class SettingList : public RowVisitor<SettingList> {
 public:
  // Collects the rows, with the values of `settings` as defaults.
  template <class Settings>
  explicit SettingList(Settings settings) {
    fields(*this, settings);
  }

  MethodRow of;
  Json rows = Json::array();

  // Functions of the visitor.
  void method(const MethodRow& row) { of = row; }
  void row(const Setting& row, const std::string& value);
  void row(const Setting& row, double value);
  void row(const Setting& row, int value) { this->row(row, std::to_string(value)); }
  void row(const Setting& row, const auto&) { this->row(row, std::string()); }
};

}  // namespace sinew::config
