// identify/task/settings.h - what the settings of methods of identification share
// (config/setting_rows.h): tables, data that are held out, and constraints on parameters. The other
// files of this folder contain one method each: from tables and settings, as users give them, to
// the result and its parameter file. They are used by `sinew identify` and Python.
//
// A setting is a text such as "6 lb"; errors begin with its name: "mass: found …".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/setting_rows.h"
#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/data/measured.h"

namespace sinew::identify {

using config::MethodRow;
using config::Setting;
using config::SettingList;
using config::SettingValues;
using config::Tables;

// Data that are not fitted and score the laws.
struct HeldOut {
  std::vector<std::string> texts;  // a rule of the method, such as "pressure", or files
  std::vector<Source> tables;      // tables instead of files

  bool empty() const { return texts.empty() && tables.empty(); }
};

// Returns the tables that are held out: those of `hold_out`, and its texts as files that are read
// like the first source, except `words`, which are rules of the method. Throws config::Error for a
// file that is fitted.
std::vector<Source> held_out_tables(const HeldOut& hold_out, const std::vector<Source>& sources,
                                    std::span<const std::string_view> words = {});

// A table that is fitted, or held out.
struct MarkedSource {
  Source source;
  bool held_out = false;
};
// Returns the sources, of which those that `hold_out` names are held out, and its other tables.
// Throws config::Error if there is no source.
std::vector<MarkedSource> marked_tables(const HeldOut& hold_out,
                                        const std::vector<Source>& sources);
// Returns a source like `how` for each file. Throws config::Error for a file that is given twice:
// its rows would make every interval too narrow and invalidate hold-out tests.
std::vector<Source> sources_of(const std::vector<std::string>& files, const Source& how);

// Returns the only table. Throws config::Error if there are others.
const Source& only_of(const std::vector<Source>& sources);

// Throws config::Error if the file of this setting is a source that is fitted.
void refuse_fitted(const std::vector<Source>& sources, std::string_view setting,
                   const std::string& file);

// Returns "sinew identify METHOD a.csv b.csv: LAW", the origin of a result.
std::string source_words(std::string_view method, const std::vector<Source>& sources,
                         std::string_view law);

// Returns the files and reading options for a page: "a.csv", "column force=F_N".
std::vector<std::string> words_of(const std::vector<Source>& sources);

// Returns the absolute ambient pressure [Pa] from a text such as "14.7 psi". Throws config::Error.
double atmosphere_setting(const std::string& text);

// Visits the constraints on parameters, which are the same for each method.
template <class Visitor>
void fields(Visitor& v, ConstraintTexts& constraints) {
  v.texts({"freeze", "NAME=VALUE: known value of a parameter, which is not fitted"},
          constraints.freeze);
  v.texts({"prior", "NAME=VALUE±DEVIATION: prior of a parameter, with its standard deviation"},
          constraints.prior);
  v.texts({"tie", "NAME=OTHER: two parameters that have one value"}, constraints.tie);
}

}  // namespace sinew::identify
