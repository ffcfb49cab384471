#include "sinew/tune/results/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sinew/run/folder/files.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/hash.h"

namespace sinew::tune {
namespace {

// Returns every value in SI, without title and sources, which have no effect on results.
std::string values_of(const std::string& file, const std::vector<std::string>& sets) {
  experiment::Experiment e = run::buildable(file, sets);
  e.origins.clear();
  e.title.clear();
  e.reproduces.clear();
  return experiment::resolved(e, SINEW_VERSION);
}

// Returns the values that result from a word, which may name a file; empty if the word is invalid
// without another axis, so that only its name counts.
std::string values_of_word(const Sweep& s, const Axis& axis, const Value& value) try {
  if (axis.key == "experiment") return values_of(experiment_path(s, value.text), s.sets);
  std::vector<std::string> sets = s.sets;
  sets.push_back(axis.set(value));
  return values_of(s.experiment, sets);
} catch (const config::Error&) {
  return "";
}

const char* to_text(Sample::Kind kind) {
  if (kind == Sample::Kind::random) return "random";
  return kind == Sample::Kind::latin ? "latin" : "sobol";
}

const char* to_text(Range::Scale scale) {
  if (scale == Range::Scale::log) return " log";
  return scale == Range::Scale::whole ? " whole" : "";
}

class Text {
 public:
  void line(std::string_view name, std::string_view value) {
    out_ += fmt::format("{} = {}\n", name, value);
  }
  void block(std::string_view text) { out_ += text; }

  void axis(std::string_view name, const Axis& axis, const char* scale = "") {
    std::string values;
    for (const Value& v : axis.values) values += (values.empty() ? "" : ", ") + v.text;
    line(name, axis.heading() + ": " + values + scale);
  }

  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

void add_sample(const Sample& sample, Text& out) {
  const auto bytes = std::as_bytes(std::span(sample.given));
  const std::string points = sample.given.empty()
                                 ? fmt::format("{}, seed {}", to_text(sample.kind), sample.seed)
                                 : fmt::format("given, {:016x}", units::hash(bytes));
  const bool whole = !sample.given_later || !sample.given.empty();
  out.line("sample", whole ? fmt::format("{} points, {}", sample.points, points) : "handed out");
  for (const Range& range : sample.ranges) out.axis("range", range.axis, to_text(range.scale));
}

void add_search(const Search& search, Text& out) {
  out.axis("largest", search.axis);
  for (const Condition& c : search.where) out.line("where", c.text);
  out.line("halvings", std::to_string(search.halvings));
}

void add_case(const Sweep& s, const Case& one, Text& out) {
  out.line("case", fmt::format("{}, weight {}", one.name, one.weight));
  std::vector<std::string> sets = s.sets;
  sets.insert(sets.end(), one.sets.begin(), one.sets.end());
  out.block(values_of(one.experiment.empty() ? s.experiment : one.experiment, sets));
}

std::string text_of(const Sweep& s) {
  Text out;
  out.line("sinew", SINEW_VERSION);
  for (const Figure& f : s.report) out.line("report", fmt::format("{} [{}]", f.key, f.unit));
  if (s.sample) add_sample(*s.sample, out);
  for (const Axis& axis : s.axes) out.axis("vary", axis);
  if (s.largest) add_search(*s.largest, out);
  out.line("allow_unreachable", s.allow_unreachable ? "true" : "false");
  out.block(values_of(s.experiment, s.sets));
  for (const Case& one : s.cases) add_case(s, one, out);
  for (const Axis& axis : s.axes)
    for (const Value& value : axis.values) {
      if (value.number) continue;
      out.line(axis.key, value.text);
      out.block(values_of_word(s, axis, value));
    }
  return out.take();
}

bool has_numbers(const Axis& axis) {
  return std::ranges::all_of(axis.values, [](const Value& v) { return v.number.has_value(); });
}

// Returns the columns in the order of headings().
std::vector<Column> columns_of(const Sweep& s) {
  std::vector<Column> out;
  for (const std::string& heading : headings(s)) out.push_back({heading});
  std::size_t at = 0;
  if (s.sample)
    for (; at < s.sample->ranges.size(); ++at) out[at].role = Column::Role::parameter;
  if (!s.cases.empty()) out[at++] = {"case", false, Column::Role::circumstance};
  for (const Axis& axis : s.axes) {
    out[at].role = axis.key == "seed" ? Column::Role::circumstance : Column::Role::parameter;
    out[at++].number = has_numbers(axis);
  }
  if (s.largest) ++at;
  for (std::size_t i = 0; i < s.report.size(); ++i) out[at++].role = Column::Role::figure;
  out.back().number = false;
  return out;
}

[[noreturn]] void refuse_version(const std::filesystem::path& file, const Difference& d) {
  const auto version = [](const std::string& line) { return line.substr(line.find("= ") + 2); };
  run::refuse(file, "a study of Sinew " + version(d.first),
              "one of this version, " + version(d.second),
              "another name, or that version of Sinew: numbers of both are no one table");
}

}  // namespace

StudyRequest request_of(const Sweep& s) {
  return {.text = text_of(s),
          .columns = columns_of(s),
          .points = points(s),
          .experiment = s.experiment,
          .sets = s.sets,
          .cases = s.cases};
}

std::string hash_of(const StudyRequest& request) {
  return fmt::format("{:016x}", units::hash(std::string_view(request.text)));
}

Difference difference(const std::string& first, const std::string& second) {
  std::istringstream a(first), b(second);
  std::string line_a, line_b, table_a, table_b;
  for (;;) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) return {};
    if (more_a && more_b && line_a == line_b) {
      if (line_a.starts_with('[')) table_a = table_b = line_a + " ";
      continue;
    }
    return {more_a ? table_a + line_a : "nothing", more_b ? table_b + line_b : "nothing"};
  }
}

// Returns the text without the formats of its experiments: a newer format alone changes no value.
// A key that it renames still makes another study.
std::string without_format(const std::string& text) {
  std::string out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with("format = \"sinew.experiment/")) out += line + "\n";
  return out;
}

void require_same(const std::filesystem::path& file, const StudyRequest& held,
                  const StudyRequest& request) {
  const std::string old_text = without_format(held.text), new_text = without_format(request.text);
  if (old_text == new_text) return;
  const Difference d = difference(old_text, new_text);
  if (d.first.starts_with("sinew = ") && d.second.starts_with("sinew = ")) refuse_version(file, d);
  run::refuse(file, "another study, with " + config::in_quotes(d.first),
              config::in_quotes(d.second) + ", as now requested", "another name");
}

}  // namespace sinew::tune
