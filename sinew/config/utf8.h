// config/utf8.h - check and repair of UTF-8, as file names and other programs' tables may hold
// any bytes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::config {

// Returns the number of bytes of the character at that position; 0 if it is not valid UTF-8.
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

  // Overlong forms, surrogates, and codes beyond the last character.
  if (first == 0xE0 && byte(at + 1) < 0xA0) return 0;
  if (first == 0xED && byte(at + 1) >= 0xA0) return 0;
  if (first == 0xF0 && byte(at + 1) < 0x90) return 0;
  if (first == 0xF4 && byte(at + 1) >= 0x90) return 0;
  return length;
}

// Returns the number of bytes of a bidirectional control character at that position, or 0.
inline std::size_t turn_at(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  const auto begins = [&](std::string_view two, unsigned from, unsigned to) {
    const unsigned last = rest.size() > 2 ? static_cast<unsigned char>(rest[2]) : 0;
    return rest.starts_with(two) && last >= from && last <= to;
  };
  const bool turns = begins("\xE2\x80", 0x8E, 0x8F) || begins("\xE2\x80", 0xAA, 0xAE) ||
                     begins("\xE2\x81", 0xA6, 0xA9);
  return turns ? 3 : 0;
}

// Returns the number of bytes of a control character at that position, U+0000 to U+001F or U+007F
// to U+009F; 0 if it is absent, or if it is in `kept`.
inline std::size_t control_at(std::string_view text, std::size_t at, std::string_view kept) {
  const auto byte = static_cast<unsigned char>(text[at]);
  if (byte < 0x20) return kept.find(text[at]) == kept.npos ? 1 : 0;
  if (byte == 0xC2 && letter_at(text, at) == 2)
    return static_cast<unsigned char>(text[at + 1]) < 0xA0 ? 2 : 0;
  return byte == 0x7F ? 1 : 0;
}

// Returns the text without bidirectional and other control characters, as names of files are
// printed on terminals.
inline std::string without_controls(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t left_out = std::max(turn_at(text, at), control_at(text, at, "\n\t"));
    if (left_out == 0) out += text[at];
    at += std::max<std::size_t>(left_out, 1);
  }
  return out;
}

// Appends the character of that code.
inline void append_letter(std::uint32_t code, std::string& out) {
  const auto byte = [&out](std::uint32_t b) { out += static_cast<char>(b); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xC0 | (code >> 6));
  } else if (code < 0x10000) {
    byte(0xE0 | (code >> 12));
    byte(0x80 | ((code >> 6) & 0x3F));
  } else {
    byte(0xF0 | (code >> 18));
    byte(0x80 | ((code >> 12) & 0x3F));
    byte(0x80 | ((code >> 6) & 0x3F));
  }
  byte(0x80 | (code & 0x3F));
}

// Replaces each byte that is not UTF-8 by U+FFFD.
inline std::string in_utf8(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = letter_at(text, at);
    out += length > 0 ? text.substr(at, length) : std::string_view("\xEF\xBF\xBD");
    at += length > 0 ? length : 1;
  }
  return out;
}

// Returns a text that is safe to print on a terminal, whatever bytes it quotes: bytes that are not
// UTF-8 become \xE9, control characters \x1B, and bidirectional ones their three bytes. Characters
// in `kept` remain.
inline std::string printable(std::string_view text, std::string_view kept = "\n\t") {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t letter = letter_at(text, at);
    const bool hidden = letter == 0 || turn_at(text, at) > 0 || control_at(text, at, kept) > 0;
    const std::size_t length = letter == 0 ? 1 : letter;
    for (const char c : text.substr(at, length)) {
      const auto b = static_cast<unsigned char>(c);
      if (hidden)
        out.append({'\\', 'x', digits[b >> 4], digits[b & 15]});
      else
        out += c;
    }
    at += length;
  }
  return out;
}

}  // namespace sinew::config
