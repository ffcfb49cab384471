#include "sinew/identify/pair/pair_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"

namespace sinew::identify {

namespace {

constexpr ColumnSpec columns[] = {
    {"time", "s", 0, 0, needed_column, "of the sample"},
    {"force", "N", 1e-3, 1e6, optional_column, "that moves the slide, along the displacement"},
    {"displacement", "m", 1e-6, 2, optional_column, "of the slide from anywhere"},
    {"torque", "N m", 1e-5, 1e5, optional_column, "that moves the joint, along the angle"},
    {"angle", "rad", 1e-5, 7, optional_column, "of the joint from anywhere"},
    {"pressure_1", "Pa abs", 5e4, 5e6, optional_column, "of the trapped air of one muscle"},
    {"pressure_2", "Pa abs", 5e4, 5e6, optional_column, "of the trapped air of the other"},
};

constexpr std::size_t least_samples = 100;

// Returns whether the recording is of a joint. Throws Refusal if it is of neither kind or of both.
bool is_rotary(const Measured& data) {
  const bool slide = data.has("force") && data.has("displacement");
  const bool joint = data.has("torque") && data.has("angle");
  if (slide != joint) return joint;
  throw Refusal(data.file,
                slide ? "force and displacement, and torque and angle too"
                      : "neither force and displacement nor torque and angle",
                "the one or the other", "names.force=NAME, names.displacement=NAME");
}

double smallest_step(std::span<const double> values) {
  double out = std::numeric_limits<double>::infinity();
  for (const double step : steps_of(values))
    if (step != 0) out = std::min(out, std::abs(step));
  return out;
}

// Notes gaps: steps that are much longer than the others.
void add_gap_note(PairRecord& r) {
  const std::vector<double> steps = steps_of(r.time);
  const double usual = median(steps);
  const auto gaps = std::ranges::count_if(steps, [&](double s) { return s > 10 * usual; });
  if (gaps > 0)
    r.notes.push_back(fmt::format("{}: {} gaps of more than ten samples", r.file, gaps));
}

}  // namespace

std::span<const ColumnSpec> pair_columns() { return columns; }

PairRecord pair_record(const Measured& data, double window) {
  PairRecord out{.file = data.file, .rotary = is_rotary(data), .notes = data.notes};
  const char* at = out.rotary ? "angle" : "displacement";
  const char* effort = out.rotary ? "torque" : "force";
  if (data.rows() < least_samples)
    throw Refusal(data.file, fmt::format("{} samples", data.rows()),
                  fmt::format("at least {} of a motion", least_samples), "a longer recording");
  refuse_constant(data, at, 1e-7, "a pair that is moved", "the column, or the sensor");
  refuse_constant(data, effort, 1e-9, "what moves it", "the column, or the sensor");
  refuse_clipped(data, effort, "a smaller motion, or a sensor for larger loads");
  out.time = data["time"];
  out.at = data[at];
  out.effort = data[effort];
  for (const char* name : {"pressure_1", "pressure_2"})
    if (data.has(name)) out.pressure.push_back(data[name]);
  out.resolution = smallest_step(out.at);
  Rates rates = rates_of(out.time, out.at, window);
  out.rate = std::move(rates.first);
  out.acceleration = std::move(rates.second);
  add_gap_note(out);
  return out;
}

PairRows pair_rows(const PairRecord& record, double from, double to, bool inside) {
  PairRows out;
  for (std::size_t i = 0; i < record.size(); ++i)
    if ((record.time[i] >= from && record.time[i] <= to) == inside) out.push_back(i);
  return out;
}

PairRows pair_block(const PairRows& rows, std::size_t k, bool inside) {
  PairRows out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if ((i * pair_blocks / rows.size() == k) == inside) out.push_back(rows[i]);
  return out;
}

PairRecord pair_thinned(const PairRecord& record) {
  constexpr std::size_t enough = 2000;
  const std::size_t stride = 1 + record.size() / enough;
  PairRecord out = record;
  const auto thin = [stride](std::vector<double>& values) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < values.size(); i += stride) values[n++] = values[i];
    values.resize(n);
  };
  for (auto* values : {&out.time, &out.at, &out.effort, &out.rate, &out.acceleration})
    thin(*values);
  for (std::vector<double>& p : out.pressure) thin(p);
  return out;
}

}  // namespace sinew::identify
