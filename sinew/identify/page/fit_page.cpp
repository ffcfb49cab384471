#include "sinew/identify/page/fit_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "sinew/config/compose.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/json/json.h"
#include "sinew/report/page/fit_page.h"

namespace sinew::identify {

namespace {

using report::Curve;
using report::Plot;

// Largest number of rows on a page; more only make it slow.
constexpr std::size_t most_rows = 20000;
// Largest number of points of a hidden model, and smallest number for each of its lines.
constexpr std::size_t most_of_other = 1200, least_of_line = 40;
constexpr int triangle = 1;  // index of the page's mark

// Dash patterns that are distinct without color; further laws repeat them with a longer first dash.
const std::vector<double> dashes[] = {
    {7, 3},   {2, 2},        {8, 3, 2, 3}, {13, 4},       {4, 5},       {9, 3, 2, 3, 2, 3},
    {1.5, 4}, {13, 3, 4, 3}, {5, 2, 5, 6}, {16, 3, 1, 3}, {3, 3, 1, 3}, {6, 6}};

std::vector<double> dash_of(std::size_t law) {
  std::vector<double> out = dashes[law % std::size(dashes)];
  out[0] += 6 * static_cast<double>(law / std::size(dashes));
  return out;
}

// Rows of one curve, with ascending x.
using Group = std::vector<std::size_t>;

// Returns the groups by rank, else in the order of their first rows; held-out rows are separate.
std::vector<std::pair<std::string, Group>> groups_of(const Rows& rows, bool held_out) {
  std::vector<std::pair<std::string, Group>> out;
  std::map<std::string, std::size_t> place;
  const std::size_t stride = 1 + rows.size() / most_rows;
  std::vector<std::size_t> in_order;
  for (std::size_t i = 0; i < rows.size(); i += stride) in_order.push_back(i);
  if (!rows.order.empty())
    std::ranges::stable_sort(in_order, {}, [&](std::size_t i) { return rows.order[i]; });
  for (const std::size_t i : in_order) {
    if ((!rows.held_out.empty() && rows.held_out[i]) != held_out) continue;
    const std::string name = rows.group.empty() ? "" : rows.group[i];
    const auto [at, is_new] = place.try_emplace(name, out.size());
    if (is_new) out.push_back({name, {}});
    out[at->second].second.push_back(i);
  }
  for (auto& [name, group] : out)
    std::ranges::stable_sort(group, {}, [&](std::size_t i) { return rows.at[i]; });
  return out;
}

template <class Value>
std::vector<double> pick(const Group& group, Value value) {
  std::vector<double> out;
  for (const std::size_t i : group) out.push_back(value(i));
  return out;
}

// Builds all curves of both charts: measured points, the model's line with its bands, residuals,
// omitted points, and the lines of other models.
class Maker {
 public:
  explicit Maker(const Report& report) : report_(report), rows_(report.rows) {
    const std::string unit = rows_.unit.empty() ? report.unit : rows_.unit;
    const report::Axis x{rows_.x, rows_.x_unit};
    fit_ = {.title = "Measured and by the model", .x = x, .y = {report.quantity, unit}, .note = ""};
    left_ = {
        .title = "Model less measured", .x = x, .y = {report.quantity, report.unit}, .note = ""};
    if (unit == "Pa abs" || unit == "Pa gauge") left_.y.unit = "Pa diff";
  }

  std::vector<Plot> make() {
    give_colors();
    for (const bool held_out : {false, true}) {
      const auto groups = groups_of(rows_, held_out);
      for (std::size_t k = 0; k < groups.size(); ++k)
        add(groups[k].first, groups[k].second, held_out);
    }
    if (rows_.scattered) return {against_measured(), left_};
    const std::size_t stride = 1 + rows_.size() / most_rows;
    if (stride > 1) fit_.note = fmt::format("One row of {} is shown.", stride);
    if (colors_.size() == 1)
      for (Curve& c : fit_.curves)
        if (c.style == Curve::Style::line) c.color = 1;
    add_left_out();
    add_other_models();
    return {fit_, left_};
  }

