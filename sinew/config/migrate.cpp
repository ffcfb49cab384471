#include "sinew/config/migrate.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

namespace {

using Path = std::vector<std::string>;

// Scans a TOML text from left to right and keeps track of the current table.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  std::vector<KeyPlace> all() {
    Path table;
    for (skip_blank(true); !over(); skip_blank(true)) {
      const std::size_t before = at_;
      if (peek() == '[') {
        table = header();
      } else {
        pair(table);
      }
      if (at_ == before) ++at_;  // not valid TOML
    }
    return std::move(places_);
  }

 private:
  bool over() const { return at_ >= text_.size(); }
  char peek() const { return over() ? '\0' : text_[at_]; }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  // Skips blanks, and with `lines` also line ends and comments.
  void skip_blank(bool lines) {
    for (; !over(); ++at_) {
      const char c = text_[at_];
      if (lines && c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        if (over()) return;
      } else if (c != ' ' && c != '\t' && !(lines && (c == '\n' || c == '\r'))) {
        return;
      }
    }
  }

  // [a.b] or [[a.b]]
  Path header() {
    take('[');
    take('[');
    Path path;
    keys(path);
    skip_blank(false);
    take(']');
    take(']');
    return path;
  }

  // a.b = value
  void pair(Path path) {
    const std::size_t first = places_.size();
    keys(path);
    skip_blank(false);
    if (!take('=')) return;
    skip_blank(false);
    if (places_.size() > first && peek() != '{' && peek() != '[') places_.back().value = at_;
    value(path);
  }

  // Scans a dotted key and adds a place for each segment.
  void keys(Path& path) {
    do {
      skip_blank(false);
      const std::size_t begin = at_;
      path.push_back(key());
      places_.push_back({path, begin, at_, line_at(begin), 0});
      skip_blank(false);
    } while (take('.'));
  }

  std::string key() {
    const std::size_t begin = at_;
    if (peek() == '"' || peek() == '\'') {
      string();
      const std::size_t length = at_ - begin;
      return std::string(text_.substr(begin + 1, length < 2 ? 0 : length - 2));
    }
    while (!over() && text_.substr(at_, 1).find_first_of(" \t\r\n.=[]{},#\"'") == text_.npos) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  void value(const Path& path) {
    if (peek() == '"' || peek() == '\'') return string();
    if (take('[')) {
      for (skip_blank(true); !over() && !take(']'); skip_blank(true)) {
        const std::size_t before = at_;
        value(path);
        skip_blank(true);
        take(',');
        if (at_ == before) ++at_;
      }
      return;
    }
    if (take('{')) {
      for (skip_blank(true); !over() && !take('}'); skip_blank(true)) {
        const std::size_t before = at_;
        pair(path);
        skip_blank(true);
        take(',');
        if (at_ == before) ++at_;
      }
      return;
    }
    while (!over() && text_.substr(at_, 1).find_first_of(",]}#\r\n") == text_.npos) ++at_;
  }

  // Skips a string: "…", '…' or a multi-line one.
  void string() {
    const char quote = peek();
    const std::string three(3, quote);
    const bool many = text_.substr(at_, 3) == three;
    at_ += many ? 3 : 1;
    for (; !over(); ++at_) {
      if (quote == '"' && text_[at_] == '\\') {
        ++at_;
      } else if (many ? text_.substr(at_, 3) == three : text_[at_] == quote) {
        at_ += many ? 3 : 1;
        while (many && peek() == quote) ++at_;  // """a"""" ends with a quote of its text
        return;
      }
    }
  }

  int line_at(std::size_t place) {
    for (; counted_ < place; ++counted_) line_ += text_[counted_] == '\n';
    return line_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t counted_ = 0;
  int line_ = 1;
  std::vector<KeyPlace> places_;
};

}  // namespace

std::vector<KeyPlace> key_places(std::string_view text) { return Scanner(text).all(); }

std::string dotted(const Path& path) {
  std::string out;
  for (const std::string& segment : path) out += (out.empty() ? "" : ".") + segment;
  return out;
}

