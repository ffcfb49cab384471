#include "thesis/out_dat/out_dat.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "sinew/config/diagnostics.h"
#include "sinew/config/rows.h"
#include "sinew/run/simulation/recorder.h"
#include "sinew/units/constants.h"
#include "thesis/out_dat/columns.h"

namespace sinew::thesis {
namespace {

constexpr double stiffness_unit = units::pound_force * units::inch;  // [N m/rad]

using Words = std::vector<std::string_view>;

// --- writing ---

class TableReader {
 public:
  TableReader(const signals::Table& table, const std::string& path) : table_(table), path_(path) {}

  // Returns the value held from the last sample, as `analysis` does.
  double at(const std::string& topic, std::int64_t time_ns) const {
    const signals::Series* s = table_.find(topic);
    if (!s || s->columns.empty())
      config::fail({path_, 0, 0}, topic, "no such channel in the log",
                   "one, for out.dat's columns");
    const auto after = std::ranges::upper_bound(s->time_ns, time_ns) - s->time_ns.begin();
    const double value = after > 0 ? s->columns[0][static_cast<std::size_t>(after - 1)] : NAN;
    if (std::isfinite(value)) return value;
    config::fail({path_, 0, 0}, topic,
                 fmt::format("no value at {:.4f} s", 1e-9 * static_cast<double>(time_ns)),
                 "one in every period of the sequence");
  }

 private:
  const signals::Table& table_;
  const std::string& path_;
};

int whole(double value) { return static_cast<int>(std::lround(value)); }

// Truncates desired counts to an integer, as the high level does. A count that is whole except for
// rounding errors of a conversion to an angle is rounded.
int cut(double counts) {
  const double nearest = std::round(counts);
  return static_cast<int>(std::abs(counts - nearest) < 1e-6 ? nearest : counts);
}

std::string duties(const OutDatJoint& j, const TableReader& read, std::int64_t t) {
  const auto percent = [&](const std::string& muscle, const char* which) {
    return whole(100.0 * read.at("/muscle/" + muscle + "/" + which + "_duty", t));
  };
  return fmt::format("{} {} {} {}", percent(j.flexor, "inlet"), percent(j.extensor, "exhaust"),
                     percent(j.flexor, "exhaust"), percent(j.extensor, "inlet"));
}

std::string joint_cells(const OutDatJoint& j, const TableReader& read, std::int64_t t) {
  const auto count = [&](const std::string& sensor) {
    return whole(read.at("/sensor/" + sensor + "/count", t));
  };
  const double desired = read.at("/desired/joint/" + j.name + "/angle", t);
  const int thetades = cut((desired - j.rest) * j.counts_per_rad + j.counts_at_rest);
  return fmt::format(" {} {} {} {} {:f} {:f} ", thetades, count(j.angle), count(j.flexor_tension),
                     count(j.extensor_tension),
                     read.at("/desired/joint/" + j.name + "/stiffness", t) / stiffness_unit,
                     read.at("/joint/" + j.name + "/stiffness", t) / stiffness_unit) +
         duties(j, read, t);
}

// --- reading ---

// Values of a line, in the order of the heading.
struct Line {
  int number = 0;  // line number in the file
  std::string mode;
  std::vector<double> values;  // starting with the timer
};

Words words_of(std::string_view line) {
  Words out;
  for (std::size_t start = line.find_first_not_of(" \t\r"); start != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", start), line.size());
    out.push_back(line.substr(start, end - start));
    start = line.find_first_not_of(" \t\r", end);
  }
  return out;
}

// Allowed values of a column, by its name in the heading.
struct Allowed {
  double low = -2147483648.0, high = 2147483647.0;
  bool whole = true;
};

Allowed allowed(std::string_view column, double top) {
  const std::string_view name = column.substr(0, column.find('['));
  if (name == "timer") return {0, 1e9};
  if (name == "pot" || name == "gage") return {0, top};
  if (name == "fi" || name == "ee" || name == "fe" || name == "ei") return {0, 100};
  if (name == "stiffdes" || name == "stiffness") return {-1e9, 1e9, false};
  return {};
}

void read_cell(std::string_view word, std::string_view column, double top, int column_at,
               Line& line, config::Problems& problems) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool number =
      error == std::errc{} && end == word.data() + word.size() && std::isfinite(value);
  const Allowed may = allowed(column, top);
  const bool good =
      number && value >= may.low && value <= may.high && (!may.whole || value == std::floor(value));
  if (!good)
    problems.add(line.number, column_at, std::string(column), config::in_quotes(word),
                 fmt::format("{} from {:.0f} to {:.0f}", may.whole ? "a whole number" : "a number",
                             may.low, may.high));
  line.values.push_back(value);
}

Line read_line(std::string_view text, int number, const Words& heading, double top,
               config::Problems& problems) {
  Line line{.number = number, .mode = {}, .values = {}};
  const Words words = words_of(text);
  if (words.size() != heading.size()) {
    problems.add(number, 1, "", fmt::format("{} columns", words.size()),
                 fmt::format("{}, as the heading", heading.size()),
                 words.size() < heading.size() ? "a fresh copy: this line is cut short" : "");
    return line;
  }
  line.mode = words[0];
  for (std::size_t i = 1; i < words.size(); ++i)
    read_cell(words[i], heading[i], top, static_cast<int>(words[i].data() - text.data()) + 1, line,
              problems);
  return line;
}

// Follows the plan from line to line.
class PlanWalk {
 public:
  PlanWalk(const gait::Plan& plan, config::Problems& problems)
      : plan_(plan), problems_(problems), period_(std::llround(plan.high_level_period * 1e9)) {}

