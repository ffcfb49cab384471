// identify/task/settings.h - the settings of a method of identification: one row for each.
//
// In addition to its struct of settings a method has one function template,
//
//   template <class Visitor>
//   void fields(Visitor& v, GeometrySettings& s) {
//     v.method({"geometry", "thread length and turns of a braid"});
//     v.quantity({"side", "of one trapezoid", "m"}, s.side);
//   }
//
// The options of `sinew identify` with their help, the keywords of Python with their docstrings and
// the checks of SettingValues come from these rows. Defaults are those of the struct. A visitor
// has:
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
//   v.hold_out(Setting, HeldOut&)
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/config/setting.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/wish.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Whether a method reads tables of measurements.
enum class Tables { needed, optional, none };

// A part of the data that is not fitted and scores the laws.
struct HeldOut {
  std::vector<std::string> texts;  // a rule of the method, such as "pressure", or files
  std::vector<Source> tables;      // in place of files

  bool empty() const { return texts.empty() && tables.empty(); }
};

// A method's name and what it is for.
struct MethodRow {
  std::string_view name, doc;  // one line
  Tables tables = Tables::needed;
  std::size_t laws = 0;  // that it tries, for a bar of progress; 0: unknown
};

// One setting.
struct Setting {
  // The kind of its value; the visitor's functions above describe each.
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

  std::string_view name;       // in messages; the option has hyphens
  std::string_view doc;        // one line
  std::string_view unit = "";  // of a quantity: SI, as in units/field.h; empty: known with the data
  config::Range range = {};    // of a quantity or an integer

  // The visitor's function sets these; the functions below change them.
  Kind kind = Kind::text;
  std::vector<std::string> words = {};
  std::string_view option = name, keyword = name;
  bool is_required = false, is_repeated = false, is_at_commas = false, is_of_file = false;

  // Return the row with other names: "start,set" on the command line, "RUN" for a word without an
  // option; and a name in Python.
  Setting called(std::string_view names) && { return option = names, std::move(*this); }
  Setting in_python(std::string_view other) && { return keyword = other, std::move(*this); }
  // Return the row of a setting that is always needed; that may be named several times; whose texts
  // may be in one, with commas between; and that concerns the parameter file alone.
  Setting required() && { return is_required = true, std::move(*this); }
  Setting repeated() && { return is_repeated = true, std::move(*this); }
  Setting at_commas() && { return is_at_commas = true, std::move(*this); }
  Setting of_file() && { return is_of_file = true, std::move(*this); }
};

// Base of a visitor that has overloads of row(Setting, value) for the types of values alone.
template <class Visitor>
class RowVisitor {
 public:
  using Kind = Setting::Kind;
  // Pass a row and its value on; the head of this file describes them.
  void method(const MethodRow& row) { (void)row; }
  void quantity(Setting row, std::string& value) { visit(Kind::quantity, row, value); }
  void quantities(Setting row, std::string& value) { visit(Kind::quantities, row, value); }
  void integer(Setting row, int& value) { visit(Kind::integer, row, value); }
  void number(Setting row, double& value) { visit(Kind::number, row, value); }
  void flag(Setting row, bool& value) { visit(Kind::flag, row, value); }
  void text(Setting row, std::string& value) { visit(Kind::text, row, value); }
  void file(Setting row, std::string& value) { visit(Kind::file, row, value); }
  void texts(Setting row, std::vector<std::string>& value) { visit(Kind::texts, row, value); }
  void hold_out(Setting row, HeldOut& value) { visit(Kind::hold_out, row, value); }
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

// Returns the tables that are held out: those of `hold_out`, and its texts as files that are read
// like the first one, except `words`, which are rules of the method. Throws config::Error for a
// file that is fitted, unless it `may_be_fitted`: then it is held out although it is among them.
std::vector<Source> held_out_tables(const HeldOut& hold_out, const std::vector<Source>& sources,
                                    std::span<const std::string_view> words = {},
                                    bool may_be_fitted = false);

// The rows of what is known of parameters, the same for each method.
template <class Visitor>
void fields(Visitor& v, WishTexts& wishes) {
  v.texts({"freeze", "NAME=VALUE: a parameter that is known and not fitted"}, wishes.freeze);
  v.texts({"prior", "NAME=VALUE±DEVIATION: what is known of a parameter, and how well"},
          wishes.prior);
  v.texts({"tie", "NAME=OTHER: two parameters that are one"}, wishes.tie);
}

// The settings of a method in SI. The constructor checks each row: it throws config::Error, which
// begins with the setting's name, for a quantity or a number outside its range, a word that is not
// among those of its choice, and for what is needed and missing.
class SettingValues : public RowVisitor<SettingValues> {
 public:
  // `atmosphere` [Pa] is the pressure that gauges read against. `settings` has to outlive this.
  template <class Settings>
  explicit SettingValues(const Settings& settings, double atmosphere = units::atmosphere)
      : atmosphere_(atmosphere) {
    fields(*this, const_cast<Settings&>(settings));  // rows are read alone
  }

  // Returns a quantity, a member of the settings; NaN where it was not given. `text` takes the
  // place of one that was not given.
  double of(const std::string& member, std::string_view text = "") const;
  // The same, nothing in place of NaN.
  std::optional<double> given(const std::string& member) const;
  // Returns quantities: one for each of the tables. Throws config::Error for another number.
  std::vector<double> each(const std::string& member, std::size_t tables) const;

  // The visitor's part.
  void row(const Setting& row, const std::string& value);
  void row(const Setting& row, double value);
  void row(const Setting& row, int value) { this->row(row, static_cast<double>(value)); }
  void row(const Setting& row, const HeldOut& value);
  void row(const Setting& row, bool) { (void)row; }
  void row(const Setting& row, const std::vector<std::string>&) { (void)row; }

 private:
  const Setting& row_of(const std::string& member) const;

  double atmosphere_;
  std::vector<std::pair<const std::string*, Setting>> quantities_;
};

// The rows of a method as JSON: name, keyword, doc, unit, words and default of each setting.
class SettingList : public RowVisitor<SettingList> {
 public:
  // Takes the rows with the values of `settings` as defaults.
  template <class Settings>
  explicit SettingList(Settings settings) {
    fields(*this, settings);
  }

  MethodRow of;
  Json rows = Json::array();

  // The visitor's part.
  void method(const MethodRow& row) { of = row; }
  void row(const Setting& row, const std::string& value);
  void row(const Setting& row, double value);
  void row(const Setting& row, int value) { this->row(row, std::to_string(value)); }
  void row(const Setting& row, const auto&) { this->row(row, std::string()); }
};

}  // namespace sinew::identify
