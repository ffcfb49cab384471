// cli/identify.h - what the methods of `sinew identify` share: how data are read, how a report is
// shown, where the parameter file goes.
//
// A method has one file, cli/identify_<method>.cpp, with add_identify_<method>; what it knows about
// its method stands in sinew/identify.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/table_options.h"
#include "cli/terminal.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/wish.h"
#include "sinew/json/json.h"

namespace sinew::identify {
struct StaticSettings;
}

namespace sinew::cli {

void add_identify_geometry(Command identify, Action& action);
void add_identify_sensor(Command identify, Action& action);
void add_identify_dynamic(Command identify, Action& action);
void add_identify_joint(Command identify, Action& action);
void add_identify_pair(Command identify, Action& action);
void add_identify_valve(Command identify, Action& action);
void add_identify_static(Command identify, Action& action);
void add_identify_creep(Command identify, Action& action);
void add_identify_check(Command identify, Action& action);
void add_identify_scale(Command identify, Action& action);
void add_identify_plan(Command identify, Action& action);
void add_identify_run(Command identify, Action& action);

// How files of measurements are read.
struct DataOptions {
  std::vector<std::string> files;
  TableOptions table;
  std::string template_file;  // of the help alone: see cli/identify_columns.h
  std::string atmosphere = "14.7 psi";
};
void add_data_options(Command sub, DataOptions& options);

// The rest length of a muscle, of `static`, `check` and `plan`.
void add_rest_length(Command sub, std::string& rest_length);

// What files do not say of a muscle and its measurement, and which of their points are fitted: of
// `static` and `check`.
void add_static_data_options(Command sub, identify::StaticSettings& settings);

// What is known of parameters before they are fitted: frozen, prior, tied.
void add_wish_options(Command sub, identify::WishTexts& wishes);

// One source per file. A --value may also be of the files that are held out. Throws config::Error
// for what is no name=value, and for a --value of no file.
std::vector<identify::Source> sources_of(const DataOptions& options,
                                         const std::vector<std::string>& held_out = {});

// What is done with a result.
struct ResultOptions {
  std::string out;     // the parameter file
  std::string report;  // the page; empty: beside `out`
  std::string units;   // of what is printed; empty: SI
  bool json = false, force = false, quiet = false, no_report = false;
};
void add_result_options(Command sub, ResultOptions& options);
void add_report_options(Command sub, ResultOptions& options);  // in it; of methods without a file

// The page that is to be written: the one that was asked for, or the parameter file's name with
// .html; empty: none.
std::string page_of(const ResultOptions& options);

// Refuses a parameter file or a page that is there already, before the work begins; with --force a
// file that is none.
void check_result_options(const ResultOptions& options);

// Writes the parameter file where one is wanted, and says so.
void write_parameter_file(const std::string& text, const ResultOptions& options);

// Calls `find` with a counter of models that have been tried, and shows it on a terminal.
template <class Find>
auto watched(std::size_t models, bool quiet, const Find& find) {
  host::Tally tried = 0;
  const ProgressBar bar(tried, static_cast<std::int64_t>(models), {.unit = "laws"}, quiet);
  return find(tried);
}

// Prints the report, as words or as JSON, `json` in its place, and writes the parameter file and
// the page where they are wanted. Notes and warnings go to stderr.
void tell(const identify::Report& report, const std::string& parameter_file,
          const DataOptions& data, const ResultOptions& options, const Json& json = {});

}  // namespace sinew::cli
