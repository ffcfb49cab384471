// log/index.h - turns a finished row of messages into an indexed file, in which a viewer can jump.
#pragma once

#include <filesystem>

namespace sinew::log {

// Writes an indexed copy beside the file and renames it over the file, so that at any instant one
// of the two stands there whole. Throws Error; the file then is as it was.
void make_indexed(const std::filesystem::path& file);

}  // namespace sinew::log
