#include "thesis/figures/leg_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/analysis/record/derived.h"
#include "sinew/config/compose.h"
#include "sinew/report/figures/run_figures.h"
#include "sinew/run/simulation/run.h"

namespace sinew::thesis {
namespace {

std::string file_of(const std::string& name) { return "experiments/" + name + ".toml"; }

}  // namespace

LegRun::LegRun(const Sources& from, const std::string& name)
    : file_(file_of(name)),
      table_(run::run(experiment::load(from.path(file_))).table),
      analysis_(table_, analysis::read_machine(config::compose(from.path(file_), {}))),
      start_(analysis_.record.sequence_start()) {}

double LegRun::summary(std::string_view key) const {
  const double* value = analysis_.summary.find(key);
  return value ? *value : std::nan("");
}

std::string LegRun::caption(const std::string& what) const {
  return fmt::format(
      "{} Simulated with {}, in the place of the thesis's measurement. Time counts from the first "
      "phase on.",
      what, file_);
}

Window LegRun::sequence() const { return {0, analysis_.record.sequence_end() - start_}; }

Window LegRun::phase(std::string_view name) const {
  for (const analysis::PhaseSpan& s : analysis_.record.phase_spans())
    if (analysis_.machine.phases[static_cast<std::size_t>(s.phase)] == name)
      return {analysis_.record.time(s.first) - start_,
              analysis_.record.end_of(s.last - 1) - start_};
  return {};
}

std::vector<report::Span> LegRun::stance() const {
  std::vector<report::Span> out = report::stance_of(analysis_.record, analysis_.machine);
  for (report::Span& s : out) s = {s.from - start_, s.to - start_};
  return out;
}

report::Channels LegRun::channels() const {
  report::Channels out;
  out.add(table_);
  out.add(analysis_.derived);
  return out;
}

bool LegRun::within(const Window& window, std::int64_t time_ns) const {
  const double t = static_cast<double>(time_ns) / 1e9 - start_;
  return t > window.from - 1e-9 && t < window.to + 1e-9;
}

// A duty is shown as a share; the unit in the log does not distinguish it from other numbers.
units::ShownUnit LegRun::unit_of(const report::Channel& channel) const {
  const report::Samples samples = channels().find(channel);
  return units::ShownUnits(units::UnitSet::thesis)
      .of(channel.topic.ends_with("_duty") ? "share" : samples.unit, 0,
          analysis_.machine.atmosphere);
}

report::Curve LegRun::curve(const std::string& label, const report::Channel& channel,
                            const Window& window, int color, double sign) const {
  report::Curve out{.label = label, .color = color, .source = file_ + ", " + channel.topic};
  const report::Samples samples = channels().find(channel);
  if (!samples) return out;
  const units::ShownUnit unit = unit_of(channel);
  for (std::size_t i = 0; i < samples.values->size(); ++i) {
    const std::int64_t at = (*samples.time_ns)[i];
    if (!within(window, at)) continue;
    out.xs.push_back(static_cast<double>(at) / 1e9 - start_);
    out.ys.push_back(sign * unit.of((*samples.values)[i]));
  }
  return out;
}

report::Curve LegRun::desired(const std::string& label, const report::Channel& channel,
                              const Window& window, int color) const {
  report::Curve out = curve(label, channel, window, color);
  out.kind = report::Curve::Kind::desired;
  return out;
}

report::Curve LegRun::path(const std::string& label, const std::string& topic,
                           const Window& window) const {
  report::Curve out = curve(label, {topic, "x"}, window, report::Curve::next);
  out.xs = std::move(out.ys);
  out.ys = curve(label, {topic, "y"}, window, report::Curve::next).ys;
  return out;
}

analysis::Column LegRun::rows(const report::Channel& channel) const {
  analysis::Column out;
  const units::ShownUnit unit = unit_of(channel);
  for (const double si : analysis_.record.column(channel.topic, channel.field))
    out.push_back(unit.of(si));
  return out;
}

std::vector<report::Claim> LegRun::verdicts(const std::vector<std::string>& keys) const {
  std::vector<report::Claim> out;
  for (const analysis::Verdict& v : analysis_.verdicts)
    if (std::ranges::any_of(keys, [&](const std::string& k) { return v.key.starts_with(k); }))
      out.push_back(described_claim(v));
  return out;
}

report::Plot over_time(const LegRun& run, const std::string& quantity, const std::string& unit,
                       std::vector<report::Curve> curves) {
  const Window all = run.sequence();
  return {.name = report::file_name_of(quantity),
          .x = {"time", "s", all.from, all.to},
          .y = {quantity, unit},
          .curves = std::move(curves),
          .spans = run.stance()};
}

std::vector<report::Curve> of_joints(const LegRun& run, const std::string& what, bool desired) {
  std::vector<report::Curve> out;
  int color = 0;
  for (const char* joint : {"hip", "knee"}) {
    const std::string topic = fmt::format("/joint/{}{}", joint, what);
    out.push_back(run.curve(fmt::format("{} (simulated)", joint), {topic}, run.sequence(), color));
    if (desired)
      out.push_back(run.desired(fmt::format("{} desired", joint), {"/desired" + topic},
                                run.sequence(), color));
    ++color;
  }
  return out;
}

report::Figure joint_angles(const LegRun& run, const std::string& number,
                            const std::string& title) {
  return {.name = number,
          .title = title,
          .caption = run.caption("Desired and actual angles."),
          .plots = {over_time(run, "joint angle", "deg", of_joints(run, "/angle", true))}};
}

report::Figure foot_path(const LegRun& run, const std::string& number, const std::string& title,
                         const std::string& caption, const Window& window) {
  report::Curve actual = run.path("actual (simulated)", "/foot/position", window);
  report::Curve desired = once(run.path("desired", "/desired/foot/position", window));
  desired.kind = report::Curve::Kind::desired;
  return {.name = number,
          .title = title,
          .caption = run.caption(caption),
          .plots = {{.x = {"x forward", "in"},
                     .y = {"y up", "in"},
                     .curves = {std::move(actual), std::move(desired)},
                     .equal_scale = true}}};
}

}  // namespace sinew::thesis
