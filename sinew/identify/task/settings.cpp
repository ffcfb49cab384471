#include "sinew/identify/task/settings.h"

#include <algorithm>

#include "sinew/identify/task/tables.h"

namespace sinew::identify {

std::vector<Source> held_out_tables(const HeldOut& hold_out, const std::vector<Source>& sources,
                                    std::span<const std::string_view> words, bool may_be_fitted) {
  std::vector<Source> out = hold_out.tables;
  for (const std::string& text : hold_out.texts) {
    if (std::ranges::find(words, text) != words.end()) continue;
    if (!may_be_fitted) refuse_fitted(sources, "hold_out", text);
    out.push_back(sources.front());
    out.back().path = text;
    out.back().text.reset();
  }
  return out;
}

}  // namespace sinew::identify
