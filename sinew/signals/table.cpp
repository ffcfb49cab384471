#include "sinew/signals/table.h"

#include <algorithm>

namespace sinew::signals {

bool is_of_valve(std::string_view topic) {
  constexpr std::string_view leg = "/leg/";
  if (topic.starts_with(leg))
    topic.remove_prefix(std::min(topic.find('/', leg.size()), topic.size()));
  return topic.starts_with("/valve/");
}

bool has_coarse_edges(const Topic& topic) { return topic.description == coarse_edges; }

const Series* Table::find(std::string_view topic) const {
  for (const Series& s : series)
    if (s.topic.name == topic) return &s;
  return nullptr;
}

const Column* Table::column(std::string_view topic, std::string_view field) const {
  const Series* s = find(topic);
  if (!s) return nullptr;
  for (std::size_t i = 0; i < s->topic.fields.size(); ++i)
    if (s->topic.fields[i].name == field) return &s->columns[i];
  return nullptr;
}

}  // namespace sinew::signals
