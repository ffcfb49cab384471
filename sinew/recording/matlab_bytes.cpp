#include "sinew/recording/matlab_bytes.h"

#include <fmt/format.h>

#include <cstdint>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/matlab.h"

namespace sinew::recording {

namespace {

constexpr std::size_t header = 128;  // of level 5 [B]

std::uint32_t word(std::string_view bytes, std::size_t at, bool big) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i)
    out |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + (big ? 3 - i : i)]))
           << (8 * i);
  return out;
}

[[noreturn]] void cut_off(const std::string& path, std::size_t size) {
  config::fail({path, 0, 0}, "",
               fmt::format("a MAT file that ends within a variable, after {} bytes", size),
               "a whole one", "to copy it again, or to save it anew");
}

// Elements stand one behind the other: a type, how many bytes, these bytes; within a matrix each
// begins at a multiple of eight, and up to four bytes stand beside their type. A matrix is made of
// elements, which may be matrices: fields of a struct.
void check_elements(std::string_view bytes, bool within, bool big, const std::string& path,
                    std::size_t size) {
  constexpr std::uint32_t matrix = 14;
  while (!bytes.empty()) {
    if (bytes.size() < 8) cut_off(path, size);
    const std::uint32_t type = word(bytes, 0, big);
    const bool small = within && type >> 16 != 0;
    const std::size_t length = small ? 0 : word(bytes, 4, big);
    const std::size_t padded = within ? (length + 7) / 8 * 8 : length;
    if (padded > bytes.size() - 8) cut_off(path, size);
    if (!small && type == matrix) check_elements(bytes.substr(8, length), true, big, path, size);
    bytes.remove_prefix(8 + padded);
  }
}

void check_level_5(std::string_view bytes, const std::string& path) {
  if (bytes.size() < header) cut_off(path, bytes.size());
  check_elements(bytes.substr(header), false, bytes.substr(126, 2) == "MI", path, bytes.size());
}

// Level 4 has no name in it: its numbers have to make sense. A variable is five words - what the
// numbers are, rows, columns, whether they are complex, letters of the name - then the name, then
// the numbers.
bool is_level_4(std::string_view bytes) {
  constexpr std::size_t head = 20;
  if (bytes.size() < head) return false;
  const std::uint32_t little = word(bytes, 0, false),
                      type = little > 9999 ? word(bytes, 0, true) : little;
  const bool big = little > 9999;
  const std::uint32_t rows = word(bytes, 4, big), columns = word(bytes, 8, big);
  const std::uint32_t complex = word(bytes, 12, big), letters = word(bytes, 16, big);
  const std::uint32_t number = type / 10 % 10, kind = type % 10;
  const std::size_t sizes[] = {8, 4, 4, 2, 2, 1};
  if (type > 4059 || type / 100 % 10 != 0 || number > 5 || kind > 2) return false;
  if (complex > 1 || letters < 2 || letters > 256) return false;
  if (bytes.size() < head + letters || bytes[head + letters - 1] != '\0') return false;
  const double values = static_cast<double>(rows) * columns * (complex + 1);
  return values * static_cast<double>(sizes[number]) <=
         static_cast<double>(bytes.size() - head - letters);
}

}  // namespace

bool is_matlab(std::string_view bytes) {
  return bytes.starts_with("MATLAB 5.0 MAT-file") || bytes.starts_with("MATLAB 7.3 MAT-file");
}

void check_matlab_bytes(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("MATLAB 5.0 MAT-file")) return check_level_5(bytes, path);
  if (is_matlab(bytes) || is_level_4(bytes)) return;
  if (bytes.starts_with("\x89HDF"))
    config::fail({path, 0, 0}, "", "an HDF5 file, without MATLAB's words before it",
                 "a MAT file of level 4, 5 or 7.3", "save('file.mat', '-v7') in MATLAB");
  std::string begin;
  for (const char c : bytes.substr(0, 24)) begin += c >= ' ' && c <= '~' ? c : '.';
  config::fail({path, 0, 0}, "",
               fmt::format("a file that begins with {}", config::in_quotes(begin)),
               "a MAT file of level 4, 5 or 7.3",
               "a name with the ending of what it is, .csv for a table of text");
}

}  // namespace sinew::recording
