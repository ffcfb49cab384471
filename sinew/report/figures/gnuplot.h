// report/figures/gnuplot.h - gnuplot as a process of its own, without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::report {

// Is there one on the PATH?
bool has_gnuplot();

// Runs each script of the folder in a process of its own, so that none sees what another one set,
// several at a time. Returns the scripts that failed; gnuplot's own words go to stderr.
std::vector<std::string> draw(const std::filesystem::path& folder,
                              const std::vector<std::string>& scripts);

// Takes the date out of a PDF that gnuplot has drawn, so that the same figure gives the same bytes.
void take_date_out(const std::filesystem::path& pdf);

}  // namespace sinew::report
