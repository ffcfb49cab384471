// identify/task/tables.h - the tables that a method is asked about. The other files of this folder
// have a method each: from tables and settings, as a person gives them, to what was found and its
// parameter file. `sinew identify` and Python ask them.
//
// A setting is a text, "6 lb"; what is wrong with one is told by its name: "mass: found …".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Returns a source like `how` for each file. Throws config::Error for one that is there twice:
// its rows would make every interval too narrow, and hold nothing out.
std::vector<Source> sources_of(const std::vector<std::string>& files, const Source& how);

// Returns the only table. Throws config::Error where there are others.
const Source& only_of(const std::vector<Source>& sources);

// Throws config::Error where the setting's file is one of those that are fitted.
void refuse_fitted(const std::vector<Source>& sources, std::string_view setting,
                   const std::string& file);

// Returns "sinew identify METHOD a.csv b.csv: LAW", the source of what was found.
std::string source_words(std::string_view method, const std::vector<Source>& sources,
                         std::string_view law);

// Returns what is read, and how, in sentences for a page: "a.csv", "column force=F_N".
std::vector<std::string> words_of(const std::vector<Source>& sources);

// Returns the pressure that gauges read against, "14.7 psi", absolute  [Pa]. Throws config::Error.
double atmosphere_setting(const std::string& text);

}  // namespace sinew::identify
