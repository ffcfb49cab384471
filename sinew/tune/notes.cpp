#include "sinew/tune/notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

Notes notes_of(const Ran& ran, const std::vector<std::string>& keys) {
  Notes out;
  if (!ran.ok()) return out;
  for (const std::string& key : keys) {
    if (!ran.summary.find(key)) out.lacks.push_back(key);
    if (std::ranges::find(ran.differs, key) != ran.differs.end()) out.differs.push_back(key);
  }
  const double* share = ran.summary.find("unreachable_share");
  out.stop_reached = ran.summary.find("trolley.stop_reached_s") != nullptr;
  out.no_air = ran.no_air;
  out.out_of_reach = share && *share > 0;
  return out;
}

std::string to_text(const Notes& notes) {
  std::vector<std::string> words;
  if (!notes.lacks.empty())
    words.push_back(fmt::format("without {}", fmt::join(notes.lacks, ", ")));
  if (notes.stop_reached) words.emplace_back("reaches the end of the track");
  if (notes.no_air) words.emplace_back("uses no air");
  if (notes.out_of_reach) words.emplace_back("aims out of reach");
  if (!notes.differs.empty())
    words.push_back(fmt::format("differs in {}", fmt::join(notes.differs, ", ")));
  return fmt::format("{}", fmt::join(words, "; "));
}

std::string status_with(const Notes& notes, std::string_view status) {
  const std::string words = to_text(notes);
  if (words.empty()) return std::string(status);
  return status == "ok" ? words : fmt::format("{}; {}", status, words);
}

}  // namespace sinew::tune
