#include "sinew/live/feed.h"

#include <algorithm>

namespace sinew::live {

Feed::Feed(std::vector<signals::Topic> topics, std::size_t ring)
    : ring_(ring), row_(topics.size()) {
  for (std::size_t i = 0; i < topics.size(); ++i) {
    is_edge_.push_back(signals::is_of_valve(topics[i].name));
    (is_edge_.back() ? edge_topics_ : row_topics_).push_back(i);
    const std::size_t fields = topics[i].fields.size();
    table_.series.push_back({std::move(topics[i]), signals::Times(pages_),
                             std::vector<signals::Column>(fields, signals::Column(pages_))});
  }
}

void Feed::push(std::size_t topic, std::int64_t time_ns, std::span<const double> values) noexcept {
  log::Sample sample{time_ns, static_cast<std::uint16_t>(topic), {}};
  std::copy_n(values.begin(), std::min(values.size(), sample.values.size()), sample.values.begin());
  if (!ring_.put(sample)) left_out_.fetch_add(1, std::memory_order_relaxed);
}

std::vector<signals::Topic> Feed::topics() const {
  std::vector<signals::Topic> out;
  for (const signals::Series& s : table_.series) out.push_back(s.topic);
  return out;
}

void Feed::collect() {
  ring_.take_all([this](const log::Sample& sample) { take(sample); });
}

void Feed::take(const log::Sample& sample) {
  if (sample.topic >= is_edge_.size()) return;
  if (is_edge_[sample.topic]) {
    signals::Series& s = table_.series[sample.topic];
    s.time_ns.push_back(sample.time_ns);
    s.columns[0].push_back(sample.values[0]);
    return;
  }
  if (sample.time_ns != row_time_ns_) {  // one that stayed incomplete is forgotten
    row_time_ns_ = sample.time_ns;
    filled_ = 0;
  }
  row_[sample.topic] = sample;
  if (++filled_ == row_topics_.size()) keep_row();
}

void Feed::keep_row() {
  for (const std::size_t i : row_topics_) {
    signals::Series& s = table_.series[i];
    s.time_ns.push_back(row_time_ns_);
    for (std::size_t c = 0; c < s.columns.size(); ++c) s.columns[c].push_back(row_[i].values[c]);
  }
  ++rows_;
}

signals::Table Feed::since(Position& position) const {
  position.edges.resize(edge_topics_.size(), 0);
  signals::Table out;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < table_.series.size(); ++i) {
    const signals::Series& s = table_.series[i];
    std::size_t& from = is_edge_[i] ? position.edges[edge++] : position.rows;
    const auto first = static_cast<std::ptrdiff_t>(from);
    signals::Series part{s.topic, {s.time_ns.begin() + first, s.time_ns.end(), pages_}, {}};
    for (const signals::Column& column : s.columns)
      part.columns.emplace_back(column.begin() + first, column.end(), pages_);
    if (is_edge_[i]) from = s.time_ns.size();
    out.series.push_back(std::move(part));
  }
  position.rows = rows_;
  return out;
}

}  // namespace sinew::live
