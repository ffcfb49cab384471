// report/page/page.h - a run as one self-contained page: report.html, which opens offline.
//
//   const analysis::Analysis analysis(table, analysis::read_machine(resolved));
//   const std::string html = page({.analysis = analysis, .resolved = resolved});
//
// The look stands in web/ and is bundled into one template when the program is built; this folder
// fills it. The page computes nothing: series, poses, figures and verdicts are all made here.
// The same run gives the same bytes, whether from memory or from its log.
#pragma once

#include <string>
#include <string_view>

#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"

namespace sinew::report {

struct Run {
  const analysis::Analysis& analysis;  // of what was logged
  const config::Node& resolved;        // resolved.toml
  std::string name;                    // of the experiment; empty where nobody knows
  std::string units{};                 // asked for now, as config/shown_units.h reads it
};

// Was the program built with its page? Without npm there is none.
bool has_page();

// Throws std::runtime_error, with what to do, where there is none; `file` would have been it.
void require_page(std::string_view file);

// Throws config::Error for a resolved.toml that cannot be read, and std::runtime_error, with what
// to do, where the program was built without its page.
std::string page(const Run& run);

// The run's part of the page: a JSON object and the samples (content.h).
struct Content {
  std::string title;
  std::string json;
  std::string samples;
  std::string connect{};  // ends the page's security policy: "; connect-src ws://127.0.0.1:8080"
  std::string units{};    // JSON (content.h); empty: by environment and the person's settings
};
Content content(const Run& run);

// A template has @title@, @run@ and @samples@ once each: in its <title>, in a script element of
// type application/json and in one of another type. Whatever the texts hold cannot leave its
// element. Throws std::invalid_argument for a template that lacks one. A page that is to connect to
// somewhere has @connect@, too, at the end of its policy, and one that shows quantities @units@, in
// a script element of type application/json.
std::string fill(std::string_view page_template, const Content& content);

// The pages that web/ is bundled into, by the build.

// All are empty where the program was built without npm.
std::string_view page_template();        // of one run
std::string_view comparison_template();  // of several
std::string_view fit_template();         // of an identification
std::string_view study_template();       // of a sweep or a tuning, or of two
std::string_view run_list_template();    // of the runs in a folder

// Returns what makes a film of a run's page, to be run in it; empty as above.
std::string_view film_script();

}  // namespace sinew::report