  // Processes a line. A new phase begins where its name changes or the timer restarts.
  void follow_plan(const Line& line) {
    const auto timer = static_cast<std::int64_t>(line.values[0]);
    const bool begins = line.mode != mode_ || timer == 0;
    if (begins) {
      enter(line);
      start_ns_ = time_ns;
    } else if (timer <= timer_) {
      problems_.add(line.number, 1, "timer", fmt::format("{} after {}", timer, timer_),
                    "a timer that counts up, or 0 where a phase begins");
    }
    timer_ = timer;
    time_ns = start_ns_ + timer * period_;
    next_ns_ = time_ns + period_;
  }

  // Advances to the line after this one.
  void step_on() { time_ns = next_ns_; }

  std::int64_t time_ns = 0;
  int phase = -1, step = 0;

 private:
  void enter(const Line& line) {
    mode_ = line.mode;
    const std::string phase_name = phase_of_mode(line.mode);
    const std::size_t n = plan_.sequence.size();
    for (std::size_t i = 1; i <= n; ++i) {
      const std::size_t at = (place_ + i) % n;
      if (plan_.sequence[at] != phase_name) continue;
      if (phase >= 0 && at <= place_) ++step;
      place_ = at;
      for (std::size_t p = 0; p < plan_.phases.size(); ++p)
        if (plan_.phases[p].name == phase_name) phase = static_cast<int>(p);
      return;
    }
    std::vector<std::string> sequence_modes;
    for (const std::string& name : plan_.sequence) sequence_modes.push_back(mode_of_phase(name));
    const std::vector<std::string_view> known(sequence_modes.begin(), sequence_modes.end());
    problems_.add(line.number, 1, "mode", config::in_quotes(line.mode), config::either(known),
                  config::closest_in_quotes(line.mode, known));
  }

  const gait::Plan& plan_;
  config::Problems& problems_;
  std::int64_t period_, start_ns_ = 0, next_ns_ = 0, timer_ = 0;
  std::string mode_;
  std::size_t place_ = plan_.sequence.empty() ? 0 : plan_.sequence.size() - 1;
};

// Writes topics in the order of their first use.
class TableWriter {
 public:
  explicit TableWriter(const experiment::Experiment& e) : all_(run::topics(e)) {}

