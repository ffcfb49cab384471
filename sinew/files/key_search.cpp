// files/key_search.cpp - a key by a real name or by words.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/files/keys.h"

namespace sinew::files {

namespace {

using Parts = std::vector<std::string>;

// "fault[0].at" as fault[] and at.
Parts parts_of(std::string_view path) {
  Parts out;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    std::string part(path.substr(from, dot - from));
    if (const std::size_t bracket = part.find('['); bracket != part.npos && part.ends_with(']')) {
      const std::string inside = part.substr(bracket + 1, part.size() - bracket - 2);
      const bool number = inside.find_first_not_of("0123456789") == inside.npos;
      if (number) part = part.substr(0, bracket) + "[]";
    }
    out.push_back(std::move(part));
    from = dot + 1;
  }
  return out;
}

std::string without_brackets(std::string_view part) {
  return std::string(part.ends_with("[]") ? part.substr(0, part.size() - 2) : part);
}

// Does the key begin with these parts? A list's brackets may be left out.
bool begins_as(const Parts& key, const Parts& path) {
  if (path.size() > key.size()) return false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (key[i] == "<name>" ? path[i].empty()
                           : without_brackets(key[i]) != without_brackets(path[i]))
      return false;
  }
  return true;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool has_word(const Key& key, const std::string& word) {
  if (lower(key.path).find(word) != std::string::npos) return true;
  if (lower(key.doc).find(word) != std::string::npos) return true;
  return std::ranges::any_of(key.choices, [&](const std::string& choice) {
    return lower(choice).find(word) != std::string::npos;
  });
}

// The keys that a word with a dot names, or those below it; none, where it names none.
std::vector<Key> named(const std::vector<Key>& among, std::string_view word) {
  std::vector<Key> exact, below;
  const Parts path = parts_of(word);
  for (const Key& key : among) {
    if (is_key(key, word) && key.type != KeyType::table && key.type != KeyType::tables &&
        key.type != KeyType::list)
      exact.push_back(key);
    if (begins_as(parts_of(key.path), path)) below.push_back(key);
  }
  return exact.empty() ? below : exact;
}

// The keys under the names that the word has: joint.hip.damping beside "joint.hip.dampnig".
std::string in_names_of(const Key& key, const Parts& word) {
  Parts path = parts_of(key.path);
  std::string out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == "<name>" && i < word.size() && !word[i].empty()) path[i] = word[i];
    out += (out.empty() ? "" : ".") + path[i];
  }
  return out;
}

// The nearest key to a word that no key has; without a dot, the nearest part of one.
std::string nearest(const std::vector<Key>& among, std::string_view word) {
  const bool path = word.find('.') != word.npos;
  const Parts names = parts_of(word);
  std::set<std::string> candidates;
  for (const Key& key : among) {
    if (path) {
      candidates.insert(in_names_of(key, names));
    } else {
      for (const std::string& part : parts_of(key.path))
        if (part != "<name>") candidates.insert(without_brackets(part));
    }
  }
  return std::string(config::closest(word, {candidates.begin(), candidates.end()}));
}

[[noreturn]] void refuse(const std::string& found, const std::string& expected,
                         const std::string& try_this) {
  config::fail({"keys", 0, 0}, "", found, expected, try_this);
}

std::vector<Key> with_word(const std::vector<Key>& among, const std::string& word) {
  if (word.find('.') != word.npos) {
    if (std::vector<Key> found = named(among, word); !found.empty()) return found;
  }
  std::vector<Key> out;
  const std::string small = lower(word);
  for (const Key& key : among)
    if (has_word(key, small)) out.push_back(key);
  return out;
}

}  // namespace

bool is_key(const Key& key, std::string_view path) {
  const Parts own = parts_of(key.path);
  Parts asked = parts_of(path);
  return own.size() == asked.size() && begins_as(own, asked);
}

std::vector<Key> find_keys(const std::vector<std::string>& words, std::string_view kind) {
  const std::vector<Key> all = kind.empty() ? keys() : keys_of(kind);
  const std::string where = kind.empty() ? "" : fmt::format(" of kind {}", kind);
  std::vector<Key> found = all;
  for (const std::string& word : words) {
    const std::vector<Key> with = with_word(all, word);
    if (with.empty() || word.empty()) {
      const std::string near = nearest(all, word);
      refuse(config::in_quotes(word),
             fmt::format("a key{}, the beginning of one, or a word of its description", where),
             near.empty() ? "sinew keys, for the tables" : near);
    }
    std::vector<Key> both;
    for (const Key& key : found)
      if (std::ranges::any_of(with, [&](const Key& other) {
            return other.kind == key.kind && other.path == key.path && other.when == key.when;
          }))
        both.push_back(key);
    if (both.empty())
      refuse(config::in_quotes(word),
             fmt::format("a word that a key{} has beside the others", where), "fewer words");
    found = std::move(both);
  }
  return found;
}

}  // namespace sinew::files
