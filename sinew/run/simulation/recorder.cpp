#include "sinew/run/simulation/recorder.h"

#include <algorithm>
#include <cmath>

namespace sinew::run {

using signals::Tick;

namespace {

// 1 or 0 of an on/off valve, a share of its range of a regulator.
double logged(const signals::Edge& edge) noexcept {
  if (edge.level > 0) return static_cast<double>(edge.level) / signals::max_level;
  return edge.open ? 1.0 : 0.0;
}

}  // namespace

Recorder::Recorder(const experiment::Experiment& e, const Boards& spine,
                   const HighLevel& high_level, TruthAt truth, Tick end)
    : spine_(spine), high_(high_level), truth_(std::move(truth)) {
  // Sample where the last law of a period has run; other periods keep that offset.
  period_ = std::max<Tick>(1, std::llround(e.log.period / signals::tick_seconds));
  const Tick scan = spine.scan().period;
  const auto& conversions = spine.scan().conversions;
  next_ = period_ % scan == 0 && !conversions.empty() ? conversions.back().read : 0;

  // What a row holds; without a truth the topics under /true have no samples.
  columns_ = columns(e);
  topics_ = topics(e);
  first_edge_ = columns_.size();
  for (const Column& c : columns_)
    if (truth_ || !c.of_truth()) width_ += c.topic.fields.size();

  // Room for everything that can come: samples, and four edges per valve and period.
  const auto samples = static_cast<std::size_t>(end / period_ + 2);
  rows_.reserve(samples * width_);
  row_time_ns_.reserve(samples);
  edges_.reserve(4 * (topics_.size() - first_edge_) * static_cast<std::size_t>(end / scan + 2));
}

void Recorder::command(Tick t) noexcept {
  if (progress_) progress_->store(t, std::memory_order_relaxed);
}

// The numbers of the topic at the cursor.
void Recorder::put(std::span<const double> values) noexcept {
  rows_.insert(rows_.end(), values.begin(), values.end());
  if (tap_.push && tapped_[cursor_] != not_tapped)
    tap_.push(tap_.object, tapped_[cursor_], now_ns_, values);
  ++cursor_;
}

void Recorder::edge(const signals::Edge& edge) noexcept {
  if (edges_.size() == edges_.capacity()) {
    complete_ = false;
    return;
  }
  edges_.push_back(edge);
  const std::size_t topic = first_edge_ + edge.valve.index;
  const double value = logged(edge);
  if (tap_.push && tapped_[topic] != not_tapped)
    tap_.push(tap_.object, tapped_[topic], edge.at * signals::tick_nanoseconds, {&value, 1});
}

signals::Table Recorder::take() {
  signals::Table table;
  table.complete = complete_;
  std::size_t column = 0;  // of a row
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    signals::Series s{std::move(topics_[i]), {}, {}};
    s.columns.resize(s.topic.fields.size());
    if (i < first_edge_ && column < width_) {
      s.time_ns = row_time_ns_;
      for (std::vector<double>& values : s.columns) {
        values.reserve(row_time_ns_.size());
        for (std::size_t at = column; at < rows_.size(); at += width_) values.push_back(rows_[at]);
        ++column;
      }
    }
    table.series.push_back(std::move(s));
  }
  for (const signals::Edge& edge : edges_) {
    signals::Series& s = table.series[first_edge_ + edge.valve.index];
    s.time_ns.push_back(edge.at * signals::tick_nanoseconds);
    s.columns[0].push_back(logged(edge));
  }
  return table;
}

void Recorder::sample(Tick t) noexcept {
  if (t < next_) return;
  next_ += period_;
  if (rows_.capacity() - rows_.size() < width_) {
    complete_ = false;
    return;
  }
  row_time_ns_.push_back(t * signals::tick_nanoseconds);
  now_ns_ = t * signals::tick_nanoseconds;
  cursor_ = 0;
  const MachineSeen seen = spine_.seen();
  const gait::MachineMeasured measured = high_.believe(seen);
  plant::Truth truth;
  if (truth_) truth = truth_(t);
  const Moment now{seen, measured, high_.desired(), truth,
                   static_cast<double>(t) * signals::tick_seconds};
  for (const Column& c : columns_) {
    if (!truth_ && c.of_truth()) break;  // they come last
    std::array<double, 2> values{};
    c.value(now, values.data());
    put({values.data(), c.topic.fields.size()});
  }
}

}  // namespace sinew::run
