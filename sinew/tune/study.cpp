#include "sinew/tune/study.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "sinew/analysis/absent.h"
#include "sinew/config/changes.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/reader.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/tune/study.fields.h"
#include "sinew/units/quantity.h"

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
  out.places = places_of(root);
  for (const auto list : {&Study::set, &Study::vary, &Study::range})
    for (std::string& text : out.*list) text = config::with_present_key(text);
  out.largest = config::with_present_key(out.largest);

  const config::Origin& named = *config::find_origin(reader.origins(), "experiment");
  out.experiment = config::file_of(config::make_text("", out.experiment, named.where), named.path);
  return out;
}

Study load_study(const std::string& path, const StudyOptions& options) {
  const bool plan = config::format_kind(config::parse_file(path)) == "plan";
  Study out = plan ? load_study(path) : Study{};
  if (!plan) out.experiment = path;
  // A value of the options is not the plan's, even if it has the same text.
  const auto not_of_plan = [&](const char* key, const std::string& text) {
    out.places.erase({key, text});
  };
  const auto add = [&](const char* key, std::vector<std::string> Study::*list) {
    for (const std::string& text : options.study.*list) {
      not_of_plan(key, text);
      (out.*list).push_back(text);
    }
  };
  add("set", &Study::set);
  add("vary", &Study::vary);
  add("range", &Study::range);
  add("where", &Study::where);
  add("report", &Study::report);
  const auto replace = [&](const char* key, const std::string& text, auto& value, auto with) {
    not_of_plan(key, text);
    value = with;
  };
  const Study& own = options.study;
  if (!own.largest.empty()) replace("largest", own.largest, out.largest, own.largest);
  if (own.seeds > 0) replace("seeds", std::to_string(own.seeds), out.seeds, own.seeds);
  if (own.points > 0) replace("points", std::to_string(own.points), out.points, own.points);
  if (!options.study.units.empty()) out.units = options.study.units;
  if (options.sample == "sobol") out.sample = Sample::Kind::sobol;
  if (options.sample == "latin") out.sample = Sample::Kind::latin;
  if (options.sample == "random") out.sample = Sample::Kind::random;
  if (options.sample_seed) out.sample_seed = *options.sample_seed;
  if (options.halvings) out.halvings = *options.halvings;
  out.allow_unreachable = out.allow_unreachable || options.study.allow_unreachable;
  return out;
}