namespace {

// --- file without a format ---

// Returns the kind of the file's base, or else the one that its keys suggest.
std::string kind_without_format(const Node& root) {
  const Node* base = root.find("base");
  if (base && base->kind == Node::Kind::text) {
    namespace fs = std::filesystem;
    const fs::path file = fs::path(root.where.file).parent_path() / base->text;
    const Node* format = nullptr;
    Node read;
    if (std::error_code none; fs::is_regular_file(file, none)) {
      read = parse_file(file.string());
      format = read.find("format");
    }
    if (format) return std::string(format_of(format->text).kind);
  }
  return std::string(likely_kind(root));
}

// Returns the position after the comments at the start of the file, as in Sinew's own files.
std::size_t place_of_format(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (at < text.size()) {
    const std::size_t end = text.find('\n', at);
    if (text[at] != '#' || end == text.npos) break;
    at = end + 1;
  }
  return at;
}

void add_format(const std::string& kind, Migrated& out) {
  const std::size_t at = place_of_format(out.text);
  const bool dos = out.text.find("\r\n") != std::string::npos;
  const std::string line = fmt::format("format = \"sinew.{}/1\"", kind);
  const auto before = out.text.begin() + static_cast<std::ptrdiff_t>(at);
  out.edits.push_back({1 + static_cast<int>(std::count(out.text.begin(), before, '\n')), "", line});
  out.text.insert(at, line + (dos ? "\r\n" : "\n"));
}

// --- from one format number to the next ---

std::vector<const KeyChange*> changes_to(int number, std::string_view kind, const Changes& all) {
  std::vector<const KeyChange*> out;
  for (const KeyChange& change : all.keys)
    if (change.kind == kind && change.format == number) out.push_back(&change);
  return out;
}

// Returns the path with its last segment replaced by `to`.
std::string sibling_path(const std::vector<std::string>& path, std::string_view to) {
  const std::string table = dotted({path.begin(), path.end() - 1});
  return fmt::format("{}{}{}", table, table.empty() ? "" : ".", to);
}

void report_conflict(const KeyPlace& place, std::string_view text, std::string expected,
                     std::string try_this, Problems& problems) {
  const std::size_t line = text.rfind('\n', place.begin);
  const std::size_t column = line == text.npos ? place.begin : place.begin - line - 1;
  problems.add(place.line, static_cast<int>(column) + 1, dotted(place.path), "a key that is gone",
               std::move(expected), std::move(try_this));
}

// Applies a change to the text. The number of lines stays the same.
void apply(const KeyChange& change, Migrated& out, Problems& problems) {
  const std::vector<KeyPlace> places = key_places(out.text);
  std::set<std::string> mentioned;
  for (const KeyPlace& place : places) mentioned.insert(dotted(place.path));
  // Edits from the end, so that earlier positions remain valid.
  std::vector<Migrated::Edit> edits;
  for (std::size_t i = places.size(); i-- > 0;) {
    const KeyPlace& place = places[i];
    const std::string was = dotted(place.path);
    if (!matches(was, change.from)) continue;
    if (change.to.empty()) {
      report_conflict(place, out.text, std::string(change.why), "", problems);
      continue;
    }
    const std::string is = sibling_path(place.path, change.to);
    if (mentioned.contains(is)) {
      report_conflict(place, out.text, fmt::format("{} alone, which the file has too", is),
                      "to take one of them away", problems);
      continue;
    }
    out.text.replace(place.begin, place.end - place.begin, change.to);
    edits.push_back({place.line, was, is});
  }
  out.edits.insert(out.edits.end(), edits.rbegin(), edits.rend());
}

// Writes the format given by the kind and number in `out`.
void set_format(Migrated& out) {
  for (const KeyPlace& place : key_places(out.text)) {
    if (dotted(place.path) != "format") continue;
    const std::size_t begin = out.text.find("sinew.", place.value);
    const std::size_t end = out.text.find_first_not_of("0123456789", out.text.find('/', begin) + 1);
    const std::string is = fmt::format("sinew.{}/{}", out.kind, out.to);
    out.edits.push_back({place.line, out.text.substr(begin, end - begin), is});
    out.text.replace(begin, end - begin, is);
    return;
  }
}

// --- check of the result ---

// Lists all values with their keys, as written. Elements of a list have the list's key.
void list_values(const Node& node, const std::string& path,
                 std::vector<std::pair<std::string, std::string>>& out) {
  if (node.kind != Node::Kind::table && node.kind != Node::Kind::array)
    out.emplace_back(path, shown(node));
  for (const Node& child : node.children) {
    const bool dot = !path.empty() && !child.key.empty();
    list_values(child, path + (dot ? "." : "") + child.key, out);
  }
}

std::vector<std::pair<std::string, std::string>> values_of(std::string_view text,
                                                           const std::string& name) {
  std::vector<std::pair<std::string, std::string>> out;
  list_values(parse_text(text, name), "", out);
  std::erase_if(out, [](const auto& value) { return value.first == "format"; });
  return out;
}

std::string under_new_name(std::string path, const std::vector<Migrated::Edit>& edits) {
  for (const Migrated::Edit& edit : edits) {
    const bool below = path.starts_with(edit.was + ".");
    if (!edit.was.empty() && (path == edit.was || below))
      path = edit.is + path.substr(edit.was.size());
  }
  return path;
}

// Throws Error if a value was lost or changed: no file is better than a wrong one.
void require_same_values(std::string_view old_text, const std::string& name, const Migrated& out) {
  auto expected = values_of(old_text, name);
  for (auto& [path, value] : expected) path = under_new_name(std::move(path), out.edits);
  auto found = values_of(out.text, name);
  std::ranges::sort(expected);
  std::ranges::sort(found);
  if (expected == found) return;
  fail({name, 0, 0}, "", "a file whose keys cannot be renamed where they stand",
       "each of them in a line of its own",
       "by hand: docs/reference/versions.md lists what has changed");
}

}  // namespace

Migrated migrated(std::string_view text, const std::string& name, const Changes& changes) {
  const Node root = parse_text(text, name);
  Migrated out{.text = std::string(text)};
  if (!root.find("format")) {
    out.kind = kind_without_format(root);
    const Kind* kind = changes.find(out.kind);
    if (!kind) check_format(root, changes);  // throws
    add_format(out.kind, out);
    out.to = 1;
  } else {
    const Format format = check_format(root, changes);
    out.kind = format.kind;
    out.from = out.to = format.number;
  }

  out.was_kind = out.kind;
  const int first = std::max(out.from, 1);
  Problems problems(name, std::numeric_limits<std::size_t>::max());
  const auto update_keys = [&](const Kind& kind, int from) {
    out.to = from;
    while (out.to < kind.newest) {
      ++out.to;
      for (const KeyChange* change : changes_to(out.to, out.kind, changes))
        apply(*change, out, problems);
    }
  };
  const Kind& kind = *changes.find(out.kind);
  update_keys(kind, first);
  const bool replaced = !kind.now.empty();
  if (replaced) {
    out.kind = kind.now;
    update_keys(*changes.find(out.kind), 1);
  }
  problems.finish();
  if (replaced || out.to > first) set_format(out);
  require_same_values(text, name, out);
  return out;
}

}  // namespace sinew::config