 private:
  // Gives each group one color, for fitted and held-out rows; ranks make it a color scale.
  void give_colors() {
    Rows all = rows_;
    all.held_out.clear();
    for (const auto& [name, group] : groups_of(all, false))
      colors_.try_emplace(name, static_cast<int>(colors_.size()));
  }

  double measured(std::size_t i) const { return rows_.measured[i]; }
  bool told(const Fit& fit) const { return fit.residuals.size() == rows_.size(); }

  void add(const std::string& name, const Group& group, bool held_out) {
    const Fit& best = report_.best();
    const int color = colors_.at(name);
    const auto x = pick(group, [&](std::size_t i) { return rows_.at[i]; });
    const auto style = held_out ? Curve::Style::held_out : Curve::Style::points;
    const std::string label = held_out ? "held out" : name.empty() ? "measured" : name;
    const int mark = !rows_.venting.empty() && rows_.venting[group.front()] ? triangle : 0;
    fit_.curves.push_back({.label = label,
                           .xs = x,
                           .ys = pick(group, [&](std::size_t i) { return measured(i); }),
                           .style = style,
                           .color = color,
                           .mark = mark});
    if (!told(best)) return;
    add_line(name, color, {.xs = x, .ys = pick(group, [&](std::size_t i) {
                                      return measured(i) + best.residuals[i];
                                    })});
    left_.curves.push_back({.label = label,
                            .xs = x,
                            .ys = pick(group, [&](std::size_t i) { return best.residuals[i]; }),
                            .style = style,
                            .color = color,
                            .mark = mark});
  }

  // Adds the chosen model's line for each group: along its curve with bands if the report has one,
  // else through the rows.
  void add_line(const std::string& name, int color, Curve rows) {
    rows.label = report_.best().model;
    rows.color = color;
    rows.bold = true;
    const auto curve = std::ranges::find(report_.curves, name, &PredictedCurve::group);
    if (curve == report_.curves.end()) {
      add_even_bands(rows);
      fit_.curves.push_back(std::move(rows));
      return;
    }
    if (!drawn_.insert(name).second) return;
    rows.xs = curve->at;
    rows.ys = curve->value;
    add_band("95 % band", *curve, curve->half_95);
    add_band("68 % band", *curve, curve->half_68);
    fit_.curves.push_back(std::move(rows));
  }

  // Adds constant bands about the rows by the model, if it has them. Of many rows the lowest and
  // highest of each stretch are enough to keep every extreme of the model within its band.
  void add_even_bands(const Curve& rows) {
    const auto& band = report_.best().band;
    if (!band || rows_.scattered) return;
    PredictedCurve some;
    const std::size_t stride = 1 + 2 * rows.xs.size() / most_of_other;
    for (std::size_t i = 0; i < rows.ys.size(); i += stride) {
      const auto from = rows.ys.begin() + static_cast<std::ptrdiff_t>(i);
      const auto to =
          rows.ys.begin() + static_cast<std::ptrdiff_t>(std::min(i + stride, rows.ys.size()));
      const auto [low, high] = std::minmax_element(from, to);
      std::set<std::size_t> places{static_cast<std::size_t>(low - rows.ys.begin()),
                                   static_cast<std::size_t>(high - rows.ys.begin())};
      if (i == 0) places.insert(0);
      if (to == rows.ys.end()) places.insert(rows.ys.size() - 1);
      for (const std::size_t place : places) {
        some.at.push_back(rows.xs[place]);
        some.value.push_back(rows.ys[place]);
      }
    }
    add_band("95 % band", some, std::vector<double>(some.at.size(), band->half_95));
    add_band("68 % band", some, std::vector<double>(some.at.size(), band->half_68));
  }

