// config/utf8.h - is a text UTF-8? Names of files and foreign tables may be any bytes.
#pragma once

#include <string>
#include <string_view>

namespace sinew::config {

// Bytes of the letter that begins there; 0 where none does.
inline std::size_t letter_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  std::size_t length = 0;
  if (first < 0x80) length = 1;
  if (first >= 0xC2 && first < 0xE0) length = 2;
  if (first >= 0xE0 && first < 0xF0) length = 3;
  if (first >= 0xF0 && first < 0xF5) length = 4;
  if (at + length > text.size()) return 0;
  for (std::size_t i = at + 1; i < at + length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;

  // Longer than need be, halves of a pair, beyond the last one.
  if (first == 0xE0 && byte(at + 1) < 0xA0) return 0;
  if (first == 0xED && byte(at + 1) >= 0xA0) return 0;
  if (first == 0xF0 && byte(at + 1) < 0x90) return 0;
  if (first == 0xF4 && byte(at + 1) >= 0x90) return 0;
  return length;
}

// Returns the text without signs that turn the direction of writing, and without controls: names of
// foreign files are printed on terminals.
inline std::string without_controls(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    const auto begins = [&](std::string_view two, unsigned from, unsigned to) {
      const unsigned last = rest.size() > 2 ? static_cast<unsigned char>(rest[2]) : 0;
      return rest.starts_with(two) && last >= from && last <= to;
    };
    const bool turns = begins("\xE2\x80", 0x8E, 0x8F) || begins("\xE2\x80", 0xAA, 0xAE) ||
                       begins("\xE2\x81", 0xA6, 0xA9);
    const auto byte = static_cast<unsigned char>(rest[0]);
    const bool controls = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F;
    if (!turns && !controls) out += rest[0];
    at += turns ? 3 : 1;
  }
  return out;
}

// Each byte that is none becomes U+FFFD.
inline std::string in_utf8(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = letter_at(text, at);
    out += length > 0 ? text.substr(at, length) : std::string_view("\xEF\xBF\xBD");
    at += length > 0 ? length : 1;
  }
  return out;
}

}  // namespace sinew::config
