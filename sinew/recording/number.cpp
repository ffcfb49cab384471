#include "sinew/recording/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "sinew/units/spelling.h"

namespace sinew::recording {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr std::string_view minus = "\u2212";
// Blanks used as thousands separators: ASCII's, and the no-break and thin ones.
constexpr std::string_view blanks[] = {" ", "\u00A0", "\u202F", "\u2009"};

// Parses a number with known marks, with or without a sign: "-12.5e3".
std::optional<double> plain_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Returns the text with the typographic minus as a hyphen and, if required, without blanks.
std::string with_ascii(std::string_view text, bool without_blanks) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with(minus)) {
      out += '-';
      at += minus.size();
      continue;
    }
    const auto* blank = std::find_if(std::begin(blanks), std::end(blanks),
                                     [&](std::string_view b) { return rest.starts_with(b); });
    if (without_blanks && blank != std::end(blanks)) {
      out += ' ';
      at += blank->size();
      continue;
    }
    out += text[at++];
  }
  return out;
}

// Removes the marks from "1.234.567" if three digits follow each and none comes first.
std::optional<std::string> joined_thousands(std::string_view whole, char mark) {
  const bool sign = !whole.empty() && (whole[0] == '-' || whole[0] == '+');
  std::size_t at = sign ? 1 : 0, since = 0, groups = 0;
  std::string out(whole.substr(0, at));
  for (; at < whole.size(); ++at) {
    if (whole[at] == mark) {
      if (since == 0 || since > 3 || (groups > 0 && since != 3)) return std::nullopt;
      ++groups;
      since = 0;
      continue;
    }
    if (!is_digit(whole[at])) return std::nullopt;
    ++since;
    out += whole[at];
  }
  if (groups > 0 && since != 3) return std::nullopt;
  return out;
}

std::optional<double> parted_number(std::string_view text, NumberStyle style) {
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::size_t mark = std::min(text.substr(0, end).find(style.decimal), end);
  const auto whole = joined_thousands(text.substr(0, mark), style.thousands);
  if (!whole) return std::nullopt;
  std::string plain = *whole;
  plain.append(text.substr(mark));
  if (mark < end) plain[whole->size()] = '.';
  return plain_number(plain);
}

std::optional<double> comma_number(std::string_view text) {
  std::array<char, 64> buffer;
  if (text.size() > buffer.size() || text.find('.') != text.npos) return std::nullopt;
  std::ranges::replace_copy(text, buffer.begin(), ',', '.');
  return plain_number({buffer.data(), text.size()});
}

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr std::string_view missing_words[] = {
    "",        "-",       "--",        "---",      "nan",     "na",      "n/a",    "#nv",
    "#n/a",    "#na",     "null",      "none",     "ol",      "o.l.",    "o.l",    "overload",
    "inf",     "+inf",    "-inf",      "infinity", "-ol",     "+ol",     "-nan",   "#value!",
    "#wert!",  "#div/0!", "#ref!",     "#bezug!",  "1.#qnan", "-1.#ind", "1.#inf", "-1.#inf",
    "1,#qnan", "-1,#ind", "1,#inf",    "?",        "n.a.",    "k.a.",    "\u221E", "-infinity",
    "nil",     "missing", "-nan(ind)", "\u2013",   "\u2014"};

std::string with_mark(std::string_view text, std::size_t at, char mark) {
  std::string out(text);
  out[at] = mark;
  return out;
}

// Returns whether the only comma or point may be a thousands separator, judged by the digits around
// it.
bool can_part_thousands(std::string_view text, std::size_t mark) {
  const std::size_t first = text.find_first_of("0123456789");
  const std::size_t before = first < mark ? mark - first : 0;
  return before >= 1 && before <= 3 && text[first] != '0' && text.size() - mark == 4 &&
         std::ranges::all_of(text.substr(mark + 1), is_digit);
}

}  // namespace

std::optional<double> number_in(std::string_view text, NumberStyle style) {
  if (style.decimal == '.' && style.thousands == '\0')
    if (const auto value = plain_number(text)) return value;
  if (text.empty()) return std::nullopt;
  std::string ascii;
  const bool other = std::ranges::any_of(text, [](char c) { return (c & 0x80) != 0; });
  if (other) {
    ascii = with_ascii(text, style.thousands == ' ');
    text = ascii;
  }
  if (style.thousands != '\0' && text.find(style.thousands) != text.npos)
    return parted_number(text, style);
  return style.decimal == ',' ? comma_number(text) : plain_number(text);
}

bool is_missing(std::string_view text) {
  if (text.size() > 10) return false;
  std::array<char, 10> buffer;
  std::ranges::transform(text, buffer.begin(), small);
  const std::string_view word(buffer.data(), text.size());
  return std::ranges::find(missing_words, word) != std::end(missing_words);
}

SeparatorEvidence separator_evidence_in(std::string_view text) {
  SeparatorEvidence out;
  if (number_in(text)) {
    const std::size_t point = text.find('.');
    out.number = true;
    out.point = point != text.npos && !can_part_thousands(text, point);
    return out;
  }
  if (number_in(text, {','})) {
    const std::size_t comma = text.find(',');
    out.number = true;
    out.either = can_part_thousands(text, comma);
    out.comma = !out.either;
    return out;
  }
  for (const NumberStyle style :
       {NumberStyle{',', '.'}, {'.', ','}, {',', ' '}, {'.', ' '}, {',', '\''}, {'.', '\''}}) {
    if (!number_in(text, style)) continue;
    out.number = out.thousands = true;
    const bool both = text.find(style.decimal) != text.npos;
    out.comma = style.decimal == ',' && (both || style.thousands == '.');
    out.point = style.decimal == '.' && (both || style.thousands == ',');
    return out;
  }
  return out;
}

std::string hint_for(std::string_view text, NumberStyle style) {
  const SeparatorEvidence evidence = separator_evidence_in(text);
  const std::size_t point = text.find('.');
  if (style.decimal == ',' && point != text.npos && number_in(text))
    return can_part_thousands(text, point)
               ? std::string("thousands=\".\" if the point parts thousands")
               : fmt::format("a decimal comma, as in other rows: {}", with_mark(text, point, ','));
  if (evidence.either)
    return fmt::format("thousands=\",\" if the comma parts thousands, or a decimal point: {}",
                       with_mark(text, text.find(','), '.'));
  if (evidence.number && evidence.thousands) {
    for (const char mark : {'.', ',', '\''})
      if (const char other = mark == '.' ? ',' : '.'; number_in(text, {other, mark}))
        return fmt::format("thousands=\"{}\", the mark between groups of digits here", mark);
    return "thousands=\" \", the mark between groups of digits here";
  }
  if (evidence.comma)
    return fmt::format("a decimal point: {}", with_mark(text, text.find(','), '.'));
  const std::size_t blank = text.find_first_not_of("0123456789.,+-eE");
  if (blank != text.npos && blank > 0 && !units::spellings(text.substr(blank)).empty())
    return "the unit in the header alone, as in `force [N]`";
  return "";
}

}  // namespace sinew::recording
