// host/temporary_folder.h - a folder of a command's own for temporary files, removed with it.
#pragma once

#include <string>

namespace sinew::host {

// Makes a new folder, whose name begins so, in the folder that TMPDIR names, else in /tmp, and
// returns its path. Throws std::runtime_error, which names TMPDIR, where there cannot be one.
std::string make_temporary_folder(const std::string& name);

}  // namespace sinew::host
