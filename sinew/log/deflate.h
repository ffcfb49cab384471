// log/deflate.h - bytes made smaller, in zlib's format (RFC 1950): what a browser's
// DecompressionStream("deflate") reads.
#pragma once

#include <string>
#include <string_view>

namespace sinew::log {

// The same bytes for the same input and the same zlib.
std::string deflated(std::string_view bytes);

// The way back. Throws std::invalid_argument for what deflated() did not write.
std::string inflated(std::string_view bytes);

}  // namespace sinew::log
