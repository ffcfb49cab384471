// cli/json_text.h - JSON as text.
//
// Names of files are any bytes, and so may be the words of a foreign table; in JSON there is only
// UTF-8. What is none becomes U+FFFD.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sinew::cli {

template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sinew::cli
