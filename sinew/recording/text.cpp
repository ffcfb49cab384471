#include "sinew/recording/text.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "sinew/config/diagnostics.h"
#include "sinew/config/text_file.h"
#include "sinew/config/utf8.h"
#include "sinew/log/csv.h"
#include "sinew/log/reader.h"

namespace sinew::recording {

namespace {

constexpr std::string_view table_of_text = "a table as text, such as CSV";

// Files that are not text, recognised by their first bytes.
struct FileSignature {
  std::string_view begin, what, try_this;
};
using namespace std::string_view_literals;
constexpr std::string_view save_as_csv = "to save the sheet as CSV in the program that made it";
constexpr FileSignature known_files[] = {
    {"\xD0\xCF\x11\xE0"sv, "an Excel workbook (.xls)", save_as_csv},
    {"MATLAB 5.0"sv, "a file of MATLAB (.mat)", "writetable(T, 'file.csv') in MATLAB"},
    {"\x89HDF"sv, "an HDF5 file, as MATLAB 7.3 writes them too",
     "writetable(T, 'file.csv') in MATLAB, or pandas' to_csv"},
    {"TDSm"sv, "a TDMS file of LabVIEW", "to export it as text or CSV"},
    {"\x1F\x8B"sv, "a file packed by gzip", "gunzip, which unpacks it"},
    {"BZh"sv, "a file packed by bzip2", "bunzip2, which unpacks it"},
    {"\xFD"
     "7zXZ"sv,
     "a file packed by xz", "unxz, which unpacks it"},
    {"7z\xBC\xAF"sv, "an archive (.7z)", "to unpack it"},
    {"\x89MCAP"sv, "a log in MCAP", "`time [s]` and the columns as CSV, which `export` writes"},
    {"version https://git-lfs"sv, "a pointer of git-lfs, without the file's content",
     "git lfs pull, which fetches it"},
    {"PAR1"sv, "a Parquet file", "pandas' to_csv"},
    {"SQLite format 3"sv, "an SQLite database", "a query whose rows are saved as CSV"},
    {"\x93NUMPY"sv, "an array of NumPy (.npy)", "numpy.savetxt with a header and delimiter=','"},
    {"%PDF"sv, "a PDF", "the table that it shows, saved as CSV"},
    {"#ROSBAG"sv, "a ROS bag", "its topics, exported as CSV"},
    {"ULog"sv, "a ULog of PX4", "ulog2csv, which writes tables"},
    {"<!DOCTYPE"sv, "a web page", "the table that it shows, saved as CSV"},
    {"<html"sv, "a web page", "the table that it shows, saved as CSV"},
    {"<?xml"sv, "an XML file", save_as_csv},
};

void refuse_archive(std::string_view bytes, const std::string& file) {
  if (!bytes.starts_with("PK\x03\x04") && !bytes.starts_with("PK\x05\x06")) return;
  const std::string_view begin = bytes.substr(0, 8192);
  const bool excel = begin.find("xl/") != begin.npos || file.ends_with(".xlsx") ||
                     begin.find("[Content_Types].xml") != begin.npos;
  const bool calc = begin.find("opendocument.spreadsheet") != begin.npos;
  const std::string_view what = calc    ? "a workbook of LibreOffice (.ods)"
                                : excel ? "an Excel workbook (.xlsx)"
                                        : "an archive (.zip)";
  config::fail({file, 0, 0}, "", std::string(what), std::string(table_of_text),
               std::string(calc || excel ? save_as_csv : "to unpack it"));
}

void refuse_other_files(std::string_view bytes, const std::string& file) {
  refuse_archive(bytes, file);
  for (const FileSignature& known : known_files)
    if (bytes.starts_with(known.begin))
      config::fail({file, 0, 0}, "", std::string(known.what), std::string(table_of_text),
                   std::string(known.try_this));
}

// Returns the line and column of a byte.
config::Location place_of(const std::string& file, std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t newline = before.rfind('\n');
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return {file, static_cast<int>(line),
          static_cast<int>(newline == before.npos ? at + 1 : at - newline)};
}

// Returns the first byte that is not UTF-8, or the text's length. Most text is ASCII, which is
// checked in steps of eight bytes.
std::size_t first_other_byte(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    std::uint64_t eight = 0;
    while (at + sizeof eight <= text.size()) {
      std::memcpy(&eight, text.data() + at, sizeof eight);
      if ((eight & 0x8080808080808080u) != 0) break;
      at += sizeof eight;
    }
    if (at >= text.size()) break;
    const std::size_t length = config::letter_at(text, at);
    if (length == 0) return at;
    at += length;
  }
  return text.size();
}

// Windows-1252 characters where Latin-1 has none: the euro, quotes, dashes.
constexpr std::uint32_t windows_letters[32] = {
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

std::string from_latin1(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 16);
  for (const char c : bytes) {
    const std::uint32_t code = static_cast<unsigned char>(c);
    config::append_letter(code >= 0x80 && code < 0xA0 ? windows_letters[code - 0x80] : code, out);
  }
  return out;
}

[[noreturn]] void refuse_half_letter(const std::string& file) {
  config::fail({file, 0, 0}, "", "UTF-16 with half a letter", "a table in UTF-8 or UTF-16",
               "to save it again as UTF-8");
}

std::string from_utf16(std::string_view bytes, bool little_end_first, const std::string& file) {
  const auto unit = [&](std::size_t at) {
    const std::uint32_t first = static_cast<unsigned char>(bytes[at]);
    const std::uint32_t second = static_cast<unsigned char>(bytes[at + 1]);
    return little_end_first ? first | (second << 8) : (first << 8) | second;
  };
  std::string out;
  out.reserve(bytes.size() / 2 + bytes.size() / 32);
  const std::size_t end = bytes.size() - bytes.size() % 2;
  for (std::size_t at = 0; at < end; at += 2) {
    std::uint32_t code = unit(at);
    if (code >= 0xDC00 && code < 0xE000) refuse_half_letter(file);
    if (code >= 0xD800 && code < 0xDC00) {
      at += 2;
      if (at >= end || unit(at) < 0xDC00 || unit(at) >= 0xE000) refuse_half_letter(file);
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(at) - 0xDC00);
    }
    config::append_letter(code, out);
  }
  return out;
}

