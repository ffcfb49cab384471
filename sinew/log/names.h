// log/names.h - the words that Sinew's logs use and that its writer and its reader must share.
#pragma once

#include <string_view>

namespace sinew::log {

inline constexpr std::string_view kSchemaEncoding = "jsonschema";
inline constexpr std::string_view kMessageEncoding = "json";
inline constexpr std::string_view kRunMetadata = "sinew.run";  // the record that says what was run

// Metadata of a channel: "unit.<field>" says in which unit a field is.
inline constexpr std::string_view kUnit = "unit.";
// A topic whose value never changes is written once, and says here: the topic at whose times it
// stands.
inline constexpr std::string_view kSteady = "sinew.steady";

}  // namespace sinew::log