  void add_band(const std::string& label, const PredictedCurve& curve,
                const std::vector<double>& half) {
    Curve about{.label = label, .xs = curve.at, .style = Curve::Style::band, .color = 6};
    Curve apart = about;
    for (std::size_t i = 0; i < half.size(); ++i) {
      about.ys.push_back(curve.value[i] - half[i]);
      about.ys_high.push_back(curve.value[i] + half[i]);
      apart.ys.push_back(-half[i]);
      apart.ys_high.push_back(half[i]);
    }
    fit_.curves.push_back(std::move(about));
    left_.curves.push_back(std::move(apart));
  }

  // Adds the omitted points, with a different mark for each reason.
  void add_left_out() {
    int mark = 0;
    for (const Omitted& omitted : report_.left_out) {
      Curve curve{.label = "left out: " + omitted.reason,
                  .style = Curve::Style::left_out,
                  .color = 6,
                  .mark = mark++};
      for (const OmittedRow& row : omitted.rows) {
        curve.xs.push_back(row.at);
        curve.ys.push_back(row.measured);
      }
      fit_.curves.push_back(std::move(curve));
    }
  }

  // Returns the chart of predicted over measured values; perfect predictions are on the diagonal.
  Plot against_measured() const {
    Plot out = fit_;
    out.title = "By the model against measured";
    out.x = {report_.quantity + ", measured", out.y.unit};
    out.y.name += ", by the model";
    std::erase_if(out.curves, [](const Curve& c) { return c.style != Curve::Style::line; });
    for (std::size_t k = 0; k < out.curves.size(); ++k) {  // each line follows its points
      Curve& c = out.curves[k];
      const Curve& points = fit_.curves[2 * k];
      c = {.label = points.label,
           .xs = points.ys,
           .ys = c.ys,
           .style = points.style,
           .color = points.color};
    }
    const auto [least, most] = std::ranges::minmax(rows_.measured);
    out.curves.push_back(
        {.label = "as measured", .xs = {least, most}, .ys = {least, most}, .color = 6});
    return out;
  }

  // Adds the other models, hidden at first: usually only one of them is compared.
  void add_other_models() {
    std::size_t law = 0;
    const std::size_t most = std::max(least_of_line, most_of_other / colors_.size());
    for (std::size_t k = 0; k < report_.fits.size(); ++k) {
      const Fit& other = report_.fits[k];
      if (k == report_.chosen || !told(other)) continue;
      for (const auto& [name, group] : groups_of(rows_, false)) {
        Group some;
        const std::size_t stride = 1 + group.size() / most;
        for (std::size_t i = 0; i < group.size(); i += stride) some.push_back(group[i]);
        if (!some.empty() && some.back() != group.back()) some.push_back(group.back());
        Curve curve{.label = other.model,
                    .style = Curve::Style::other,
                    .color = static_cast<int>(law),
                    .strokes = dash_of(law),
                    .hidden = true};
        curve.xs = pick(some, [&](std::size_t i) { return rows_.at[i]; });
        curve.ys = pick(some, [&](std::size_t i) { return measured(i) + other.residuals[i]; });
        fit_.curves.push_back(std::move(curve));
      }
      ++law;
    }
  }

  const Report& report_;
  const Rows& rows_;
  Plot fit_, left_;
  std::map<std::string, int> colors_;
  std::set<std::string> drawn_;  // groups with a curve
};

}  // namespace

std::vector<Plot> charts_of(const Report& report) {
  return report.rows.size() == 0 ? std::vector<Plot>{} : Maker(report).make();
}

std::string page(const Page& page) {
  report::FitPage fit{.title = page.title, .version = page.version, .data = page.data};
  fit.atmosphere = page.atmosphere;
  for (const Report& r : page.reports)
    fit.parts.push_back({.report = to_json(r).text(), .charts = charts_of(r)});
  if (!page.parameter_file.empty())
    fit.values = report::parameters(config::parse_text(page.parameter_file, "the parameter file"));
  return report::page(fit);
}

}  // namespace sinew::identify
