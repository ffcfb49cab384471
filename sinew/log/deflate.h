// log/deflate.h - compression in zlib's format (RFC 1950), which a browser's
// DecompressionStream("deflate") reads.
#pragma once

#include <string>
#include <string_view>

namespace sinew::log {

// Returns the compressed bytes; the result is deterministic for one version of zlib.
std::string deflated(std::string_view bytes);

// Decompresses. Throws std::invalid_argument for bytes that deflated() did not write.
std::string inflated(std::string_view bytes);

}  // namespace sinew::log
