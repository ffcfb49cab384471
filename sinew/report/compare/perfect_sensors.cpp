#include "sinew/report/compare/perfect_sensors.h"

#include <set>
#include <string>
#include <string_view>

namespace sinew::report {

void add_perfect_sensors(const std::vector<signals::Table*>& tables) {
  constexpr std::string_view truth = "/true";
  std::set<std::string> measured;
  for (const signals::Table* table : tables)
    for (const signals::Series& s : table->series)
      if (!s.topic.name.starts_with("/true/")) measured.insert(s.topic.name);
  for (signals::Table* table : tables)
    for (const std::string& topic : measured) {
      const signals::Series* known = table->find(std::string(truth) + topic);
      if (!known || table->find(topic)) continue;
      signals::Series copy = *known;
      copy.topic.name = topic;
      copy.topic.description += "; as a sensor without error would read it";
      table->series.push_back(std::move(copy));
    }
}

}  // namespace sinew::report
