// identify/task/tables.h - tables that the methods read. The other files of this folder contain one
// method each: from tables and settings, as users give them, to the result and its parameter file.
// They are used by `sinew identify` and Python.
//
// A setting is a text such as "6 lb"; errors begin with its name: "mass: found …".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

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

}  // namespace sinew::identify
