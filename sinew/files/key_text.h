// files/key_text.h - keys as people and programs read them: a table, JSON, a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/files/keys.h"

namespace sinew::files {

// Returns the kinds of files, and what stands at the top of each, within `width` letters, 0 for
// any.
std::string overview_of_keys(std::size_t width = 0);

// Returns a table for each kind of file, within `width` letters, 0 for any.
std::string text_of(const std::vector<Key>& keys, std::size_t width = 0);

// Returns an array of JSON, an object for each key; what a key does not have is left out.
std::string json_of(const std::vector<Key>& keys);

// Returns all keys as a page of Markdown, docs/reference/keys.md.
std::string page_of_keys();

// Returns a schema of JSON (draft 2020-12) by which editors complete and check a TOML file of that
// kind. It knows each key with its words and whether a quantity has a unit; which keys go together,
// and how large a quantity with a unit may be, only `sinew check` knows. Throws config::Error for a
// kind that there is not.
std::string schema_of(std::string_view kind);

}  // namespace sinew::files
