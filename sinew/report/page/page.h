// report/page/page.h - a run as one self-contained page: report.html, which opens offline.
//
//   const analysis::Analysis analysis(table, analysis::read_machine(resolved));
//   const std::string html = page({.analysis = analysis, .resolved = resolved});
//
// The design is in web/ and is bundled into one template when the program is built; this folder
// fills it. The page computes nothing: series, poses, figures and verdicts are all made here.
// A run gives the same bytes from memory and from its log.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"
#include "sinew/json/json.h"
#include "sinew/report/page/plot.h"

namespace sinew::report {

struct Run {
  const analysis::Analysis& analysis;  // results of the log
  const config::Node& resolved;        // resolved.toml
  std::string name;                    // name of the experiment; empty if unknown
  std::string units{};                 // requested units, read by config/shown_units.h
};

// Returns whether the program was built with its page, which requires npm.
bool has_page();

// Throws std::runtime_error with instructions if the program was built without its page; `file` is
// the name of the page that would have been written.
void require_page(std::string_view file);

// Returns the page. Throws config::Error for a resolved.toml that cannot be read, and
// std::runtime_error with instructions if the program was built without its page.
std::string page(const Run& run);

// Content of a page: a JSON object and the samples (content.h).
struct Content {
  std::string title;
  std::string json;
  std::string samples;
  std::string connect{};  // end of the page's security policy: "; connect-src ws://127.0.0.1:8080"
  std::string units{};    // JSON (content.h); empty: by the environment and the user's settings
};
Content content(const Run& run);

// Fills a template. It has @title@, @run@ and @samples@ once each: in its <title>, in a script
// element of type application/json and in one of another type; the texts are escaped so that they
// cannot leave their element. A page with a connection also has @connect@ at the end of its policy,
// and one that shows quantities has @units@ in a script element of type application/json. Throws
// std::invalid_argument for a template that lacks one of the first three, or @connect@ if
// `content.connect` is given.
std::string fill(std::string_view page_template, const Content& content);

// --- Pages that the build bundles web/ into ---

// Return a page's template; empty if the program was built without npm.
std::string_view page_template();        // one run
std::string_view comparison_template();  // several runs
std::string_view fit_template();         // an identification
std::string_view design_template();      // a design
std::string_view study_template();       // a sweep or a tuning, or two of them
std::string_view run_list_template();    // the runs in a folder

// Escapes text for use between tags and in attributes with double quotes.
std::string escaped(std::string_view text);

// Result of a design calculation as one self-contained page: numbers with their intervals, tables
// and plots.
struct DesignPage {
  std::string title;
  std::string version;    // version of the program
  double atmosphere = 0;  // reference of gauge pressures [Pa]
  Json values, tables;    // lists; numbers in SI with their units
  std::vector<Plot> plots;
  std::string refused;  // why no design is possible; empty: there is one
  std::vector<std::string> notes, warnings;
  std::vector<std::string> unseen;  // limits of the result, in sentences
};

// Returns the page. Throws std::runtime_error if the program was built without its pages.
std::string page(const DesignPage& design);

}  // namespace sinew::report
