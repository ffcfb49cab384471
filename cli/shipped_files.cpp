#include "cli/shipped_files.h"

#include <algorithm>
#include <filesystem>

#include "sinew/config/diagnostics.h"
#include "sinew/files/shipped.h"

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

bool could_be_shipped(const std::string& word) {
  constexpr const char* folders[] = {"robots/", "experiments/", "studies/", "data/"};
  std::error_code none;
  return std::ranges::any_of(folders, [&](const char* f) { return word.starts_with(f); }) &&
         !fs::exists(word, none);
}

}  // namespace

std::vector<std::string> with_shipped_files(std::vector<std::string> words) {
  constexpr std::string_view kept[] = {"new", "migrate", "help", "completion"};
  if (words.empty() || std::ranges::find(kept, words[0]) != std::end(kept)) return words;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string& before = words[i - 1];
    if (before == "-o" || before == "--output" || before == "--out" || !could_be_shipped(words[i]))
      continue;
    try {
      std::error_code none;
      const fs::path own = files::shipped_folder() / words[i];
      if (fs::is_regular_file(own, none)) words[i] = own.string();
    } catch (const config::Error&) {
      return words;  // nothing is installed near the program: the command names what is missing
    }
  }
  return words;
}

}  // namespace sinew::cli
