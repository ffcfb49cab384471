// host/temporary_folder.h - creation of a folder for temporary files.
#pragma once

#include <string>

namespace sinew::host {

// Creates a folder with a name that begins with `name`, in the folder TMPDIR or else in /tmp, and
// returns its path. Throws std::runtime_error if it cannot be created.
std::string make_temporary_folder(const std::string& name);

}  // namespace sinew::host
