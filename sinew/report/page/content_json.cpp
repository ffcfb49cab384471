#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/json/json.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/fit_page.h"
#include "sinew/report/page/parameters.h"

namespace sinew::report {
namespace {

using robot::Point;

// Returns the index of a channel's column, by default for a pose, or null.
Json column_of(const Channel& channel, Columns& columns, Blob::As as = Blob::As::pose) {
  const int column = columns.of(channel, as);
  return column == Columns::none ? Json() : Json(column);
}

Json point(Point p) { return Json::array({p.x, p.y}); }

// Returns the style of a line over time.
std::string_view style_over_time(const Curve& c) {
  return c.hidden ? "hidden" : c.kind == Curve::Kind::desired ? "dashed" : "full";
}

std::string_view word(Curve::Style style) {
  using enum Curve::Style;
  return style == points     ? "points"
         : style == held_out ? "held out"
         : style == left_out ? "left out"
         : style == other    ? "other line"
         : style == band     ? "band"
                             : "line";
}

std::string_view word(Stand::Load load) {
  using enum Stand::Load;
  return load == hanging ? "hanging" : load == driven ? "driven" : "clamped";
}

std::string_view word(Stand::Air air) {
  using enum Stand::Air;
  return air == sealed      ? "sealed"
         : air == regulated ? "regulated"
         : air == valves    ? "valves"
                            : "3-way";
}

Json json_of(const Axis& axis) { return {{"label", axis.name}, {"unit", axis.unit}}; }

// Returns numbers with the digits that a picture can show, or the index of a channel's column.
Json numbers_of(const std::vector<double>& numbers, const Channel& channel, Columns& columns) {
  if (!channel.is_empty()) return column_of(channel, columns);
  return Json::array(numbers, [](double x) {
    return std::isfinite(x) ? Json::parse(fmt::format("{:.7g}", x)) : Json();
  });
}

Json curve_of(const Curve& c, Columns& columns) {
  Json out = {{"label", c.label}, {"style", word(c.style)}, {"color", std::max(c.color, 0)}};
  out["x"] = numbers_of(c.xs, c.x_channel, columns);
  out["y"] = numbers_of(c.ys, c.y_channel, columns);
  if (!c.ys_high.empty()) out["y_high"] = numbers_of(c.ys_high, {}, columns);
  if (!c.strokes.empty()) out["dash"] = c.strokes;
  if (c.mark != 0) out["mark"] = c.mark;
  if (c.bold) out["bold"] = true;
  if (c.hidden) out["hidden"] = true;
  return out;
}

Json frames_of(const Scene& scene, Columns& columns) {
  return Json::array(scene.frames, [&](const Frame& f) -> Json {
    return {{"name", f.name},
            {"x", column_of(f.x, columns)},
            {"y", column_of(f.y, columns)},
            {"heading", column_of(f.heading, columns)}};
  });
}

Json shapes_of(const Scene& scene) {
  Json out;
  out["links"] = Json::array(scene.links, [](const LinkShape& l) -> Json {
    return {{"frame", l.frame}, {"length", l.length}};
  });
  out["cams"] = Json::array(scene.cams, [](const CamShape& c) -> Json {
    return {{"frame", c.frame}, {"outline", Json::array(c.outline, point)}};
  });
  out["tendons"] = Json::array(scene.tendons, [](const TendonShape& c) -> Json {
    return {{"frame", c.frame}, {"from", point(c.from)}, {"to", point(c.to)}};
  });
  out["discs"] = Json::array(scene.discs, [](const Disc& d) -> Json {
    return {{"frame", d.frame}, {"center", point(d.center)}, {"radius", d.radius}};
  });
  return out;
}

Json muscles_of(const Scene& scene, Columns& columns) {
  return Json::array(scene.muscles, [&](const MuscleShape& m) -> Json {
    return {{"name", m.name},
            {"frame", m.frame},
            {"anchor", point(m.anchor)},
            {"direction", point(m.direction)},
            {"touch", point(m.touch)},
            {"count", m.count},
            {"longest", m.longest},
            {"length", column_of(m.length, columns)},
            {"diameter", column_of(m.diameter, columns)},
            {"pressure", column_of(m.pressure, columns)},
            {"inlet", column_of(m.inlet, columns)},
            {"exhaust", column_of(m.exhaust, columns)}};
  });
}

Json cylinder_of(const CylinderShape& c, Columns& columns) {
  const auto column = [&](const Channel& channel) { return column_of(channel, columns); };
  return {{"bore", c.bore},
          {"stroke", c.stroke},
          {"up", column(c.up)},
          {"down", column(c.down)},
          {"valves_up", Json::array(c.valves_up, column)},
          {"valves_down", Json::array(c.valves_down, column)}};
}

// Returns the columns of both components; null for no channel.
Json vector_of(const Channel& x, Columns& columns) {
  if (x.is_empty()) return {};
  return Json::array({column_of(x, columns), column_of({x.topic, "y"}, columns)});
}

}  // namespace

Json panels_json(const std::vector<Plot>& panels, Columns& columns) {
  const auto line_of = [&](const Curve& c) {
    Json line = {{"label", c.label},
                 {"topic", c.y_channel.topic},
                 {"column", column_of(c.y_channel, columns, Blob::As::line)},
                 {"color", c.color},
                 {"style", style_over_time(c)}};
    if (c.y_channel.field != "value") line["field"] = c.y_channel.field;
    return line;
  };
  return Json::array(panels, [&](const Plot& p) -> Json {
    return {{"group", p.group},
            {"title", p.title},
            {"unit", p.y.unit},
            {"lines", Json::array(p.curves, line_of)}};
  });
}

Json to_json(const Scene& scene, Columns& columns) {
  if (scene.empty()) return {};
  Json out = shapes_of(scene);
  out["frames"] = frames_of(scene, columns);
  out["muscles"] = muscles_of(scene, columns);
  out["drawn_from"] = scene.drawn_from;
  if (scene.surface) out["surface"] = *scene.surface;
  if (scene.track) {
    const Track& t = *scene.track;
    out["track"] = {{"height", t.height}, {"from", t.from},   {"to", t.to},
                    {"rear", t.rear},     {"front", t.front}, {"rollers", t.rollers}};
  }
  if (scene.cylinder) out["cylinder"] = cylinder_of(*scene.cylinder, columns);
  out["feet"] = Json::array(scene.feet, [&](const FootShape& foot) -> Json {
    return {{"at", foot.at},
            {"path", vector_of(foot.path, columns)},
            {"desired", vector_of(foot.desired_path, columns)},
            {"force", vector_of(foot.force, columns)},
            {"contact", column_of(foot.contact, columns)}};
  });
  return out;
}

Json to_json(const Stand& stand, Columns& columns) {
  if (stand.empty()) return {};
  return {{"element", stand.element},
          {"count", stand.count},
          {"turns", stand.turns},
          {"bore", stand.bore},
          {"rod", stand.rod},
          {"stroke", stand.stroke},
          {"load", word(stand.load)},
          {"air", word(stand.air)},
          {"shortest", stand.shortest},
          {"longest", stand.longest},
          {"least", stand.least},
          {"most", stand.most},
          {"heaviest", stand.heaviest},
          {"weight_step", stand.weight_step},
          {"length", column_of(stand.length, columns)},
          {"diameter", column_of(stand.diameter, columns)},
          {"pressure", column_of(stand.pressure, columns)},
          {"desired", column_of(stand.desired, columns)},
          {"tension", column_of(stand.tension, columns)},
          {"weight", column_of(stand.weight, columns)},
          {"inlet", column_of(stand.inlet, columns)},
          {"exhaust", column_of(stand.exhaust, columns)},
          {"drawn_from", stand.drawn_from}};
}

Json charts_json(const std::vector<Plot>& charts, Columns& columns) {
  const auto curve = [&](const Curve& c) { return curve_of(c, columns); };
  return Json::array(charts, [&](const Plot& c) -> Json {
    return {{"title", c.title},
            {"x", json_of(c.x)},
            {"y", json_of(c.y)},
            {"curves", Json::array(c.curves, curve)},
            {"note", c.note}};
  });
}

Json to_json(const std::vector<Parameter>& parameters) {
  return Json::array(parameters, [](const Parameter& p) {
    return Json::array({p.key, p.value, p.mark, p.range, p.uncertainty, p.source});
  });
}

namespace {

// Joins spans that are too close to be distinguished on a screen.
std::vector<analysis::Span> shown(const std::vector<analysis::Span>& spans) {
  constexpr std::size_t most = 2000;
  if (spans.size() <= most) return spans;
  const double apart = (spans.back().to - spans.front().from) / static_cast<double>(most);
  std::vector<analysis::Span> out{spans.front()};
  for (const analysis::Span& s : spans)
    if (s.from - out.back().to > apart)
      out.push_back(s);
    else
      out.back().to = s.to;
  return out;
}

}  // namespace

Json to_json(const std::vector<analysis::Warning>& warnings) {
  const auto span = [](const analysis::Span& s) { return Json::array({s.from, s.to}); };
  return Json::array(warnings, [&](const analysis::Warning& w) -> Json {
    return {{"text", w.text}, {"spans", Json::array(shown(w.spans), span)}};
  });
}

Json to_json(const std::vector<analysis::MachineFault>& faults, double end) {
  return Json::array(faults, [&](const analysis::MachineFault& f) -> Json {
    return {{"of", f.of}, {"what", f.what}, {"from", f.begin}, {"to", std::fmin(f.end, end)}};
  });
}

Json to_json(const std::vector<analysis::Verdict>& verdicts) {
  return Json::array(verdicts, [](const analysis::Verdict& v) -> Json {
    return {{"key", v.key},
            {"reported", v.reported},
            {"ours", v.computed},
            {"accept", v.accept},
            {"source", v.source},
            {"class", to_text(v.statement_class)},
            {"wording", to_text(v.wording)},
            {"is", analysis::to_text(v.agreement)}};
  });
}

Json to_json(const std::vector<PageChange>& changes) {
  return Json::array(changes, [](const PageChange& c) {
    Json out = {{"time", c.time}, {"key", c.key}};
    out["value"] = c.release ? Json() : Json(c.value);
    if (!c.release) out["unit"] = c.unit;
    if (!c.leg.empty()) out["leg"] = c.leg;
    return out;
  });
}

Json to_json(const Blob::Layout& layout) {
  return {{"clocks", layout.clocks}, {"columns", layout.columns}};
}

Json phases_of(const analysis::Record& record, const analysis::Machine& machine) {
  Json stretches = Json::array();
  const bool all = record.phase_spans().size() <= most_stretches;
  for (std::size_t i = 0; all && i < record.phase_spans().size(); ++i) {
    const analysis::PhaseSpan s = record.phase_spans()[i];
    stretches.push_back({{"phase", s.phase},
                         {"step", s.step},
                         {"from", record.time(s.first)},
                         {"to", record.end_of(s.last - 1)},
                         {"stance", analysis::is_stance(machine, s.phase)}});
  }
  return {{"names", machine.phases}, {"stretches", std::move(stretches)}};
}

Json to_json(const FitPage& fit, Columns& columns) {
  Json out = {{"format", "sinew.fit/1"}, {"title", fit.title}, {"version", fit.version}};
  out["data"] = fit.data;
  out["atmosphere"] = fit.atmosphere;
  out["parts"] = Json::array(fit.parts, [&](const FitPart& part) -> Json {
    return {{"report", Json::parse(part.report)}, {"charts", charts_json(part.charts, columns)}};
  });
  out["parameters"] = to_json(fit.values);
  return out;
}

// --- units ---

namespace {

Json json_of(const units::ShownUnit& unit) {
  Json out = {{"label", unit.label()}, {"scale", unit.scale}};
  if (unit.gauge)
    out["gauge"] = true;
  else if (unit.offset != 0)
    out["offset"] = unit.offset;
  return out;
}

Json json_of(std::string_view name, std::string_view title, const units::ShownUnits& units) {
  Json out = {{"name", name}, {"title", title}, {"about", units.text()}, {"units", Json::object()}};
  std::string about;
  for (const units::ShownEntry& entry : units::shown_entries(units)) {
    Json one = json_of(entry.shown[entry.usual]);
    if (entry.usual + 1 < entry.shown.size()) one["large"] = json_of(entry.shown[entry.usual + 1]);
    for (const std::string_view told : {"length", "force", "pressure", "angle", "time"})
      if (entry.quantity == told && entry.unit.find(' ') == entry.unit.npos)
        about += (about.empty() ? "" : ", ") + entry.shown[entry.usual].name;
    out["units"][std::string(entry.unit)] = std::move(one);
  }
  out["about"] = about;
  return out;
}

}  // namespace

std::string units_json(const units::ShownUnits& start) {
  Json sets = Json::array();
  sets.push_back(json_of("si", "SI", units::UnitSet::si));
  sets.push_back(json_of("thesis", "in · lbf · psi", units::UnitSet::thesis));
  sets.push_back(json_of("metric", "mm · N · bar", units::UnitSet::metric));
  if (start.has_choices()) sets.push_back(json_of("own", "own", start));
  const std::string_view name = start.has_choices() ? "own" : units::to_text(start.set());
  return Json{{"start", name}, {"sets", std::move(sets)}}.text();
}

std::string units_json() { return units_json(config::units_to_show({}).units); }

}  // namespace sinew::report