  void put(const std::string& topic, std::int64_t time_ns, double value) {
    signals::Series& s = series(topic);
    s.time_ns.push_back(time_ns);
    s.columns[0].push_back(value);
  }
  signals::Table take() { return std::move(table_); }

 private:
  signals::Series& series(const std::string& name) {
    const auto [found, is_new] = places_.emplace(name, table_.series.size());
    if (is_new) {
      const auto topic = std::ranges::find(all_, name, &signals::Topic::name);
      table_.series.push_back(
          {.topic = *topic, .time_ns = {}, .columns = {1, std::vector<double>{}}});
    }
    return table_.series[found->second];
  }

  std::vector<signals::Topic> all_;
  std::map<std::string, std::size_t> places_;
  signals::Table table_;
};

// Writes the ten columns of a joint.
void put_joint(const OutDatJoint& j, const double* v, std::int64_t t, TableWriter& out) {
  const auto angle = [&](double counts) {
    return j.rest + (counts - j.counts_at_rest) / j.counts_per_rad;
  };
  out.put("/desired/joint/" + j.name + "/angle", t, angle(v[0]));
  out.put("/sensor/" + j.angle + "/count", t, v[1]);
  out.put("/joint/" + j.name + "/angle", t, angle(v[1]));
  out.put("/sensor/" + j.flexor_tension + "/count", t, v[2]);
  out.put("/sensor/" + j.extensor_tension + "/count", t, v[3]);
  out.put("/muscle/" + j.flexor + "/tension", t, j.flexor_scale.newtons(v[2]));
  out.put("/muscle/" + j.extensor + "/tension", t, j.extensor_scale.newtons(v[3]));
  out.put("/desired/joint/" + j.name + "/stiffness", t, v[4] * stiffness_unit);
  out.put("/joint/" + j.name + "/stiffness", t, v[5] * stiffness_unit);
  out.put("/muscle/" + j.flexor + "/inlet_duty", t, 0.01 * v[6]);
  out.put("/muscle/" + j.extensor + "/exhaust_duty", t, 0.01 * v[7]);
  out.put("/muscle/" + j.flexor + "/exhaust_duty", t, 0.01 * v[8]);
  out.put("/muscle/" + j.extensor + "/inlet_duty", t, 0.01 * v[9]);
}

void put_line(const Line& line, const OutDatColumns& columns, const PlanWalk& plan,
              TableWriter& out) {
  out.put("/plan/phase", plan.time_ns, plan.phase);
  out.put("/plan/step", plan.time_ns, plan.step);
  if (!columns.cylinder.empty())
    out.put("/sensor/" + columns.cylinder + "/count", plan.time_ns, line.values[1]);
  constexpr std::size_t first = 6, width = 10;
  for (std::size_t j = 0; j < columns.joints.size(); ++j)
    put_joint(columns.joints[j], &line.values[first + j * width], plan.time_ns, out);
}

void check_heading(const std::string& found, const std::string& wanted, const std::string& name) {
  if (words_of(found) == words_of(wanted)) return;
  const bool other = found.starts_with("mode ");
  config::fail({name, 1, 1}, "", config::in_quotes(found.substr(0, 40)),
               "the heading of out.dat for this robot, " + config::in_quotes(wanted),
               other ? "the experiment of the robot that wrote it" : "the file's first line");
}

}  // namespace

