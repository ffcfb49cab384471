// cli/identify.h - what the files of `sinew identify` share: cli/identify.cpp has the methods with
// their options, cli/identify_print.cpp what is printed, cli/identify_columns.cpp their columns.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "sinew/identify/task/methods.h"

namespace sinew::cli {

void add_identify_columns(CLI::App& identify, Action& action);

// A file that may be replaced with --force: one that contains `mark`, in which
// as in the file no blank counts. Measurements of
// another origin stay.
struct Replaceable {
  std::string_view what, name;  // "page of `sinew identify`", "such a page"
  std::string_view mark;
  std::string_view ending = "";  // that a name should have, ".csv"
  std::string_view otherwise = "another one";
};
// Throws config::Error for a file that exists already, before the work begins; with `force` for one
// that is not replaceable, and for one of `inputs`.
void refuse_to_replace(const std::string& path, bool force, const Replaceable& old,
                       const std::vector<std::string>& inputs = {});

// In which units numbers are shown.
struct PrintOptions {
  std::string units;      // those of --units; empty: the method's own
  double atmosphere = 0;  // that gauges read against [Pa]
};

// Prints a report on stdout: its laws, and the parameters of the chosen one.
void print_report(const identify::Report& report, const PrintOptions& how);

// Prints the last paragraph of a report: what it does not show.
void print_unseen(const identify::Report& report);

// Print what a method has besides a report.
template <class Found>
void print_more(const Found&, const PrintOptions&) {}
void print_more(const identify::GeometryFound& found, const PrintOptions& how);
void print_more(const identify::SensorFound& found, const PrintOptions& how);
void print_more(const identify::DynamicFound& found, const PrintOptions& how);
void print_more(const identify::JointFound& found, const PrintOptions& how);
void print_more(const identify::PairFound& found, const PrintOptions& how);
void print_more(const identify::Checkup& found, const PrintOptions& how);
void print_more(const identify::RunFitFound& found, const PrintOptions& how);
void print_more(const identify::ScaleFound& found, const PrintOptions& how);
void print_more(const identify::PlanFound& found, const PrintOptions& how);

}  // namespace sinew::cli
