#include "sinew/report/page/plot.h"

namespace sinew::report {

Samples Channels::find(const Channel& channel) const {
  for (const signals::Table* table : tables_) {
    const signals::Series* series = table->find(channel.topic);
    if (!series) continue;
    for (std::size_t f = 0; f < series->topic.fields.size(); ++f) {
      const signals::Field& field = series->topic.fields[f];
      if (field.name == channel.field && !series->columns[f].empty())
        return {&series->time_ns, &series->columns[f], field.unit};
    }
  }
  return {};
}

Channel Channels::first_of(std::initializer_list<std::string> topics) const {
  for (const std::string& topic : topics)
    if (has({topic})) return {topic};
  return {};
}

}  // namespace sinew::report