bool is_out_dat(const std::filesystem::path& file) {
  std::string begin(std::string_view("mode timer").size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == "mode timer" || begin == "mode\ttimer";
}

std::string write_out_dat(const signals::Table& table, const experiment::Experiment& e) {
  const OutDatColumns columns = out_dat_columns(e);
  const TableReader read(table, e.path);
  std::string out = columns.heading() + "\n";
  if (!e.robot.legs.empty())
    config::fail({e.path, 0, 0}, "leg", std::to_string(e.robot.legs.size()) + " legs",
                 "a robot without [leg.*]: out.dat has columns for one", "--format csv");
  const signals::Series* phases = table.find("/plan/phase");
  if (!phases)
    config::fail({e.path, 0, 0}, "/plan/phase", "no such channel in the log", "one, for out.dat");

  // Writes a line when the timer has changed, as the controller of B.1 does.
  const std::int64_t period = std::llround(e.plan.high_level_period * 1e9);
  double before = -1, step_before = -1;
  std::int64_t began = 0, last_timer = -1;
  for (std::size_t i = 0; i < phases->time_ns.size(); ++i) {
    const std::int64_t t = phases->time_ns[i];
    const double phase = phases->columns[0][i];
    const double step = phase >= 0 ? read.at("/plan/step", t) : -1;
    if (phase != before || step != step_before) began = t, last_timer = -1;
    before = phase, step_before = step;
    const std::int64_t timer = (t - began) / period;
    if (phase < 0 || timer <= last_timer) continue;
    last_timer = timer;

    const std::string& name = e.plan.phases.at(static_cast<std::size_t>(phase)).name;
    const int pot =
        columns.cylinder.empty() ? 0 : whole(read.at("/sensor/" + columns.cylinder + "/count", t));
    out += fmt::format("{} {} {} 0 0 0 0", mode_of_phase(name), timer, pot);
    for (const OutDatJoint& j : columns.joints) out += joint_cells(j, read, t);
    out += "\n";
  }
  return out;
}

signals::Table parse_out_dat(std::string_view text, const std::string& name,
                             const experiment::Experiment& e) {
  const OutDatColumns columns = out_dat_columns(e);
  const std::string heading = columns.heading();
  const Words names = words_of(heading);
  std::istringstream lines{std::string(text)};
  std::string line_text;
  std::getline(lines, line_text);
  check_heading(line_text, heading, name);

  config::Problems problems(name);
  PlanWalk plan(e.plan, problems);
  TableWriter out(e);
  std::size_t read = 0;
  for (int number = 2; std::getline(lines, line_text); ++number) {
    if (config::trimmed_row(line_text).empty()) continue;
    const Line line = read_line(line_text, number, names, e.robot.converter.top(), problems);
    if (line.values.size() + 1 != names.size()) continue;
    plan.follow_plan(line);
    put_line(line, columns, plan, out);
    plan.step_on();
    ++read;
  }
  if (read == 0) problems.add(2, 1, "", "no line with values", "one per period of 10 ms");
  problems.finish();
  return out.take();
}

std::string write_ports(const signals::Table& table, const experiment::Experiment& e) {
  const auto bits = robot::bits_of(e.robot, e.wiring);
  int boards = 1, highest = 15;
  for (const robot::ValveBit& b : bits)
    boards = std::max(boards, b.board), highest = std::max(highest, b.bit);
  const auto ports = static_cast<std::size_t>(highest / 8 + 1);

  std::string out = boards > 1 ? "time [s],board [1]" : "time [s]";
  for (std::size_t p = 0; p < ports; ++p) out += fmt::format(",port {} [1]", p);
  out += "\n";
  for (int board = 1; board <= boards; ++board) {
    auto its = bits;
    std::erase_if(its, [&](const robot::ValveBit& b) { return b.board != board; });
    for (const robot::PortBytes& b : robot::port_bytes(table, its, e.wiring.polarity)) {
      out += fmt::format("{:.4f}", 1e-9 * static_cast<double>(b.time_ns));
      if (boards > 1) out += fmt::format(",{}", board);
      for (std::size_t p = 0; p < ports; ++p) out += fmt::format(",{}", b.port[p]);
      out += "\n";
    }
  }
  return out;
}

}  // namespace sinew::thesis