// Returns the kind of UTF-16, or "". ASCII characters have one zero byte each, always on the same
// side.
std::string_view utf16_of(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return "utf-16le";
  if (bytes.starts_with("\xFE\xFF")) return "utf-16be";
  const std::string_view begin = bytes.substr(0, 512);
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < begin.size(); ++i)
    if (begin[i] == '\0') ++zeros[i % 2];
  const std::size_t pairs = begin.size() / 2;
  if (pairs < 4) return "";
  if (zeros[1] > pairs / 2 && zeros[0] == 0) return "utf-16le";
  if (zeros[0] > pairs / 2 && zeros[1] == 0) return "utf-16be";
  return "";
}

// Removes zeros at the end, which loggers leave when they lose power; zeros elsewhere are a fault.
void refuse_zeros(Text& text, const std::string& file) {
  const std::size_t zero = text.utf8.find('\0');
  if (zero == std::string::npos) return;
  if (text.utf8.find_first_not_of('\0', zero) == std::string::npos) {
    text.notes.push_back(
        fmt::format("{} zero bytes at the end: left out, as a logger leaves them "
                    "whose power went",
                    text.utf8.size() - zero));
    text.utf8.resize(zero);
    return;
  }
  config::fail(place_of(file, text.utf8, zero), "", "a zero byte", std::string(table_of_text),
               "another copy of the file: this one is damaged, or no table");
}

// Returns whether the bytes may be Shift-JIS: lead bytes 81 to 9F, which Latin-1 does not use,
// before a second byte.
bool is_shift_jis(std::string_view bytes) {
  std::size_t pairs = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const auto byte = [&](std::size_t i) {
      return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
    };
    const unsigned first = byte(at), second = byte(at + 1);
    if (first < 0x80 || (first >= 0xA1 && first <= 0xDF)) continue;
    const bool leads = (first >= 0x81 && first <= 0x9F) || (first >= 0xE0 && first <= 0xFC);
    if (!leads || second < 0x40 || second == 0x7F || second > 0xFC) return false;
    pairs += first <= 0x9F ? 1 : 0;
    ++at;
  }
  return pairs > 1;
}

