// fmu/slave/description.h - the file resources/model.txt of an FMU: which model it is, and its
// numbers.
//
//   sinew fmu 1
//   kind = muscle
//   actuator.braid.turns = 2.3125
//   …
//   hash = 3f0c…        of all lines before it
//
// Numbers are SI, written so that reading gives the same bits. The hash is against mistakes and
// damage, not against anybody.
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

  // Reads the file in the folder of resources. Throws std::runtime_error with what is wrong.
  static Description read(const std::filesystem::path& resources);
  // Reads the file's text, without the files beside it.
  static Description parse(std::string_view text);

  // Returns the file's text, its hash last.
  std::string text() const;
  // Hash of the text as 16 digits: equal descriptions have equal ones.
  std::string hash() const;

  // Files that stand beside it; read() has read them, and throws std::runtime_error where one is
  // not the one that was attached when the description was written.
  void attach(const std::string& name, std::string text);
  // Returns the file's text. Throws std::runtime_error where there is none of that name.
  const std::string& file(const std::string& name) const;
  struct File {
    std::string name, text;
  };
  const std::vector<File>& attached() const { return files_; }

  // Adds a line. A key may stand in several lines, which are a list then.
  void add(std::string key, std::string value);
  // Returns the first value of the key; nullptr where there is none.
  const std::string* find(std::string_view key) const;
  // Throws std::runtime_error where there is none.
  const std::string& at(std::string_view key) const;
  std::vector<std::string> all(std::string_view key) const;
  // Returns the lines whose keys begin so, without that beginning.
  std::vector<std::pair<std::string, std::string>> lines_of(std::string_view beginning) const;

 private:
  std::string lines() const;

  struct Line {
    std::string key, value;
  };
  std::vector<Line> lines_;
  std::vector<File> files_;  // in memory
};

// Returns the folder that an importer names: a path, or a file: URI with percent signs undone.
// Throws std::runtime_error for another kind of URI and for nothing at all.
std::filesystem::path resource_folder(const char* location);

// Numbers as text with the fewest digits that bring back the same bits, and back. `number_of`
// throws std::runtime_error, naming the key, for what is no number.
std::string text_of(double number);
double number_of(std::string_view key, const std::string& text);

}  // namespace sinew::fmu
