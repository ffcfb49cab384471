// recording/matlab_bytes.h - is a file MATLAB's, and all of it there? Looked at before the library
// that reads it, which takes a file that was cut off for one with fewer variables.
#pragma once

#include <string>
#include <string_view>

namespace sinew::recording {

// Throws config::Error for a file that is no MAT file, or that ends within a variable.
void check_matlab_bytes(std::string_view bytes, const std::string& path);

}  // namespace sinew::recording