void refuse_other_encodings(const std::string& utf8, const std::string& file) {
  const std::size_t at = first_other_byte(utf8);
  if (at == utf8.size()) return;
  config::fail(place_of(file, utf8, at), "",
               fmt::format("a byte {:02x} that is no UTF-8", static_cast<unsigned char>(utf8[at])),
               "a table in UTF-8",
               is_shift_jis(utf8) ? "iconv -f SHIFT_JIS -t UTF-8, as it appears to be Shift-JIS"
                                  : "encoding=latin1, or iconv -f LATIN1 -t UTF-8");
}

// Returns the size that memory can hold, or 0 if it is unknown. A table needs memory for its text
// and 8 bytes per cell; cells are seldom shorter.
double most_of_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return 0;
  return 0.4 * static_cast<double>(pages) * static_cast<double>(page);
}

std::string size_text(double bytes) {
  return bytes < 1e8 ? fmt::format("{:.1f} MB", bytes / 1e6)
                     : fmt::format("{:.1f} GB", bytes / 1e9);
}

void refuse_too_large(const std::string& path, double largest) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  const double most = largest > 0 ? largest : most_of_memory();
  if (none || most <= 0 || static_cast<double>(size) <= most) return;
  config::fail({path, 0, 0}, "", "a file of " + size_text(static_cast<double>(size)),
               fmt::format("at most {}, which this computer's memory can take", size_text(most)),
               "every tenth row (awk 'NR == 1 || NR % 10 == 0'), or the part that matters");
}

std::string bytes_of_file(const std::string& path, std::string_view what, double largest) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none))
    return config::read_text_file(path, std::string(what));  // a pipe, or a missing file
  refuse_too_large(path, largest);
  std::ifstream file(path, std::ios::binary);
  std::string bytes;
  if (file) {
    bytes.resize(std::filesystem::file_size(path, none));
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  }
  if (!file && bytes.empty()) return config::read_text_file(path, std::string(what));
  return bytes;
}

// Returns the table that `sinew export` writes for the run, or the one that a test stand has saved.
std::string text_of_run(const std::filesystem::path& folder, std::string_view what) {
  const std::filesystem::path mcap = folder / "log.mcap", table = folder / "measured.csv";
  if (std::filesystem::exists(mcap)) {
    std::ostringstream out;
    log::write_csv(log::read(mcap), out);
    return std::move(out).str();
  }
  if (std::filesystem::exists(table))
    return bytes_of_file(table.string(), "measurements of a test stand", 0);
  return config::read_text_file(folder.string(),
                                fmt::format("{}, or a run's folder with log.mcap", what));
}

}  // namespace

Text text_of_bytes(std::string bytes, const std::string& file, std::string_view encoding) {
  refuse_other_files(bytes, file);
  Text out;
  const std::string_view mark = utf16_of(bytes);
  const std::string_view is = encoding.empty() ? mark : encoding;
  if (is.starts_with("utf-16")) {
    const bool marked = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
    out.utf8 = from_utf16(std::string_view(bytes).substr(marked ? 2 : 0), is != "utf-16be", file);
  } else if (is == "latin1") {
    out.utf8 = from_latin1(bytes);
  } else {
    out.utf8 = std::move(bytes);
  }
  if (out.utf8.starts_with("\xEF\xBB\xBF")) out.utf8.erase(0, 3);  // a byte order mark
  refuse_zeros(out, file);
  refuse_other_encodings(out.utf8, file);
  return out;
}

std::string text_of(const Source& source, std::string_view what) {
  if (source.text) return *source.text;
  const std::filesystem::path path(source.path);
  if (std::filesystem::is_directory(path)) return text_of_run(path, what);
  return bytes_of_file(source.path, what, source.largest);
}

}  // namespace sinew::recording