namespace {

// Throws config::Error about a value of a plan, or of a setting given in addition.
[[noreturn]] void refuse_value(const Study& study, const char* key, const std::string& text,
                               std::string found, std::string expected, std::string try_this = "") {
  config::fail({place_of(study.places, key, text), 0, 0}, "", std::move(found), std::move(expected),
               std::move(try_this));
}

std::optional<Sample> sample_of(const Study& study) {
  if (study.range.empty()) {
    const std::string points = std::to_string(study.points);
    if (study.points > 0)
      refuse_value(study, "points", points, points, "ranges to sample from",
                   "range=\"KEY=from:to unit\"");
    return std::nullopt;
  }
  const std::string& first = study.range.front();
  if (study.points < 1)
    refuse_value(study, "range", first, config::in_quotes(first), "how many points to sample",
                 "points=256");
  Sample out{.kind = study.sample,
             .ranges = {},
             .points = static_cast<std::size_t>(study.points),
             .seed = static_cast<std::uint64_t>(study.sample_seed)};
  for (const std::string& text : study.range)
    out.ranges.push_back(parse_range(text, place_of(study.places, "range", text)));
  if (out.ranges.size() > most_ranges)
    refuse_value(study, "range", first, std::to_string(out.ranges.size()) + " ranges",
                 "at most " + std::to_string(most_ranges));
  return out;
}

// Refuses a key that is set twice: the later value would apply, but the table would show both.
void refuse_twice(const Sweep& s) {
  std::vector<std::string> seen;
  const auto take = [&](const Axis& axis) {
    if (std::ranges::find(seen, axis.key) != seen.end())
      config::fail({axis.setting, 0, 0}, "", axis.key + " given twice",
                   "it once, in a range or in vary");
    seen.push_back(axis.key);
  };
  if (s.sample)
    for (const Range& range : s.sample->ranges) take(range.axis);
  for (const Axis& axis : s.axes) take(axis);
}

Sweep words_of(const Study& study) {
  const auto place = [&](const char* key, const std::string& text) {
    return place_of(study.places, key, text);
  };
  Sweep out{.experiment = study.experiment, .sets = study.set, .places = study.places};
  out.allow_unreachable = study.allow_unreachable;
  for (const std::string& text : study.vary)
    out.axes.push_back(parse_axis(text, place("vary", text)));
  if (study.seeds > 0)
    out.axes.push_back(seeds(study.seeds, place("seeds", std::to_string(study.seeds))));
  out.sample = sample_of(study);
  refuse_twice(out);
  for (const std::string& text : study.report)
    std::ranges::move(parse_figures(text, place("report", text)), std::back_inserter(out.report));
  if (study.largest.empty()) {
    if (!study.where.empty())
      refuse_value(study, "where", study.where.front(), config::in_quotes(study.where.front()),
                   "a key whose largest value is searched", "largest=\"KEY=from:to:n\"");
    return out;
  }
  out.largest =
      Search{parse_axis(study.largest, place("largest", study.largest)), {}, study.halvings};
  for (const std::string& text : study.where)
    out.largest->where.push_back(parse_condition(text, place("where", text)));
  if (study.where.empty())
    refuse_value(study, "largest", study.largest, "nothing that must hold", "key < value",
                 "where=\"joints.hip.tracking_rms_rad < 5 deg\"");
  return out;
}

// Returns whether the outer key is the key itself, or a table or list that contains it.
bool contains(const std::string& outer, const std::string& key) {
  return key.starts_with(outer) &&
         (key.size() == outer.size() || key[outer.size()] == '.' || key[outer.size()] == '[');
}

// Changes the problem's place to that of its setting in a plan or a tuning, if it is there. If
// several settings have the key, the last one applies.
void find_place(const Sweep& s, const std::vector<std::string>& sets, config::Problem& problem) {
  const auto set = std::find_if(sets.rbegin(), sets.rend(), [&](const std::string& text) {
    const std::string key(trimmed(std::string_view(text).substr(0, text.find('='))));
    return problem.key.empty() ? problem.found == config::in_quotes(text)
                               : contains(problem.key, key) || contains(key, problem.key);
  });
  if (set == sets.rend()) return;
  const auto place = s.places.find({"set", *set});
  if (place != s.places.end()) problem.where = place->second;
}

// Returns the experiment of that file with these settings. Throws config::Error.
experiment::Experiment built(const Sweep& s, const std::string& file,
                             const std::vector<std::string>& sets) try {
  return run::buildable(file, sets);
} catch (const config::Error& e) {
  std::vector<config::Problem> problems = e.problems();
  for (config::Problem& problem : problems)
    if (problem.where.file == "--set") find_place(s, sets, problem);
  throw config::Error(std::move(problems));
}

}  // namespace

Sweep sweep_of(const Study& study) {
  Sweep out = words_of(study);
  if (!study.units.empty())
    show_in(config::parse_shown_units(study.units, {"units", 0, 0}, ""), out.report);
  if (!out.report.empty()) return out;
  const experiment::Experiment e = built(out, out.experiment, out.sets);
  out.report = reported_figures(e.reported, e.air.atmosphere);
  return out;
}

// Checks of an axis against the experiment, before the first run.

