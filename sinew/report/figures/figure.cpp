#include "sinew/report/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "sinew/units/quantity.h"

namespace sinew::report {
namespace {

std::string heading_of(const std::string& name, const std::string& unit) {
  return fmt::format("{} [{}]", name, unit.empty() ? "-" : unit);
}

// Returns a heading that no other column of the sheet has.
std::string free_heading(const Sheet& sheet, const std::string& name, const std::string& unit) {
  std::string heading = heading_of(name, unit);
  for (int n = 2; std::ranges::find(sheet.headings, heading) != sheet.headings.end(); ++n)
    heading = heading_of(fmt::format("{} {}", name, n), unit);
  return heading;
}

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string out;
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\r' || c == '\n' ? ' ' : c;
  }
  return fmt::format("\"{}\"", out);
}

void check_name(const Figure& figure) {
  const std::string name = file_name_of(figure.name);
  if (name != figure.name)
    throw std::invalid_argument(fmt::format(
        "figure \"{}\": expected a name of a to z, 0 to 9 and -; try \"{}\"", figure.name, name));
}

void check(const Figure& figure, const Curve& curve) {
  if (curve.xs.size() != curve.ys.size())
    throw std::invalid_argument(
        fmt::format("figure {}: {}: found {} x and {} y; expected as many of both", figure.name,
                    curve.label, curve.xs.size(), curve.ys.size()));
}

// Returns whether values are identical: NaN equals NaN, and 0 is not -0.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double p, double q) {
    return p == q ? std::signbit(p) == std::signbit(q) : std::isnan(p) && std::isnan(q);
  });
}

class Layout {
 public:
  explicit Layout(const Figure& figure) : figure_(figure) {
    check_name(figure);
    for (const Plot& plot : figure.plots) lay_out(plot);
  }
  FigureData out;

 private:
  void lay_out(const Plot& plot) {
    const std::size_t first = out.sheets.size();
    std::vector<std::string> named_after;  // first curve of each sheet of this plot
    out.places.emplace_back();
    for (const Curve& curve : plot.curves) {
      check(figure_, curve);
      std::size_t at = first;
      while (at < out.sheets.size() && !same(out.sheets[at].columns[0], curve.xs)) ++at;
      if (at == out.sheets.size()) {
        out.sheets.push_back({"", {heading_of(plot.x.name, plot.x.unit)}, {curve.xs}});
        named_after.push_back(curve.label);
      }
      Sheet& sheet = out.sheets[at];
      const std::string& name = curve.label.empty() ? plot.y.name : curve.label;
      sheet.headings.push_back(free_heading(sheet, name, plot.y.unit));
      sheet.columns.push_back(curve.ys);
      out.places.back().push_back({at, sheet.columns.size() - 1});
    }
    const bool several = out.sheets.size() - first > 1;
    for (std::size_t i = first; i < out.sheets.size(); ++i)
      out.sheets[i].name = free_name(plot, several ? named_after[i - first] : "", i);
  }

  std::string free_name(const Plot& plot, const std::string& curve, std::size_t before) const {
    std::string name = figure_.name;
    if (figure_.plots.size() > 1)
      name += fmt::format("-{}", file_name_of(plot.name.empty() ? plot.y.name : plot.name));
    if (!curve.empty()) name += fmt::format("-{}", file_name_of(curve));
    const auto taken = [&](const std::string& candidate) {
      return std::any_of(out.sheets.begin(), out.sheets.begin() + static_cast<long>(before),
                         [&](const Sheet& s) { return s.name == candidate; });
    };
    std::string candidate = name;
    for (int n = 2; taken(candidate); ++n) candidate = fmt::format("{}-{}", name, n);
    return candidate;
  }

  const Figure& figure_;
};

}  // namespace

std::string Axis::title() const {
  return unit.empty() || unit == "-" ? name : heading_of(name, unit);
}

FigureData data(const Figure& figure) { return std::move(Layout(figure).out); }

std::string csv(const Sheet& sheet) {
  std::string out;
  for (const std::string& heading : sheet.headings) {
    if (!out.empty()) out += ',';
    out += cell(heading);
  }
  out += '\n';
  for (std::size_t row = 0; row < sheet.columns[0].size(); ++row) {
    for (std::size_t c = 0; c < sheet.columns.size(); ++c) {
      if (c > 0) out += ',';
      const double value = sheet.columns[c][row];
      out += std::isnan(value) ? "NaN" : units::format_number(value);
    }
    out += '\n';
  }
  return out;
}

std::string_view to_text(Curve::Kind kind) {
  constexpr std::string_view names[] = {"computed", "measured", "desired", "synthetic"};
  return names[static_cast<std::size_t>(kind)];
}

Curve once(const Curve& path) {
  Curve out = path;
  out.xs.clear();
  out.ys.clear();
  const auto add = [&](double x, double y) {
    out.xs.push_back(x);
    out.ys.push_back(y);
  };
  std::set<std::pair<double, double>> been;
  bool left_out = false;
  for (std::size_t i = 0; i < path.xs.size(); ++i) {
    const double x = path.xs[i], y = path.ys[i];
    const bool number = !std::isnan(x) && !std::isnan(y);
    if (number && !been.insert({x, y}).second) {
      left_out = true;
      continue;
    }
    if (left_out && number) {
      add(x, std::nan(""));
      add(path.xs[i - 1], path.ys[i - 1]);  // start of the new part on the old one
    }
    left_out = false;
    add(x, y);
  }
  return out;
}

std::string file_name_of(std::string_view text) {
  std::string out;
  bool space = false;  // between two words
  for (const char c : text) {
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if ((lower < 'a' || lower > 'z') && (lower < '0' || lower > '9')) {
      space = !out.empty();
      continue;
    }
    if (space) out += '-';
    space = false;
    out += lower;
  }
  if (out.empty()) return "figure";
  return out;
}

}  // namespace sinew::report
