// fmu/slave/description.h - file resources/model.txt of an FMU: kind of the model, and its numbers.
//
//   sinew fmu 1
//   kind = muscle
//   actuator.braid.turns = 2.3125
//   …
//   hash = 3f0c…        hash of all lines before
//
// Numbers are in SI with the digits that read back to the same bits. The hash protects against
// mistakes and damage, but not against attacks.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::fmu {

class Description {
 public:
  Description() = default;

  // Reads the file in the folder of resources. Throws std::runtime_error with the fault.
  static Description read(const std::filesystem::path& resources);
  // Parses the file's text, without the attached files.
  static Description parse(std::string_view text);

  // Returns the file's text, its hash last.
  std::string text() const;
  // Returns the hash of the text as 16 digits; equal descriptions have equal hashes.
  std::string hash() const;

  // Attaches a file of the same folder. read() reads attached files, and throws std::runtime_error
  // if one differs from the file attached when the description was written.
  void attach(const std::string& name, std::string text);
  // Returns the text of an attached file. Throws std::runtime_error if there is no such file.
  const std::string& file(const std::string& name) const;
  struct File {
    std::string name, text;
  };
  const std::vector<File>& attached() const { return files_; }

  // Adds a line. Several lines with the same key form a list.
  void add(std::string key, std::string value);
  // Returns the first value of the key; nullptr if the key is missing.
  const std::string* find(std::string_view key) const;
  // Returns the first value of the key. Throws std::runtime_error if the key is missing.
  const std::string& at(std::string_view key) const;
  std::vector<std::string> all(std::string_view key) const;
  // Returns the lines whose keys begin with `beginning`, without that part.
  std::vector<std::pair<std::string, std::string>> lines_of(std::string_view beginning) const;

 private:
  std::string lines() const;

  struct Line {
    std::string key, value;
  };
  std::vector<Line> lines_;
  std::vector<File> files_;  // in memory
};

// Returns the folder given by an importer: a path, or a file: URI, with percent signs decoded.
// Throws std::runtime_error for other URIs and for an empty one.
std::filesystem::path resource_folder(const char* location);

// Convert a number to text with the fewest digits that read back to the same bits, and back.
// `number_of` throws std::runtime_error, which names the key, for a text that is not a number.
std::string text_of(double number);
double number_of(std::string_view key, const std::string& text);

}  // namespace sinew::fmu
