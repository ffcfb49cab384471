#include "fmu/slave/description.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "sinew/units/hash.h"
#include "sinew/units/letters.h"

namespace sinew::fmu {

namespace {

constexpr std::string_view first_line = "sinew fmu 1", last_key = "hash", file_name = "model.txt";

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error("resources/" + std::string(file_name) + ": " + what);
}

std::string sixteen_digits(std::uint64_t number) {
  std::string out(16, '0');
  for (std::size_t i = 16; i-- > 0; number >>= 4) out[i] = "0123456789abcdef"[number & 15];
  return out;
}

// Returns the text with a question mark for each character that is not printable ASCII.
std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  return out;
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file)
    throw std::runtime_error("found no file " + path.string() +
                             "; expected it in the unpacked FMU's folder of resources");
  return text.str();
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string without_percents(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
        hex_digit(text[i + 2]) >= 0) {
      out += static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2]));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace

std::string text_of(double number) {
  char out[32];
  return {out, std::to_chars(out, out + sizeof out, number).ptr};
}

double number_of(std::string_view key, const std::string& text) {
  double out = 0;
  const char* end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, out);
  if (error != std::errc() || after != end)
    refuse(std::string(key) + ": found \"" + text + "\"; expected a number");
  return out;
}

Description Description::parse(std::string_view text) {
  Description out;
  std::string stated;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (number == 0) {
      if (line != first_line)
        refuse("begins with \"" + printable(line.substr(0, 40)) + "\"; expected \"" +
               std::string(first_line) + "\": export the FMU again with this version");
      continue;
    }
    const std::size_t middle = line.find(" = ");
    if (middle == std::string_view::npos || !stated.empty())
      refuse("line " + std::to_string(number + 1) + " is no \"key = value\": the file is damaged");
    const std::string key(line.substr(0, middle)), value(line.substr(middle + 3));
    if (key == last_key)
      stated = value;
    else
      out.add(key, value);
  }
  if (number == 0) refuse("is empty");
  if (stated != out.hash())
    refuse("its hash is " + (stated.empty() ? "missing" : stated) + "; expected " + out.hash() +
           ": the file is cut off or was changed by hand; set parameters through the importer");
  return out;
}

Description Description::read(const std::filesystem::path& resources) {
  Description out = parse(read_text(resources / file_name));
  for (const auto& [name, hash] : out.lines_of("file.")) {
    std::string text = read_text(resources / name);
    if (sixteen_digits(units::hash(text)) != hash)
      throw std::runtime_error(
          "resources/" + name +
          ": the file is cut off or was changed by hand; export the FMU again");
    out.files_.push_back({name, std::move(text)});
  }
  return out;
}

std::string Description::lines() const {
  std::string out(first_line);
  out += '\n';
  for (const Line& line : lines_) out += line.key + " = " + line.value + "\n";
  return out;
}

std::string Description::hash() const { return sixteen_digits(units::hash(lines())); }

std::string Description::text() const {
  return lines() + std::string(last_key) + " = " + hash() + "\n";
}

void Description::attach(const std::string& name, std::string text) {
  add("file." + name, sixteen_digits(units::hash(text)));
  files_.push_back({name, std::move(text)});
}

const std::string& Description::file(const std::string& name) const {
  for (const File& file : files_)
    if (file.name == name) return file.text;
  throw std::runtime_error("resources: found no file " + name);
}

void Description::add(std::string key, std::string value) {
  lines_.push_back({std::move(key), std::move(value)});
}

const std::string* Description::find(std::string_view key) const {
  for (const Line& line : lines_)
    if (line.key == key) return &line.value;
  return nullptr;
}

const std::string& Description::at(std::string_view key) const {
  if (const std::string* found = find(key)) return *found;
  refuse("has no " + std::string(key));
}

std::vector<std::string> Description::all(std::string_view key) const {
  std::vector<std::string> out;
  for (const Line& line : lines_)
    if (line.key == key) out.push_back(line.value);
  return out;
}

std::vector<std::pair<std::string, std::string>> Description::lines_of(
    std::string_view beginning) const {
  std::vector<std::pair<std::string, std::string>> out;
  for (const Line& line : lines_)
    if (line.key.starts_with(beginning))
      out.emplace_back(line.key.substr(beginning.size()), line.value);
  return out;
}

std::filesystem::path resource_folder(const char* location) {
  if (!location || !*location)
    throw std::runtime_error(
        "found no place of resources; expected a file: URI or a path of the unpacked FMU's "
        "resources");
  const std::string_view text(location);
  const bool is_file = text.size() > 5 && units::lower(text.substr(0, 5)) == "file:";
  if (!is_file) {
    if (text.find("://") != std::string_view::npos)
      throw std::runtime_error("found resources at \"" + std::string(text) +
                               "\"; expected a file: URI or a path");
    return std::string(text);
  }
  std::string_view path = text.substr(5);
  if (path.starts_with("//")) {
    path.remove_prefix(2);
    if (path.starts_with("localhost/")) path.remove_prefix(9);
  }
  return without_percents(path);
}

}  // namespace sinew::fmu
