// cli/settings.h - the library's settings as the options of this program.
//
// The library has no command line: its messages name a setting as `force=true`, `full_scale="10
// V"`, `names.load=NAME`, and a problem with a setting begins with its name, `units: found …`.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace sinew::cli {

// Returns the text with each setting as its option: `--force`, `--full-scale "10 V"`,
// `--map load=NAME`, `--unit: found …`. Text between double quotes stays: a user wrote it.
std::string as_options(std::string_view text);

// Returns whether the error concerns values of options alone.
bool is_of_option(const std::exception& error);

}  // namespace sinew::cli
