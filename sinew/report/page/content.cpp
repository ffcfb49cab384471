#include "sinew/report/page/content.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <iterator>

#include <fmt/format.h>

#include "sinew/log/deflate.h"
#include "sinew/report/page/page.h"
#include "sinew/robot/legs.h"
#include "sinew/signals/tick.h"
#include "sinew/units/quantity.h"

namespace sinew::report {

namespace {

// Appends 4-byte numbers to a text, split into planes of bytes of equal rank.
class Planes {
 public:
  explicit Planes(std::size_t numbers, std::string& out)
      : numbers_(numbers), at_(out.size()), out_(out) {
    out_.resize(at_ + 4 * numbers);
  }
  void put(std::size_t i, std::uint32_t bits) {
    for (std::size_t rank = 0; rank < 4; ++rank)
      out_[at_ + rank * numbers_ + i] = static_cast<char>(bits >> (8 * rank));
  }

 private:
  std::size_t numbers_, at_;
  std::string& out_;
};

std::int64_t tick_at(std::int64_t time_ns) {
  const std::int64_t half = signals::tick_nanoseconds / 2;
  return (time_ns + (time_ns < 0 ? -half : half)) / signals::tick_nanoseconds;
}

// Returns the number of samples that are replaced by two; 0 if the clock is not thinned. It is odd,
// so that both states of a channel that alternates, such as a valve, remain visible.
std::size_t share_of(std::size_t samples) {
  return samples <= Blob::most ? 0 : ((2 * samples + Blob::most - 1) / Blob::most) | 1;
}

std::size_t shown_of(std::size_t samples) {
  const std::size_t share = share_of(samples);
  return share == 0 ? samples : 2 * ((samples + share - 1) / share);
}

// Returns the row of a shown sample: the first one of a group, or its middle.
std::size_t row_of(std::size_t shown, std::size_t samples) {
  const std::size_t share = share_of(samples);
  if (share == 0) return shown;
  return std::min(shown / 2 * share + (shown % 2) * (share / 2), samples - 1);
}

void put_clock(const signals::Times& time_ns, std::string& out) {
  const std::size_t shown = shown_of(time_ns.size());
  Planes planes(shown, out);
  std::int64_t before = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::int64_t tick = tick_at(time_ns[row_of(i, time_ns.size())]);
    planes.put(i, static_cast<std::uint32_t>(tick - before));
    before = tick;
  }
}

// Returns the least and the greatest number in the order of time; NaN if all are NaN.
std::pair<double, double> extremes(const signals::Column& values, std::size_t from,
                                   std::size_t to) {
  double least = values[from], most = least;
  bool rises = true;  // the greatest one is after the least
  for (std::size_t i = from + 1; i < to; ++i) {
    const double x = values[i];
    if (std::isnan(x)) continue;
    if (!(x >= least)) least = x, rises = false;
    if (!(x <= most)) most = x, rises = true;
  }
  return rises ? std::pair{least, most} : std::pair{most, least};
}

void put_column(const signals::Column& values, Blob::As as, std::string& out) {
  const std::size_t samples = values.size(), shown = shown_of(samples), share = share_of(samples);
  Planes planes(shown, out);
  const auto put = [&](std::size_t i, double value) {
    planes.put(i, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  };
  if (share == 0 || as == Blob::As::pose) {
    for (std::size_t i = 0; i < shown; ++i) put(i, values[row_of(i, samples)]);
    return;
  }
  for (std::size_t i = 0; i < shown; i += 2) {
    const std::size_t from = i / 2 * share;
    const auto [first, second] = extremes(values, from, std::min(from + share, samples));
    put(i, first);
    put(i + 1, second);
  }
}

}  // namespace

int Blob::clock_of(const signals::Times& time_ns) {
  for (std::size_t i = 0; i < clocks_.size(); ++i)
    if (clocks_[i] == &time_ns || *clocks_[i] == time_ns) return static_cast<int>(i);
  clocks_.push_back(&time_ns);
  return static_cast<int>(clocks_.size()) - 1;
}

int Blob::add(const Samples& samples, As as) {
  if (share_of(samples.values->size()) == 0) as = As::line;  // both uses give the same column
  const auto [at, is_new] =
      known_.try_emplace({samples.values, as}, static_cast<int>(columns_.size()));
  if (is_new) columns_.push_back({clock_of(*samples.time_ns), samples.values, as});
  return at->second;
}

std::size_t Blob::thinned() const {
  std::size_t out = 0;
  for (const auto* clock : clocks_) out = std::max(out, share_of(clock->size()));
  return out;
}

Blob::Layout Blob::layout() const {
  Layout out;
  for (const auto* clock : clocks_) out.clocks.push_back(shown_of(clock->size()));
  for (const Column& column : columns_) out.columns.push_back(column.clock);
  return out;
}

std::string Blob::base64() const {
  std::string bytes;
  for (const auto* clock : clocks_) put_clock(*clock, bytes);
  for (const Column& column : columns_) put_column(*column.values, column.as, bytes);
  return to_base64(log::deflated(bytes));
}

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

Drawing::Drawing(const signals::Table& logged, const signals::Table& derived,
                 const analysis::Machine& machine, const analysis::Record& record) {
  channels.add(logged);
  channels.add(derived);
  if (machine.stand)
    stand = report::stand(channels, machine, drawn);
  else
    scene = report::scene(channels, machine, record, drawn);
  channels.add(drawn);
}

namespace {

double end_of(const Channels& channels) {
  std::int64_t end = 0;
  for (const signals::Table* table : channels.tables())
    for (const signals::Series& s : table->series)
      if (!s.time_ns.empty()) end = std::max(end, s.time_ns.back());
  return static_cast<double>(end) / 1e9;
}

// Returns the members that do not depend on the samples.
Json head(const Run& run, const analysis::Machine& machine) {
  return {{"format", "sinew.report/1"},
          {"title", machine.title},
          {"reproduces", machine.reproduces},
          {"name", run.name},
          {"robot", machine.robot.name},
          {"seed", value_text(run.resolved, "seed")},
          {"version", value_text(run.resolved, "sinew_version")},
          {"atmosphere", machine.atmosphere}};
}

// Returns the warning at the top of the page of a run that ended early.
std::vector<analysis::Warning> end_warning(const Run& run) {
  if (run.analysis.ended.empty()) return {};
  return {{"the run was ended: " + run.analysis.ended, {}}};
}

// Returns a warning if the page does not show all samples of a long run.
std::vector<analysis::Warning> omission_warning(const Blob& blob, const Channels& channels,
                                                std::size_t stretches) {
  if (blob.thinned() == 0) return {};
  std::size_t samples = 0;
  for (const signals::Table* table : channels.tables())
    for (const signals::Series& s : table->series)
      if (!signals::is_of_valve(s.topic.name)) samples = std::max(samples, s.time_ns.size());
  const double each = end_of(channels) * static_cast<double>(blob.thinned()) /
                      static_cast<double>(std::max<std::size_t>(samples, 1));
  return {{fmt::format("the run is longer than a page can show: of every {:.2g} s a line has its "
                       "least and its greatest value, the drawing two instants{}; the log has all",
                       each, stretches > most_stretches ? ", and phases are not marked" : ""),
           {}}};
}

}  // namespace

Content content(const Run& run) {
  const auto& [table, ended, machine, derived, record, warned, summary, verdicts] = run.analysis;
  const Drawing drawing(table, derived, machine, record);
  const Channels& channels = drawing.channels;
  Blob blob;
  Columns columns(channels, blob);
  Json json = head(run, machine);
  json["duration"] = end_of(channels);
  json["phases"] = phases_of(record, machine);
  if (!summary.faults.empty()) json["faults"] = to_json(summary.faults, end_of(channels));
  if (const std::vector<PageChange> changes = changes_of(run.resolved); !changes.empty())
    json["changes"] = to_json(changes);
  json["panels"] = panels_json(panels(channels, machine), columns);
  json["scene"] = to_json(drawing.scene, columns);
  if (machine.stand) {
    json["stand"] = to_json(drawing.stand, columns);
    json["charts"] = charts_json(stand_charts(channels, drawing.stand), columns);
  }
  std::vector<analysis::Warning> warnings = end_warning(run);
  std::ranges::move(omission_warning(blob, channels, record.phase_spans().size()),
                    std::back_inserter(warnings));
  std::ranges::move(analysis::cut_logs(table), std::back_inserter(warnings));
  std::ranges::copy(warned, std::back_inserter(warnings));
  json["warnings"] = to_json(warnings);
  json["verdicts"] = to_json(verdicts);
  json["summary"] = Json::parse(analysis::to_json(summary));
  json["parameters"] = to_json(parameters(run.resolved));
  json["samples"] = to_json(blob.layout());
  const config::UnitsToShow shown = config::units_to_show({.now = run.units, .run = &run.resolved});
  return {.title = summary.title.empty() ? run.name : summary.title,
          .json = json.text(),
          .samples = blob.base64(),
          .units = units_json(shown.units)};
}

namespace {

// Returns the angle at which the experiment starts a joint, or else its rest angle  [rad].
double start_angle(const config::Node& resolved, const robot::Joint& joint) {
  const config::Node* node = resolved.find("start");
  for (const std::string& key : {std::string("joint_angles"), joint.name})
    if (node != nullptr) node = node->find(key);
  if (node != nullptr && node->is_value_table()) node = node->find("value");
  if (node == nullptr) return joint.rest_angle;
  const units::NumberAndUnit angle = units::split_number(node->text);
  return angle.unit == "rad" ? angle.number : joint.rest_angle;
}

// Returns a log with a single row.
signals::Table first_row(const config::Node& resolved, const analysis::Machine& machine) {
  signals::Table out;
  for (const robot::Joint& joint : machine.robot.joints) {
    signals::Series s{{robot::logged_topic(machine.robot, "/joint/" + joint.name + "/angle"),
                       "",
                       {{"value", "rad"}}},
                      {},
                      std::vector<signals::Column>(1)};
    s.time_ns.push_back(0);
    s.columns[0].push_back(start_angle(resolved, joint));
    out.series.push_back(std::move(s));
  }
  return out;
}

Json picture_of_robot(const config::Node& resolved) {
  const analysis::Machine machine = analysis::read_machine(resolved);
  const signals::Table row = first_row(resolved, machine);
  const analysis::Record record(row, machine);
  const signals::Table derived;
  const Drawing drawing(row, derived, machine, record);
  Blob blob;
  Columns columns(drawing.channels, blob);
  Json out{{"scene", to_json(drawing.scene, columns)}, {"atmosphere", machine.atmosphere}};
  out["samples"] = to_json(blob.layout());
  out["data"] = blob.base64();
  return out;
}

}  // namespace

std::string picture(const config::Node& resolved) {
  Json out = Json::object();
  try {
    if (resolved.find("element"))
      out["stand"] = true;
    else
      out = picture_of_robot(resolved);
  } catch (const std::exception&) {
    // The file does not describe a machine that can be drawn.
  }
  return out.text();
}

}  // namespace sinew::report
