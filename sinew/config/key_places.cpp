#include "sinew/config/key_places.h"

#include <algorithm>

namespace sinew::config {

namespace {

using Path = std::vector<std::string>;

// Reads from left to right, and remembers the table it is in.
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
      if (at_ == before) ++at_;  // this is no TOML
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

  // Blanks; with `lines` ends of lines and comments too.
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

  // The segments of a dotted key; each is a place.
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

  // "…", '…', and those of several lines.
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
        while (many && peek() == quote) ++at_;  // """a"""" ends with a quote of its own
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

}  // namespace sinew::config
