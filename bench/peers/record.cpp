#include "bench/peers/record.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "bench/peers/mujoco_leg.h"
#include "bench/peers/stand_peers.h"
#include "sinew/run/simulation/lanes.h"

namespace sinew::bench {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* format_name = "sinew.peers/1";

// Returns the name of the first processor.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

// Returns the load average of the last minute.
double load() {
  double one = 0;
  std::ifstream("/proc/loadavg") >> one;
  return one;
}

Json machine() {
  return {{"processor", processor()},         {"processors", std::thread::hardware_concurrency()},
          {"lanes", run::widest_lanes()},     {"load", load()},
          {"compiler", SINEW_PEERS_COMPILER}, {"flags", SINEW_PEERS_FLAGS},
          {"mujoco", mujoco_version()},       {"sundials", cvode_version()},
          {"odeint", odeint_version()}};
}

// Rounds to four digits, more than such a measurement has.
double rounded(double x) { return std::stod(fmt::format("{:.4g}", x)); }

Json row_of(const Row& r) {
  Json out = {{"name", r.name}, {"what", r.what}};
  if (!r.measured()) {
    out["missing"] = r.missing;
    return out;
  }
  const Spread figure = r.figure();
  out["figure"] = r.unit;
  out["better"] = r.better == Row::Better::more ? "more" : "less";
  out["median"] = rounded(figure.median);
  out["quartiles"] = {rounded(figure.quarter), rounded(figure.three_quarters)};
  out["from_5_to_95_percent"] = {rounded(figure.low), rounded(figure.high)};
  out["rounds"] = r.figures.size();
  if (r.goal) {
    out["goal"] = *r.goal;
    out["met"] = r.met();
  }
  out["per"] = r.per;
  if (!r.ours.empty()) out["ours_s"] = rounded(spread(r.ours).median);
  if (!r.theirs.empty()) out["theirs_s"] = rounded(spread(r.theirs).median);
  for (const Accuracy& a : r.accuracy)
    out["accuracy"].push_back(
        {{"of", a.of}, {"what", a.what}, {"value", rounded(a.value)}, {"unit", a.unit}});
  return out;
}

const Json* find(const Json& record, const std::string& name) {
  for (const Json& row : record.at("rows"))
    if (row.at("name") == name) return &row;
  return nullptr;
}

std::string part_of(const std::string& name) { return name.substr(0, name.find('/')); }

// Returns whether the record has any row of the same part.
bool has_part(const Json& record, const std::string& name) {
  for (const Json& row : record.at("rows"))
    if (part_of(row.at("name")) == part_of(name)) return true;
  return false;
}

void refuse_others(const Json& record) {
  if (record.value("format", "") != format_name)
    throw std::runtime_error(
        fmt::format("found format = {}; expected \"{}\"; try a file of bench/record",
                    record.value("format", Json()).dump(), format_name));
}

// Returns whether a row is a ratio; only ratios can be compared between days.
bool is_ratio(const Json& row) {
  return row.contains("figure") && row.at("figure").get<std::string>().starts_with("times");
}

}  // namespace

Json record(const std::vector<Row>& rows, const std::string& command) {
  Json out = {{"format", format_name},
              {"version", SINEW_VERSION},
              {"command", command},
              {"machine", machine()},
              {"rows", Json::array()}};
  for (const Row& r : rows) out["rows"].push_back(row_of(r));
  return out;
}

std::string table(const std::vector<Row>& rows) {
  std::string out =
      fmt::format("{:<34} {:>9} {:>19} {:>8}  {}\n", "row", "median", "5 to 95 %", "goal", "");
  for (const Row& r : rows) {
    if (!r.measured()) {
      out += fmt::format("{:<34} {}\n", r.name, r.missing);
      continue;
    }
    const Spread figure = r.figure();
    const std::string goal =
        r.goal ? fmt::format("{} {:g}", r.better == Row::Better::more ? ">=" : "<=", *r.goal) : "";
    out += fmt::format("{:<34} {:>9.4g} {:>9.4g} {:>9.4g} {:>8}  {}{}\n", r.name, figure.median,
                       figure.low, figure.high, goal, r.unit, r.goal && !r.met() ? ", missed" : "");
  }
  return out;
}

std::vector<Change> compare(const Json& older, const Json& newer) {
  refuse_others(older);
  refuse_others(newer);
  std::vector<Change> out;
  for (const Json& before : older.at("rows")) {
    if (!is_ratio(before)) continue;
    const std::string name = before.at("name");
    const Json* after = find(newer, name);
    const double was = before.at("median");
    if (!has_part(newer, name)) continue;
    if (!after || !is_ratio(*after)) {
      out.push_back({Change::Kind::gone, name, was, 0});
      continue;
    }
    const auto& then = before.at("from_5_to_95_percent");
    const auto& now = after->at("from_5_to_95_percent");
    const bool rose = now[0] > then[1], fell = now[1] < then[0];
    if (!rose && !fell) continue;
    const bool better = before.at("better") == "more" ? rose : fell;
    out.push_back({better ? Change::Kind::faster : Change::Kind::slower, name, was,
                   after->at("median").get<double>()});
  }
  return out;
}

std::string text(const std::vector<Change>& changes) {
  std::string out;
  for (const Change& c : changes) {
    if (c.kind == Change::Kind::gone) {
      out += fmt::format("gone    {:<34} {:.4g} before\n", c.name, c.before);
      continue;
    }
    out += fmt::format("{} {:<34} {:.4g} before, {:.4g} now\n",
                       c.kind == Change::Kind::slower ? "slower " : "faster ", c.name, c.before,
                       c.after);
  }
  return out.empty() ? "no row has changed by more than its spread\n" : out;
}

}  // namespace sinew::bench
