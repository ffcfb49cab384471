#include "sinew/log/csv.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string_view>

#include "sinew/log/message.h"
#include "sinew/log/replacement.h"

namespace sinew::log {
namespace {

bool is_edges(const signals::Topic& topic) {
  return signals::is_of_valve(topic.name) && topic.name.ends_with("/open");
}

bool is_chosen(const std::string& topic, const std::vector<std::string>& chosen) {
  if (chosen.empty()) return true;
  return std::any_of(chosen.begin(), chosen.end(), [&](const std::string& name) {
    return topic.starts_with(name) &&
           (topic.size() == name.size() || name.ends_with('/') || topic[name.size()] == '/');
  });
}

std::string heading(const signals::Topic& topic, const signals::Field& field) {
  std::string text = topic.name;
  if (topic.fields.size() > 1 || field.name != "value") text += "." + field.name;
  if (!field.unit.empty()) text += " [" + field.unit + "]";
  return csv_cell(text);
}

// Position in a series while rows are written.
class Walker {
 public:
  explicit Walker(const signals::Series& series)
      : series_(series), edges_(is_edges(series.topic)) {}

  bool edges() const { return edges_; }
  const signals::Series& series() const { return series_; }

  // Skips all samples up to this time. Times must ascend.
  void go_to(std::int64_t time_ns) {
    while (next_ < series_.time_ns.size() && series_.time_ns[next_] <= time_ns) ++next_;
    here_ = next_ > 0 && (edges_ || series_.time_ns[next_ - 1] == time_ns);
  }

  void append_cells(std::string& line) const {
    char room[32];
    for (const signals::Column& column : series_.columns) {
      line += ',';
      const double value = here_ ? column[next_ - 1] : edges_ ? 0.0 : NAN;
      if (std::isfinite(value)) line += digits(value, room);
    }
  }

 private:
  const signals::Series& series_;
  bool edges_;
  std::size_t next_ = 0;
  bool here_ = false;
};

signals::Times row_times(const std::vector<Walker>& walkers) {
  const bool all = std::all_of(walkers.begin(), walkers.end(), [](auto& w) { return w.edges(); });
  signals::Times times;
  for (const Walker& walker : walkers) {
    if (walker.edges() && !all) continue;
    // Most topics share their times and add none.
    const signals::Times& more = walker.series().time_ns;
    if (more == times) continue;
    signals::Times both(more.file());
    std::set_union(times.begin(), times.end(), more.begin(), more.end(), std::back_inserter(both));
    times = std::move(both);
  }
  return times;
}

// Passes the table to `put` line by line.
template <class Put>
void put_lines(const signals::Table& table, const std::vector<std::string>& topics, Put put) {
  std::vector<Walker> walkers;
  std::string line = "time [s]";
  for (const signals::Series& series : table.series) {
    if (!is_chosen(series.topic.name, topics)) continue;
    walkers.emplace_back(series);
    for (const signals::Field& field : series.topic.fields) {
      line += ',';
      line += heading(series.topic, field);
    }
  }
  put(line + '\n');

  char room[32];
  const signals::Times times = row_times(walkers);
  for (std::size_t row = 0; row < times.size(); ++row) {
    const std::int64_t time_ns = times[row];
    if (row > 0 && time_ns == times[row - 1]) continue;
    line = digits(static_cast<double>(time_ns) / 1e9, room);
    for (Walker& walker : walkers) {
      walker.go_to(time_ns);
      walker.append_cells(line);
    }
    line += '\n';
    put(line);
  }
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

void write_csv(const signals::Table& table, std::ostream& out,
               const std::vector<std::string>& topics) {
  put_lines(table, topics, [&](const std::string& line) { out << line; });
}

void write_csv(const signals::Table& table, const std::filesystem::path& file,
               const std::vector<std::string>& topics) {
  Replacement out(file);
  constexpr std::size_t piece = 1 << 20;  // size of one write [B]
  std::string text;
  put_lines(table, topics, [&](const std::string& line) {
    text += line;
    if (text.size() < piece) return;
    out.write(text);
    text.clear();
  });
  out.write(text);
  out.commit();
}

}  // namespace sinew::log