namespace {

const std::string& first_text(const Axis& axis) { return axis.values.front().text; }

// Throws the mistake of an axis at the setting where the axis was written.
[[noreturn]] void refuse_axis(const Axis& axis, const units::Mistake& mistake) {
  config::fail({axis.setting, 0, 0}, "", axis.key + ": " + mistake.found, mistake.expected,
               mistake.try_this);
}

[[noreturn]] void unknown_key(const Axis& axis, const config::Origins& origins) {
  std::vector<std::string_view> known;
  for (const config::Origin& origin : origins) known.push_back(origin.path);
  refuse_axis(axis, {"an unknown key", "one that sinew show lists",
                     config::closest_in_quotes(axis.key, known)});
}

// If one of an experiment's problems is that of an axis, of the list with its element, or of a
// table that the axis creates, throws it.
void throw_problem_of(const Axis& axis, const config::Error& e) {
  for (const config::Problem& problem : e.problems())
    if (problem.key == axis.key || axis.key.starts_with(problem.key + '[') ||
        (problem.where.file == "--set" && axis.key.starts_with(problem.key + '.')))
      config::fail({axis.setting, 0, 0}, "", problem.key + ": " + problem.found, problem.expected,
                   problem.try_this);
}

// Returns the experiment with a value of an axis. Throws config::Error if it is refused.
experiment::Experiment with_value(const Sweep& s, const Axis& axis, const std::string& set) {
  std::vector<std::string> sets = s.sets;
  sets.push_back(set);
  try {
    return built(s, s.experiment, sets);
  } catch (const config::Error& e) {
    throw_problem_of(axis, e);
    throw;
  }
}

// Returns whether a word may be allowed by a word of another axis, such as the actuator of another
// robot.
bool depends_on_others(const Sweep& s, const Axis& axis) {
  const auto has_words = [&](const Axis& other) {
    return other.key != axis.key &&
           std::ranges::any_of(other.values, [](const Value& v) { return !v.number; });
  };
  return axis.key != "robot" && std::ranges::any_of(s.axes, has_words);
}

// Checks the least and the greatest number and one that is not whole, each alone, and the words
// unless they depend on other axes. Other faults of the experiment are ignored, since another axis
// may correct them.
void check_without_unit(const Sweep& s, const Axis& axis) {
  const bool skips_words = depends_on_others(s, axis);
  const auto [least, greatest] = std::ranges::minmax_element(
      axis.values, {}, [](const Value& v) { return v.number.value_or(0); });
  const auto part = std::ranges::find_if(
      axis.values, [](const Value& v) { return v.number && *v.number != std::floor(*v.number); });
  for (auto value = axis.values.begin(); value != axis.values.end(); ++value) {
    const bool is_checked = value == least || value == greatest || value == part;
    if (value->number ? !is_checked : skips_words) continue;
    std::vector<std::string> sets = s.sets;
    sets.push_back(axis.set(*value));
    try {
      (void)run::buildable(s.experiment, sets);
    } catch (const config::Error& e) {
      throw_problem_of(axis, e);
    }
  }
}

void check_values(const Sweep& s, const Axis& axis, const config::Origin& origin,
                  double atmosphere) {
  if (origin.unit.empty()) return check_without_unit(s, axis);
  for (const Value& value : axis.values) {
    const auto mistake =
        units::parse_quantity(value.text, origin.unit, atmosphere, origin.text).mistake;
    if (mistake) refuse_axis(axis, *mistake);
  }
}

// Checks the first and the last value of an element of a list, which has no origin of its own.
void check_element(const Sweep& s, const Axis& axis) {
  for (const Value* value : {&axis.values.front(), &axis.values.back()})
    (void)with_value(s, axis, axis.set(*value));
}

void check_experiments(const Sweep& s, const Axis& axis) {
  for (const Value& value : axis.values) {
    const std::string file = experiment_path(s, value.text);
    if (!std::filesystem::exists(file))
      refuse_axis(axis, {config::in_quotes(value.text), "a file that exists",
                         "the path: looked for " + file});
    (void)built(s, file, s.sets);
  }
}

void check_axis(const Sweep& s, const Axis& axis, const config::Origins& origins,
                double atmosphere) {
  if (axis.key == "robot") return check_without_unit(s, axis);
  if (axis.key.ends_with(']')) return check_element(s, axis);
  if (axis.key == "experiment") return check_experiments(s, axis);
  if (const config::Origin* origin = config::find_origin(origins, axis.key))
    return check_values(s, axis, *origin, atmosphere);

  // The key may exist only after it has been set. If it does not, the reader reports the fault.
  if (axis.key.find('.') == axis.key.npos) unknown_key(axis, origins);
  const experiment::Experiment e = with_value(s, axis, axis.key + "=" + first_text(axis));
  const config::Origin* origin = config::find_origin(e.origins, axis.key);
  if (!origin) unknown_key(axis, e.origins);
  check_values(s, axis, *origin, atmosphere);
}

// Checks also a value between the ends, which fails if the key takes whole numbers. A range of
// files is refused with the advice of vary, unless its numbers are given by a tuning or a
// sensitivity study, which have no vary.
void check_range(const Sweep& s, const Range& range, const config::Origins& origins,
                 double atmosphere) {
  if (range.axis.key == "robot" || range.axis.key == "experiment") {
    if (s.sample->given_later || !s.sample->given.empty())
      refuse_axis(range.axis, {"a range", "a key that has numbers", ""});
    refuse_axis(range.axis, {"a range", "a list of files, in vary",
                             "vary=\"" + range.axis.key + "=a.toml,b.toml\""});
  }
  check_axis(s, range.axis, origins, atmosphere);
  const Axis between{range.axis.key, range.axis.unit, {range.at(0.4321)}, range.axis.setting};
  check_axis(s, between, origins, atmosphere);
}

// Throws the error of the case's experiment.
void check_case(const Sweep& s, const Case& one) {
  std::vector<std::string> sets = s.sets;
  sets.insert(sets.end(), one.sets.begin(), one.sets.end());
  (void)built(s, one.experiment.empty() ? s.experiment : one.experiment, sets);
}

// Returns the machines of all runs; none if a value of an axis is a word, which may choose another
// machine.
std::vector<analysis::Machine> machines_of(const Sweep& s) {
  std::vector<analysis::Machine> out;
  const auto add = [&](const std::string& file, const std::vector<std::string>& sets) {
    out.push_back(analysis::read_machine(config::compose(file, sets)));
  };
  for (const Axis& axis : s.axes) {
    if (axis.key == "experiment") {
      for (const Value& value : axis.values) add(experiment_path(s, value.text), s.sets);
    } else if (std::ranges::any_of(axis.values, [](const Value& v) { return !v.number; })) {
      return {};
    }
  }
  for (const Case& one : s.cases) {
    std::vector<std::string> sets = s.sets;
    sets.insert(sets.end(), one.sets.begin(), one.sets.end());
    add(one.experiment.empty() ? s.experiment : one.experiment, sets);
  }
  if (out.empty()) add(s.experiment, s.sets);
  return out;
}

// Refuses figures and conditions that no run can have.
void check_figures(const Sweep& s) {
  const std::vector<analysis::Machine> machines = machines_of(s);
  std::vector<config::Problem> problems;
  const auto refuse_absent = [&](const std::string& key, const std::string& setting) {
    std::optional<units::Mistake> mistake;
    for (const analysis::Machine& machine : machines)
      if (mistake = analysis::absent(key, machine); !mistake) return;
    if (mistake)
      problems.push_back({.where = {setting, 0, 0},
                          .key = {},
                          .found = key + ": " + mistake->found,
                          .expected = mistake->expected,
                          .try_this = mistake->try_this});
  };
  for (const Figure& figure : s.report) refuse_absent(figure.key, figure.setting);
  if (s.largest)
    for (const Condition& condition : s.largest->where)
      refuse_absent(condition.key, condition.setting);
  if (!problems.empty()) throw config::Error(std::move(problems));
}

// Refuses too many points, before they are allocated and before their number overflows.
void refuse_too_many(const Sweep& s) {
  double all = 1;
  std::string product;
  const auto times = [&](std::size_t count) {
    all *= static_cast<double>(count);
    product += fmt::format("{}{}", product.empty() ? "" : " x ", count);
  };
  if (s.sample) times(s.sample->points);
  if (!s.cases.empty()) times(s.cases.size());
  for (const Axis& axis : s.axes) times(axis.values.size());
  if (all <= static_cast<double>(most_points)) return;
  std::string setting = "points";
  if (s.sample && !s.sample->ranges.empty()) setting = s.sample->ranges.front().axis.setting;
  if (!s.axes.empty()) setting = s.axes.front().setting;
  config::fail({setting, 0, 0}, "", fmt::format("{} = {:.6g} points", product, all),
               fmt::format("at most {}", most_points),
               "fewer values, or one sweep after the other");
}

}  // namespace

void check(const Sweep& s) {
  refuse_too_many(s);
  const experiment::Experiment e = built(s, s.experiment, s.sets);
  const config::Origins& origins = e.origins;
  const double atmosphere = e.air.atmosphere;
  if (s.sample)
    for (const Range& range : s.sample->ranges) check_range(s, range, origins, atmosphere);
  for (const Case& one : s.cases) check_case(s, one);
  for (const Axis& axis : s.axes) check_axis(s, axis, origins, atmosphere);
  if (keys(s).empty())
    config::fail({s.experiment, 0, 0}, "", "no [[reported]] figure",
                 "a figure for the rows of the table", "report=\"duration_s\"");
  check_figures(s);
  if (!s.largest) return;
  for (const Value& value : s.largest->axis.values)
    if (!value.number)
      refuse_axis(s.largest->axis,
                  {config::in_quotes(value.text), "numbers, to be halved between", ""});
  check_axis(s, s.largest->axis, origins, atmosphere);
}

}  // namespace sinew::tune
