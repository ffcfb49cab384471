// identify/task/settings.h - the settings of a method of identification: one row for each.
//
// Beside its struct of settings a method has one function template,
//
//   template <class Visitor>
//   void fields(Visitor& v, GeometrySettings& s) {
//     v.method({.name = "geometry", .doc = "thread length and turns …"});
//     v.quantity({.name = "side", .unit = "m", .doc = "of one trapezoid"}, s.side);
//   }
//
// The options of `sinew identify` with their help, the keywords of Python with their docstrings and
// the checks of SettingValues come from these rows. Defaults are those of the struct. A visitor
// has:
//
//   v.method(MethodRow)                           once, before the rows
//   v.quantity(Setting, std::string&)             text with a unit; empty: not given
//   v.quantities(Setting, std::string&)           one, or one for each table with commas between
//   v.integer(Setting, int&)
//   v.flag(Setting, bool&)
//   v.choice(Setting, std::string&)               one of the row's words, or empty
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

// A method's name and what it is for.
struct MethodRow {
  std::string_view name;
  std::string_view doc;  // one line
  Tables tables = Tables::needed;
  bool has_file = true;  // it makes a parameter file
  std::size_t laws = 0;  // that it tries, for a bar of progress; 0: unknown
};

// One setting.
struct Setting {
  std::string_view name;       // in messages; the option has hyphens
  std::string_view unit = "";  // of a quantity: SI, as in units/field.h; empty: known with the data
  config::Range range = {};    // of a quantity or an integer
  std::string_view doc;        // one line
  std::vector<std::string> words = {};  // of a choice
  // Names on the command line, where they are others: "start,set"; "RUN" for a word without one.
  std::string_view option = "";
  std::string_view keyword = "";  // name in Python, where it is another
  bool required = false;
  bool repeats = false;    // what is held out may be named several times
  bool at_commas = false;  // texts may stand in one, with commas between
  bool of_file = false;    // concerns the parameter file alone, so that one has to be written
};

// What is not fitted and scores the laws.
struct HeldOut {
  std::vector<std::string> texts;  // a rule of the method, such as "pressure", or files
  std::vector<Source> tables;      // in place of files

  bool empty() const { return texts.empty() && tables.empty(); }
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
  v.texts({.name = "freeze", .doc = "NAME=VALUE: a parameter that is known and not fitted"},
          wishes.freeze);
  v.texts(
      {.name = "prior", .doc = "NAME=VALUE±DEVIATION: what is known of a parameter, and how well"},
      wishes.prior);
  v.texts({.name = "tie", .doc = "NAME=OTHER: two parameters that are one"}, wishes.tie);
}

// The settings of a method in SI. The constructor is a visitor that checks each row: it throws
// config::Error, which begins with the setting's name, for a quantity or a number that is outside
// its range, a word that is not among those of its choice, and for what is needed and missing.
class SettingValues {
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
  void method(const MethodRow& row) { (void)row; }
  void quantity(const Setting& row, const std::string& value);
  void quantities(const Setting& row, const std::string& value);
  void integer(const Setting& row, int value);
  void flag(const Setting& row, bool value) { (void)row, (void)value; }
  void choice(const Setting& row, const std::string& value);
  void text(const Setting& row, const std::string& value);
  void file(const Setting& row, const std::string& value) { text(row, value); }
  void texts(const Setting& row, const std::vector<std::string>& value) { (void)row, (void)value; }
  void hold_out(const Setting& row, const HeldOut& value);

 private:
  const Setting& row_of(const std::string& member) const;

  double atmosphere_;
  std::vector<std::pair<const std::string*, Setting>> quantities_;
};

// Rows as JSON, for programs that list them: name, keyword, doc, unit, words, default. A visitor.
class SettingList {
 public:
  template <class Settings>
  explicit SettingList(Settings settings) {
    fields(*this, settings);
  }

  const MethodRow& row() const { return method_; }
  const Json& settings() const { return list_; }

  // The visitor's part.
  void method(const MethodRow& row) { method_ = row; }
  void quantity(const Setting& row, const std::string& value) { add(row, value); }
  void quantities(const Setting& row, const std::string& value) { add(row, value); }
  void integer(const Setting& row, int value) { add(row, std::to_string(value)); }
  void flag(const Setting& row, bool) { add(row, ""); }
  void choice(const Setting& row, const std::string& value) { add(row, value); }
  void text(const Setting& row, const std::string& value) { add(row, value); }
  void file(const Setting& row, const std::string& value) { add(row, value); }
  void texts(const Setting& row, const std::vector<std::string>&) { add(row, ""); }
  void hold_out(const Setting& row, const HeldOut&) { add(row, ""); }

 private:
  void add(const Setting& row, const std::string& value);

  MethodRow method_;
  Json list_ = Json::array();
};

}  // namespace sinew::identify
