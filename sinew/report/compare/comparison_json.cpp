#include <algorithm>
#include <cmath>
#include <deque>

#include "sinew/json/json.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"

namespace sinew::report {
namespace {

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

// Alignment of a run with the first one.
Json alignment_of(const analysis::Alignment& a) {
  Json out{{"shift_s", a.clock.shift},
           {"shift_uncertainty_s", a.shift_uncertainty},
           {"rate", a.clock.rate},
           {"rate_uncertainty", a.rate_uncertainty},
           {"correlation", a.correlation},
           {"channels", a.channels},
           {"event", a.event.empty() ? Json() : Json(a.event)},
           {"pieces", a.pieces},
           {"same", a.same}};
  if (a.rate_seen != 0) {
    out["rate_seen"] = a.rate_seen;
    out["rate_seen_uncertainty"] = a.rate_seen_uncertainty;
  }
  return out;
}

Json runs_of(const Comparison& c) {
  return Json::array(c.runs, [](const ComparedRun& run) {
    Json out{{"label", run.label},
             {"title", run.title},
             {"reproduces", run.reproduces},
             {"robot", run.robot},
             {"seed", run.seed},
             {"version", run.version},
             {"complete", run.logged.complete},
             {"shift_s", run.shift},
             {"first_s", run.first},
             {"last_s", run.last}};
    if (run.alignment) out["alignment"] = alignment_of(*run.alignment);
    return out;
  });
}

Json figures_of(const Comparison& c) {
  Json out = Json::array();
  for (const analysis::FigureRow& row : c.figures) {
    Json values = Json::array(), differences = Json::array(), relative = Json::array(),
         verdicts = Json::array();
    bool judged = false;
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const bool both = row.values.front() && row.values[i] && i > 0;
      values.push_back(or_null(row.values[i]));
      differences.push_back(both ? Json(*row.values[i] - *row.values.front()) : Json());
      relative.push_back(
          both ? or_null(analysis::relative_difference(*row.values.front(), *row.values[i]))
               : Json());
      const std::string verdict = c.runs[i].verdict_of(row.key);
      judged = judged || !verdict.empty();
      verdicts.push_back(verdict.empty() ? Json() : Json(verdict));
    }
    out.push_back({{"key", row.key},
                   {"values", std::move(values)},
                   {"differences", std::move(differences)},
                   {"relative", std::move(relative)}});
    if (judged) out.back()["verdicts"] = std::move(verdicts);
  }
  return out;
}

Json parameters_of(const Comparison& c) {
  return Json::array(c.parameters, [](const ParameterRow& row) -> Json {
    return {{"key", row.key}, {"values", Json::array(row.values, or_null<std::string>)}};
  });
}

Json difference_of(const std::optional<analysis::Difference>& d) {
  if (!d) return {};
  return {{"meet", to_text(d->how)}, {"same", d->same},
          {"samples", d->samples},   {"gaps", d->gaps},
          {"rms", d->rms},           {"largest", d->largest},
          {"at_s", d->at},           {"span", d->span},
          {"bias", d->bias},         {"correlation", d->correlation}};
}

Json channels_of(const Comparison& c) {
  return Json::array(c.channels, [](const ChannelRow& row) -> Json {
    return {{"topic", row.channel.topic},
            {"field", row.channel.field},
            {"unit", row.unit},
            {"differences", Json::array(row.differences, difference_of)}};
  });
}

Json tables_of(const Comparison& c) {
  return {{"format", "sinew.comparison/1"},
          {"align", to_text(c.align)},
          {"clock", c.clocks_fitted ? "fit" : "none"},
          {"runs", runs_of(c)},
          {"figures", figures_of(c)},
          {"parameters", parameters_of(c)},
          {"channels", channels_of(c)}};
}

// --- samples ---

// Columns of all runs, and differences of the others from the first one. A column that equals the
// first one's is stored once. If all samples meet, a run's own column is left out: it is the sum of
// the first one's and the difference, which preserves the digits of small differences.
class RunSamples {
 public:
  explicit RunSamples(const Comparison& c) {
    for (const ComparedRun& run : c.runs) {
      channels_.emplace_back();
      channels_.back().add(run.logged);
      channels_.back().add(run.derived);
      channels_.back().add(run.drawn);
    }
  }

  void put(const Channel& channel, Json& panel) {
    const Samples first = channels_.front().find(channel);
    Json columns = {blob_.add(first)}, differences = {nullptr};
    for (std::size_t i = 1; i < channels_.size(); ++i) {
      const Samples other = channels_[i].find(channel);
      Json column, difference;
      if (other && other.unit == first.unit) put_other(first, other, column, difference);
      columns.push_back(std::move(column));
      differences.push_back(std::move(difference));
    }
    panel["columns"] = std::move(columns);
    panel["differences"] = std::move(differences);
  }

