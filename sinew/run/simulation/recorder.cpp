#include "sinew/run/simulation/recorder.h"

#include <algorithm>
#include <cmath>

namespace sinew::run {

using signals::Tick;

namespace {

// Memory of samples and edges, without their times, that needs no file [byte].
constexpr std::size_t most_memory = 1 << 22;

// Returns 1 or 0 for an on/off valve, a share of its range for a regulator.
double logged(const signals::Edge& edge) noexcept {
  if (edge.level > 0) return static_cast<double>(edge.level) / signals::max_level;
  return edge.open ? 1.0 : 0.0;
}

template <class Samples>
Samples room(const signals::PageFile& pages, std::size_t most) {
  Samples out(pages);
  out.reserve(most);
  return out;
}

}  // namespace

Recorder::Recorder(const experiment::Experiment& e, std::span<const Column> columns,
                   const Controllers& controllers, Truths truths, Tick end,
                   const signals::TopicNames* wanted)
    : controllers_(controllers) {
  period_ = std::max<Tick>(1, std::llround(e.log.period / signals::tick_seconds));
  next_ = controllers.first_sample(period_);

  // Without true values, the topics under /true have no samples.
  const auto is_wanted = [&](const signals::Topic& topic) {
    return !wanted || wanted->contains(topic.name);
  };
  topics_ = topics(e, columns);
  std::size_t width = 0;  // numbers in a row
  for (const Column& c : columns) {
    const std::size_t topic = first_edge_++;
    if (!is_wanted(c.topic) || (truths == Truths::none && c.is_simulated_only())) continue;
    width += c.topic.fields.size();
    if (c.is_simulated_only())
      needs_ = std::max(needs_, c.is_of_motion ? Needs::motion : Needs::all);
    columns_.push_back({c, topic});
  }

  // Reserve storage for the largest number of samples and edges.
  const auto samples = static_cast<std::size_t>(end / period_ + 2);
  const std::size_t edges = most_edges_ = controllers.most_edges(end);
  const std::size_t most = samples * width + 2 * edges * (topics_.size() - first_edge_);
  if (most * sizeof(double) > most_memory) {
    pages_ = signals::PageFile::make();
    if (!pages_.open(0)) pages_ = {};  // then all samples are kept in memory
  }
  row_time_ns_ = room<signals::Times>(pages_, samples);
  for (std::size_t i = 0; i < width; ++i) values_.push_back(room<signals::Column>(pages_, samples));
  for (std::size_t i = first_edge_; i < topics_.size(); ++i) {
    const bool is = is_wanted(topics_[i]);
    const std::size_t room_of = is ? edges : 0;
    edges_.push_back(
        {is, 0, room<signals::Times>(pages_, room_of), room<signals::Column>(pages_, room_of)});
  }
}

void Recorder::command(Tick t) noexcept {
  if (progress_) progress_->store(t, std::memory_order_relaxed);
}

// Stores the numbers of a topic.
void Recorder::put(std::size_t topic, std::span<const double> values) noexcept {
  for (const double value : values) keep(values_[number_++], value);
  if (tap_.push && tapped_[topic] != not_tapped)
    tap_.push(tap_.object, tapped_[topic], now_ns_, values);
}

void Recorder::edge(const signals::Edge& edge) noexcept {
  const double value = logged(edge);
  const std::size_t topic = first_edge_ + edge.valve.index;
  Edges& of_valve = edges_[edge.valve.index];
  if (!of_valve.wanted) {  // the run is not complete without room for its edges
    complete_ = complete_ && ++of_valve.left_out <= most_edges_;
    return;
  }
  keep(of_valve.time_ns, edge.at * signals::tick_nanoseconds);
  keep(of_valve.values, value);
  if (tap_.push && tapped_[topic] != not_tapped)
    tap_.push(tap_.object, tapped_[topic], edge.at * signals::tick_nanoseconds, {&value, 1});
}

// Removes the part of a row, or of an edge, that was stored before storage was exhausted.
void Recorder::leave_out_parts() {
  std::size_t rows = row_time_ns_.size();
  for (const signals::Column& values : values_) rows = std::min(rows, values.size());
  const auto cut = [](auto& samples, std::size_t size) {
    while (samples.size() > size) samples.pop_back();
  };
  cut(row_time_ns_, rows);
  for (signals::Column& values : values_) cut(values, rows);
  for (Edges& of_valve : edges_) cut(of_valve.time_ns, of_valve.values.size());
}

signals::Table Recorder::take() {
  if (!complete_) leave_out_parts();
  signals::Table table;
  table.complete = complete_;
  std::size_t column = 0, number = 0;  // index of a recorded column, and in a row
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    signals::Series s{std::move(topics_[i]), {}, {}};
    s.columns.resize(s.topic.fields.size());
    if (i >= first_edge_) {
      Edges& of_valve = edges_[i - first_edge_];
      s.time_ns = std::move(of_valve.time_ns);
      s.columns[0] = std::move(of_valve.values);
    } else if (column < columns_.size() && columns_[column].topic == i) {
      s.time_ns = row_time_ns_;
      for (signals::Column& values : s.columns) values = std::move(values_[number++]);
      ++column;
    }
    table.series.push_back(std::move(s));
  }
  return table;
}

// Begins a row; returns false for the message of a remote board that is lost.
bool Recorder::begin_sample(Tick t) noexcept {
  next_ += period_;
  if (!controllers_.boards().has_state_of(t)) return false;
  now_ns_ = t * signals::tick_nanoseconds;
  keep(row_time_ns_, now_ns_);
  number_ = 0;
  return true;
}

void Recorder::put_sample(const Snapshot& now) noexcept {
  for (const Recorded& recorded : columns_) {
    std::array<double, 2> values{};
    recorded.column.value(now, values.data());
    put(recorded.topic, {values.data(), recorded.column.topic.fields.size()});
  }
}

void Recorder::sample(Tick t) noexcept {
  if (t < next_ || !begin_sample(t)) return;
  const double time = static_cast<double>(t) * signals::tick_seconds;
  if (machine_ && needs_ == Needs::all) machine_->truth(time, truths_);
  if (machine_ && needs_ == Needs::motion) machine_->true_motion(time, truths_);
  controllers_.with_snapshot(time, &truths_, [&](const Snapshot& now) { put_sample(now); });
}

void Recorder::sample(Tick t, const plant::Truths& truths, const gait::Desired& desired) noexcept {
  if (!begin_sample(t)) return;
  const double time = static_cast<double>(t) * signals::tick_seconds;
  controllers_.with_snapshot(time, &truths, [&](Snapshot now) {
    now.desired = {&desired, 1};
    put_sample(now);
  });
}

std::vector<Column> Recorder::columns() const {
  std::vector<Column> out;
  for (const Recorded& recorded : columns_) out.push_back(recorded.column);
  return out;
}

bool Recorder::records_edges() const noexcept {
  return std::ranges::any_of(edges_, &Edges::wanted);
}

}  // namespace sinew::run
