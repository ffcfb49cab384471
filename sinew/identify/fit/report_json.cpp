#include "sinew/identify/fit/report_json.h"

#include <cmath>

#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

Json to_json(const Score& score) {
  Json out{{"points", score.points},
           {"rmse", score.rmse},
           {"max", score.max},
           {"rmse_percent", score.rmse_percent},
           {"max_percent", score.max_percent}};
  if (std::isfinite(score.explained)) out["r_squared"] = score.explained;
  return out;
}

Json to_json(const Estimate& e) {
  Json out{{"name", e.name}, {"unit", e.unit}, {"value", e.value}};
  out["low"] = e.at_bound ? Json() : finite_or_null(e.low);
  out["high"] = e.at_bound ? Json() : finite_or_null(e.high);
  out["identifiable"] = e.identifiable;
  if (e.at_bound) out["at_bound"] = true;
  if (!e.known.empty()) out["known"] = e.known;
  return out;
}

Json to_json(const Fit& fit) {
  Json out{{"model", fit.model}, {"law", fit.law}, {"source", fit.source}};
  if (!fit.refused.empty()) {
    out["refused"] = fit.refused;
    return out;
  }
  out["parameters"] = Json::array();
  for (const Estimate& e : fit.parameters) out["parameters"].push_back(to_json(e));
  out["fit"] = to_json(fit.fit);
  if (fit.held_out) out["held_out"] = to_json(*fit.held_out);
  if (fit.cross_validated) out["cross_validated"] = to_json(*fit.cross_validated);
  if (fit.extrapolated) out["extrapolated"] = to_json(*fit.extrapolated);
  if (fit.band) {
    out["band"] = {{"half_68", fit.band->half_68}, {"half_95", fit.band->half_95}};
    if (!fit.band->where.empty()) out["band"]["where"] = fit.band->where;
  }
  if (!fit.not_chosen.empty()) out["not_chosen"] = fit.not_chosen;
  if (!fit.notes.empty()) out["notes"] = fit.notes;
  return out;
}

// A part by its name, or by its value in the unit that stands above.
Json to_json(const ErrorBy& by) {
  Json out{{"by", by.what}};
  if (!by.unit.empty()) out["unit"] = by.unit;
  out["parts"] = Json::array();
  for (const PartError& part : by.parts) {
    Json one = part.name.empty() ? Json{{"value", part.value}} : Json{{"name", part.name}};
    one.update(to_json(part.score));
    out["parts"].push_back(std::move(one));
  }
  return out;
}

// Rows that have an explanation of their own; the others are but counted.
Json to_json(const Omitted& omitted, const Report& report) {
  Json out{{"reason", omitted.reason},
           {"told_by", omitted.told_by},
           {"count", omitted.count},
           {"shown", omitted.rows.size()}};
  for (const OmittedRow& row : omitted.rows)
    if (!row.why.empty())
      out["rows"].push_back({{report.rows.x, row.at},
                             {report.quantity, row.measured},
                             {"group", row.group},
                             {"why", row.why}});
  return out;
}

Json error_of(double rms, double half) {
  return {{"rms_percent", rms}, {"half_width_95_percent", half}};
}

Json to_json(const Further& further) {
  Json out = Json::object();
  if (!further.of.empty()) out["of"] = further.of;
  out["readings"] = further.readings;
  out["before"] = error_of(further.rms, further.half);
  out["mounts"] = Json::array();
  for (const FurtherMount& m : further.mounts)
    out["mounts"].push_back({{"length_m", m.length},
                             {"gauge_pressures_Pa", m.pressures},
                             {"readings", m.readings},
                             {"time_s", m.time},
                             {"after", error_of(m.rms, m.half)}});
  out["note"] = further.note;
  return out;
}

// Adds what there is beside the models; a key that does not apply is absent.
void add_evidence(const Report& report, Json& out) {
  for (const ErrorBy& by : report.errors) out["errors"].push_back(to_json(by));
  for (const Omitted& omitted : report.left_out)
    out["left_out"].push_back(to_json(omitted, report));
  for (const Further& further : report.further) out["further"].push_back(to_json(further));
}

}  // namespace

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json to_json(const Report& report) {
  Json out{{"format", "sinew.identification/1"}, {"subject", report.subject}};
  out["quantity"] = report.quantity;
  out["unit"] = report.unit;
  out["full_scale"] = report.full_scale;
  out["full_scale_is"] = report.full_scale_is;
  if (!report.held_out_is.empty()) out["held_out_is"] = report.held_out_is;
  out["chosen"] = report.best().model;
  out["rule"] = report.rule;
  out["models"] = Json::array();
  for (const Fit& fit : report.fits) out["models"].push_back(to_json(fit));
  add_evidence(report, out);
  out["notes"] = report.notes;
  out["warnings"] = report.warnings;

  // The chosen one once more, where a program looks first.
  const Json best = to_json(report.best());
  for (const char* key :
       {"model", "parameters", "fit", "held_out", "cross_validated", "extrapolated", "band"})
    if (best.contains(key)) out[key] = best[key];
  return out;
}

}  // namespace sinew::identify