  // Returns the columns of one run.
  Columns columns(std::size_t run) { return {channels_[run], blob_}; }
  const Blob& blob() const { return blob_; }

 private:
  void put_other(const Samples& first, const Samples& other, Json& column, Json& difference) {
    const analysis::Recording a{first.time_ns, first.values}, b{other.time_ns, other.values};
    const analysis::PairedSamples met = analysis::pair_samples(a, b);
    if (analysis::difference(a, b, met).same) {
      column = blob_.add(first);
      return;
    }
    // The sum is exact if all times are equal and the difference is NaN only where `other` is.
    bool sum_is_other = met.time_ns == *first.time_ns && met.time_ns == *other.time_ns;
    for (std::size_t i = 0; sum_is_other && i < met.difference.size(); ++i)
      sum_is_other = std::isfinite(met.difference[i]) || std::isnan((*other.values)[i]);
    if (!sum_is_other) column = blob_.add(other);
    if (met.time_ns.empty()) return;
    met_.push_back(met);
    difference = blob_.add({&met_.back().time_ns, &met_.back().difference, first.unit});
  }

  std::vector<Channels> channels_;
  std::deque<analysis::PairedSamples> met_;  // the blob points into them
  Blob blob_;
};

// Returns a plot for every line of the first run's panels that another run has too.
Json panels_of(const Comparison& c, RunSamples& samples) {
  Json out = Json::array();
  for (const Plot& panel : c.runs.front().panels)
    for (const Curve& line : panel.curves) {
      const Channel& channel = line.y_channel;
      if (std::ranges::find(c.channels, channel, &ChannelRow::channel) == c.channels.end())
        continue;
      out.push_back({{"group", panel.group},
                     {"title", panel.title},
                     {"unit", panel.y.unit},
                     {"label", line.label},
                     {"topic", channel.topic},
                     {"field", channel.field},
                     {"main", line.kind != Curve::Kind::desired && !line.hidden}});
      samples.put(channel, out.back());
    }
  return out;
}

// Returns the first run's charts, with the curves of all runs that have a chart of the same title.
Json charts_of(const Comparison& c, RunSamples& samples) {
  Json out = Json::array();
  for (const Plot& first : c.runs.front().charts) {
    Json chart, curves = Json::array();
    for (std::size_t i = 0; i < c.runs.size(); ++i)
      for (const Plot& own : c.runs[i].charts) {
        if (own.title != first.title) continue;
        Columns columns = samples.columns(i);
        chart = charts_json({own}, columns)[0];
        for (Json& curve : chart["curves"]) {
          curve["run"] = i;
          curves.push_back(std::move(curve));
        }
      }
    chart["curves"] = std::move(curves);
    out.push_back(std::move(chart));
  }
  return out;
}

// Returns the topic of the foot's position: the true one if all runs have it, else the measured
// one.
std::string foot_of(const Comparison& c) {
  std::string found;
  for (const std::string topic : {"/true/foot/position", "/foot/position"})
    for (const ChannelRow& row : c.channels) {
      if (row.channel.topic != topic) continue;
      const auto known = std::ranges::count_if(row.differences, [](const auto& d) { return !!d; });
      if (known + 1 == std::ssize(c.runs)) return topic;
      if (found.empty()) found = topic;
    }
  return found;
}

}  // namespace

std::string to_json(const Comparison& comparison) { return tables_of(comparison).text(2) + "\n"; }

Content content(const Comparison& comparison) {
  Json out = tables_of(comparison);
  std::string title = "Compare";
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const ComparedRun& run = comparison.runs[i];
    out["runs"][i]["phases"] = run.phases;
    out["runs"][i]["atmosphere"] = run.atmosphere;
    title += (i > 0 ? " · " : " ") + run.label;
  }
  RunSamples samples(comparison);
  out["panels"] = panels_of(comparison, samples);
  out["charts"] = charts_of(comparison, samples);
  out["foot"] = foot_of(comparison);
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    Columns columns = samples.columns(i);
    const ComparedRun& run = comparison.runs[i];
    out["runs"][i]["scene"] = to_json(run.scene, columns);
    out["runs"][i]["stand"] = to_json(run.stand, columns);
  }
  out["samples"] = to_json(samples.blob().layout());
  return {title, out.text(), samples.blob().base64()};
}

std::string page(const Comparison& comparison, const units::ShownUnits& units) {
  require_page("compare.html");
  Content filled = content(comparison);
  filled.units = units_json(units);
  return fill(comparison_template(), filled);
}

}  // namespace sinew::report
