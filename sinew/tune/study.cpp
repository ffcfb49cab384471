#include "sinew/tune/study.h"

#include <algorithm>
#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/quantity.h"
#include "sinew/config/reader.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/tune/study.fields.h"

namespace sinew::tune {

Study load_study(const std::string& path) {
  const config::Node root = config::compose(path);
  if (config::format_kind(root) != "plan")
    config::fail({path, 0, 0}, "format", config::in_quotes(config::format_kind(root)),
                 "\"sinew.plan/1\"");
  Study out;
  config::Reader reader(root);
  std::string format;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  fields(reader, out);
  reader.finish();

  const config::Origin* named = config::find_origin(reader.origins(), "experiment");
  const std::filesystem::path folder = std::filesystem::path(named->where.file).parent_path();
  out.experiment = (folder / out.experiment).lexically_normal().string();
  return out;
}

Study load_study(const std::string& path, const Said& said) {
  const bool plan = config::format_kind(config::parse_file(path)) == "plan";
  Study out = plan ? load_study(path) : Study{};
  if (!plan) out.experiment = path;
  for (const auto list : {&Study::set, &Study::vary, &Study::range, &Study::where, &Study::report})
    (out.*list).insert((out.*list).end(), (said.study.*list).begin(), (said.study.*list).end());
  if (!said.study.largest.empty()) out.largest = said.study.largest;
  if (said.study.seeds > 0) out.seeds = said.study.seeds;
  if (said.study.points > 0) out.points = said.study.points;
  if (!said.study.units.empty()) out.units = said.study.units;
  if (said.sample == "sobol") out.sample = Sample::Kind::sobol;
  if (said.sample == "latin") out.sample = Sample::Kind::latin;
  if (said.sample == "random") out.sample = Sample::Kind::random;
  if (said.sample_seed) out.sample_seed = *said.sample_seed;
  if (said.halvings) out.halvings = *said.halvings;
  out.allow_unreachable = out.allow_unreachable || said.study.allow_unreachable;
  return out;
}

namespace {

std::optional<Sample> sample_of(const Study& study) {
  if (study.range.empty()) {
    if (study.points > 0)
      config::fail({"points", 0, 0}, "", config::format_number(study.points),
                   "ranges to sample from", "range=\"KEY=from:to unit\"");
    return std::nullopt;
  }
  if (study.points < 1)
    config::fail({"range", 0, 0}, "", config::in_quotes(study.range.front()),
                 "how many points to sample", "points=256");
  Sample out{.kind = study.sample,
             .ranges = {},
             .points = static_cast<std::size_t>(study.points),
             .seed = static_cast<std::uint64_t>(study.sample_seed)};
  for (const std::string& text : study.range) out.ranges.push_back(parse_range(text, "range"));
  if (out.ranges.size() > most_ranges)
    config::fail({"range", 0, 0}, "", std::to_string(out.ranges.size()) + " ranges",
                 "at most " + std::to_string(most_ranges));
  return out;
}

// A key that is set twice would have the later value, and the table both.
void refuse_twice(const Sweep& s) {
  std::vector<std::string> seen;
  const auto take = [&](const Axis& axis) {
    if (std::ranges::find(seen, axis.key) != seen.end())
      config::fail({axis.key, 0, 0}, "", "given twice", "once, in a range or in vary");
    seen.push_back(axis.key);
  };
  if (s.sample)
    for (const Range& range : s.sample->ranges) take(range.axis);
  for (const Axis& axis : s.axes) take(axis);
}

Sweep words_of(const Study& study) {
  Sweep out{.experiment = study.experiment, .sets = study.set};
  out.allow_unreachable = study.allow_unreachable;
  for (const std::string& text : study.vary) out.axes.push_back(parse_axis(text, "vary"));
  if (study.seeds > 0) out.axes.push_back(seeds(study.seeds));
  out.sample = sample_of(study);
  refuse_twice(out);
  for (const std::string& text : study.report)
    std::ranges::move(parse_figures(text, "report"), std::back_inserter(out.report));
  if (study.largest.empty()) {
    if (!study.where.empty())
      config::fail({"where", 0, 0}, "", config::in_quotes(study.where.front()),
                   "a key whose largest value is searched", "largest=\"KEY=from:to:n\"");
    return out;
  }
  out.largest = Search{parse_axis(study.largest, "largest"), {}, study.halvings};
  for (const std::string& text : study.where)
    out.largest->where.push_back(parse_condition(text, "where"));
  if (study.where.empty())
    config::fail({"largest", 0, 0}, "", "nothing that must hold", "key < value",
                 "where=\"joints.hip.tracking_rms_rad < 5 deg\"");
  return out;
}

}  // namespace

Sweep sweep_of(const Study& study) {
  Sweep out = words_of(study);
  if (!study.units.empty())
    show_in(config::parse_shown_units(study.units, {"units", 0, 0}, ""), out.report);
  if (!out.report.empty()) return out;
  const experiment::Experiment e = run::buildable(out.experiment, out.sets);
  out.report = reported_figures(e.reported, e.air.atmosphere);
  return out;
}

}  // namespace sinew::tune
