#include "sinew/identify/check/recognised.h"

#include <algorithm>
#include <set>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_settled.h"
#include "sinew/identify/check/noise.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

RecognisedFile file_of(const Measured& m) {
  RecognisedFile out{.file = m.file, .rows = m.rows(), .is_recording = m.has("time")};
  for (const Column& c : m.columns) {
    if (c.name == "branch") {  // words, not numbers
      out.columns.push_back({c.name, smallest(c.values) < 0 ? "vent" : "fill",
                             largest(c.values) > 0 ? "fill" : "vent"});
      continue;
    }
    out.columns.push_back({c.name, in_unit_of_file(m, c.name, smallest(c.values), 4),
                           in_unit_of_file(m, c.name, largest(c.values), 4)});
  }
  if (!out.is_recording || !m.has("pressure") || m.rows() == 0) return out;
  const Settled settled = settled_samples(m["time"], m["pressure"]);
  out.settled = 1 - static_cast<double>(settled.moving()) / static_cast<double>(m.rows());
  return out;
}

std::string branches_of(const std::vector<StaticPoint>& points) {
  std::string out;
  for (const auto& [branch, name] : {std::pair{Branch::fill, "fill"}, {Branch::vent, "vent"}})
    if (std::ranges::any_of(points,
                            [branch = branch](const StaticPoint& p) { return p.branch == branch; }))
      out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

RecognisedMount mount_of(const std::vector<StaticPoint>& points) {
  std::vector<double> lengths;
  for (const StaticPoint& p : points) lengths.push_back(p.length);
  RecognisedMount out{.rest_length = points[0].rest_length,
                      .length = median(lengths),
                      .branches = branches_of(points),
                      .pressures = count_of(pressure_groups(points)),
                      .lowest = points[0].pressure,
                      .highest = points[0].pressure,
                      .strongest = points[0].force};
  for (const StaticPoint& p : points) {
    ++(p.fitted ? out.points : out.held_out);
    out.lowest = std::min(out.lowest, p.pressure);
    out.highest = std::max(out.highest, p.pressure);
    out.strongest = std::max(out.strongest, p.force);
  }
  return out;
}

}  // namespace

Recognised recognise(const CheckInput& input) {
  Recognised out;
  for (const CheckedTable& t : input.tables) out.files.push_back(file_of(t.table));
  const std::vector<StaticPoint>& points = input.data.points;
  if (points.empty()) return out;
  const std::vector<int> group = length_groups(points);  // by muscle, then by length
  for (int g = 0; g <= *std::ranges::max_element(group); ++g) {
    std::vector<StaticPoint> own;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (group[i] == g) own.push_back(points[i]);
    if (!own.empty()) out.mounts.push_back(mount_of(own));
  }
  out.noise = force_noise(input);
  return out;
}

}  // namespace sinew::identify
