// files/key_text.h - listings of keys as tables, JSON, Markdown and JSON schema.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/files/keys.h"

namespace sinew::files {

// Returns the kinds of files and their top-level keys, in lines of at most `width` letters; 0: no
// limit.
std::string overview_of_keys(std::size_t width = 0);

// Returns a table for each kind of file, in lines of at most `width` letters; 0: no limit.
std::string text_of(const std::vector<Key>& keys, std::size_t width = 0);

// Returns a JSON array with an object for each key; properties that a key lacks are left out.
std::string json_of(const std::vector<Key>& keys);

// Returns the Markdown page of all keys, docs/reference/keys.md.
std::string page_of_keys();

// Returns a JSON schema (draft 2020-12) with which editors complete and check a TOML file of that
// kind. It covers each key, its choices, and whether a quantity has a unit; only `sinew check`
// checks combinations of keys and the range of quantities with a unit. Throws config::Error for an
// unknown kind.
std::string schema_of(std::string_view kind);

}  // namespace sinew::files
