// identify/task/found.h - result of a method of identification, in the form that all methods share:
// its reports, its parameter files, and both as text, as JSON and as a page.
//
// The command line and Python use results through this class alone.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/shown_units.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/measured.h"
#include "sinew/json/json.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

using config::TextOptions;

// Appends formatted text.
template <class... Arguments>
void put(std::string& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
}

// Returns the number in this format; "-" if it is not finite.
std::string digits(double value, const char* format);

// A parameter file that a method makes.
struct ParameterFile {
  // Returns the text as it would be written at `out`. Throws config::Error, or Refusal if the data
  // do not support a file.
  std::function<std::string(const std::string& out)> at;
  std::string suffix = "";  // end of its name, added to that of the own file: "-225mm"
};

// Returns a file with this text.
ParameterFile file_with(std::string text);

// Returns a robot's file with these tables, over the robot at `base` if it is not empty.
ParameterFile part_of_robot(config::Node tables, std::string base);

// Lines for stderr.
struct Remarks {
  std::vector<std::string> notes;     // changes made to the data
  std::vector<std::string> warnings;  // possible faults
};

// Result of any method. A method adds its own values, which `add_text` prints.
struct Found {
  std::vector<Report> reports;       // for a page, the method's own first; empty: it has no law
  bool is_report_text = true;        // the text begins with the first report
  std::string title;                 // title of the page; empty: the first report's
  Remarks remarks;                   // for stderr
  Json json = Json::object();        // `--json`: SI, with the unit in the key; null if unknown
  std::vector<ParameterFile> files;  // the method's own first; empty: it makes none
  std::string refused;               // why there is a report but no file; empty: a file is possible
  bool fails = false;                // a script that uses this result is to stop

  // Appends to `out` what the method has besides a report; empty: nothing. `found` is this object.
  std::function<void(const Found& found, const TextOptions& how, std::string& out)> add_text;

  // Returns the result as text: the report, what the method adds, and what the data do not show.
  std::string text(const TextOptions& how = {}) const;
  // Returns the page of data from `sources`, with the values of the method's own file, as HTML.
  // Throws std::runtime_error if the library was built without its page.
  std::string page(const std::vector<Source>& sources, double atmosphere,
                   const std::string& version, const std::string& out = "") const;

  // Returns the text of a parameter file, as it would be written at `out`.
  std::string file(const std::string& out = "", std::size_t which = 0) const {
    return files.at(which).at(out);
  }
  // Returns the text of the method's own file; empty if it makes none, or if the data support none
  // and `out` names none.
  std::string own_file(const std::string& out) const;
};

// Has `put` print what `found` has besides a report.
template <class Own>
void prints(Own& found, void (*put)(const Own& found, const TextOptions& how, std::string& out)) {
  found.add_text = [put](const Found& base, const TextOptions& how, std::string& out) {
    put(static_cast<const Own&>(base), how, out);
  };
}

// Result of a method with one report.
template <class Result>
struct FoundBy : Found {
  Result result;

  FoundBy() = default;
  // Takes report, remarks and JSON from the result of the method.
  explicit FoundBy(Result found) : result(std::move(found)) {
    reports = {result.report};
    remarks = {result.report.notes, result.report.warnings};
    json = to_json(result.report);
  }
};

}  // namespace sinew::identify
