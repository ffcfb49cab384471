#include "sinew/report/compare/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include "sinew/report/text/text_table.h"

namespace sinew::report {

namespace {

using Align = TextTable::Align;
using units::ShownUnit;
using units::ShownUnits;

// Appends formatted text.
template <class... Args>
void print(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

std::string letter_of(std::size_t run) { return {static_cast<char>('A' + run)}; }

constexpr std::size_t most_figures = 12, most_parameters = 15, most_channels = 12;
constexpr std::size_t most_letters = 32;  // longest shown value of a parameter

bool is_share(std::string_view key) {
  return key.find("share") != key.npos || key.find("passiveness") != key.npos ||
         key.find("duty") != key.npos;
}

std::string signed_text(const std::string& text, double value) {
  return value > 0 ? "+" + text : text;
}

// Returns the number of digits: three, or all of those before the point.
int digits_of(double value) {
  const double size = std::abs(value);
  return size >= 1000 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 3;
}

std::string percent(const std::optional<double>& relative) {
  if (!relative) return "from 0";
  if (*relative == 0) return "=";
  const double p = 100 * *relative;
  return std::abs(p) >= 9.95 ? fmt::format("{:+.0f} %", p) : fmt::format("{:+.2g} %", p);
}

// Returns a number with its unit, which may be empty.
std::string with_unit(double number, int digits, const ShownUnit& unit) {
  return fmt::format("{:.{}g}{}{}", number, digits, unit.name.empty() ? "" : " ", unit.name);
}

// Returns the usual unit of a difference, or from 1000 of it on a larger one if it exists: 26.6 s
// instead of 26582 ms.
ShownUnit unit_of_difference(const ShownUnits& units, const std::string& unit, double si) {
  const ShownUnit usual = units.of_difference(unit);
  return std::abs(usual.of(si)) < 1000 ? usual : units.of_difference(unit, std::abs(si));
}

// Formats a figure's values and differences in the shown units.
class Figure {
 public:
  Figure(std::string_view key, const ShownUnits& units, double atmosphere)
      : unit_(unit_of(key)), units_(units), atmosphere_(atmosphere) {}

  std::string value(const std::optional<double>& si) const {
    return si ? units_.text(*si, unit_, 4, atmosphere_) : "-";
  }
  std::string difference(double first, double other) const {
    if (other == first) return "=";
    const double d = other - first;
    if (unit_ == "share") return signed_text(fmt::format("{:.3g} points", 100 * d), d);
    const ShownUnit shown = unit_of_difference(units_, unit_, d);
    return signed_text(with_unit(shown.of(d), digits_of(shown.of(d)), shown), d);
  }
  // Returns the relative difference. It is left out for gauge pressures, because it refers to the
  // absolute pressure.
  std::string relative(double first, double other) const {
    if (units_.of(unit_).gauge) return other == first ? "=" : "";
    return percent(analysis::relative_difference(first, other));
  }

 private:
  // Pressures of a summary are absolute; every set of units has a unit for these.
  static std::string unit_of(std::string_view key) {
    const std::string unit = analysis::unit_of_key(key);
    return unit == "1" && is_share(key) ? "share" : unit == "Pa abs" ? "Pa" : unit;
  }

  std::string unit_;
  const ShownUnits& units_;
  double atmosphere_;
};

// Returns a value with two digits of its uncertainty: "+2.5000 s ± 0.0030 s".
std::string with_uncertainty(double value, double uncertainty, std::string_view unit) {
  if (!std::isfinite(uncertainty)) return fmt::format("{:+.4g} {}", value, unit);
  const int digits =
      uncertainty > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(uncertainty))), 0, 9)
                      : 4;
  return fmt::format("{:+.{}f} {} ± {:.{}f} {}", value, digits, unit, uncertainty, digits, unit);
}

// Returns a clock's rate in words: "0.29 % ± 0.11 % faster", or slower.
std::string pace(double rate, double uncertainty) {
  const std::string words = with_uncertainty(100 * std::abs(rate), 100 * uncertainty, "%");
  return words.substr(1) + (rate < 0 ? " slower" : " faster");  // without its sign
}

// Alignment of a run with the first one, and the error of its clock that follows from it.
std::string alignment_text(const Comparison& c, std::size_t i, const std::string& fit_clock) {
  if (!c.runs[i].alignment) return "";
  const analysis::Alignment& a = *c.runs[i].alignment;
  const std::string channels = fmt::format("correlation of {}", fmt::join(a.channels, ", "));
  std::string by = a.event.empty() ? std::string(to_text(c.align)) : "event: " + a.event;
  if (c.align == report::Align::correlation)
    by = channels;
  else if (!a.channels.empty())
    by += ", its clock by " + channels;
  std::string out = fmt::format("\n{} is aligned with A by {}\n", letter_of(i), by);
  if (a.same) return out + "  both hold the same samples: nothing is moved\n";
  out += fmt::format("  its clock shows {} where A's shows 0\n",
                     with_uncertainty(a.clock.shift, a.shift_uncertainty, "s"));
  if (c.clocks_fitted)
    out += fmt::format("  its clock goes {}, by {} pieces of the motion\n",
                       pace(a.clock.rate, a.rate_uncertainty), a.pieces);
  if (a.rate_seen != 0)
    out += fmt::format("  its clock seems to go {}, which is not taken out: {} does\n",
                       pace(a.rate_seen, a.rate_seen_uncertainty), fit_clock);
  if (std::isfinite(a.correlation)) out += fmt::format("  correlation {:.4f}\n", a.correlation);
  return out;
}

void print_runs(const Comparison& c, const std::string& fit_clock, std::string& out) {
  TextTable table({"", "", "", "", ""}, {Align::left, Align::left, Align::left, Align::right});
  for (std::size_t i = 0; i < c.runs.size(); ++i) {
    const ComparedRun& run = c.runs[i];
    table.add({letter_of(i), run.label, run.title, fmt::format("{:.2f} s", run.last - run.first),
               run.shift != 0 ? fmt::format("moved by {:+.3f} s", -run.shift) : ""});
  }
  const std::string text = table.text();
  print(out, "{}", text.substr(text.find('\n') + 1));  // without titles
  for (std::size_t i = 1; i < c.runs.size(); ++i) out += alignment_text(c, i, fit_clock);
}

// --- figures ---

std::string red(const std::string& text) { return "\033[31m" + text + "\033[0m"; }

// Returns "agrees", or "agrees → differs" if the runs are judged differently; empty if no run is
// judged.
std::string verdicts_of(const Comparison& c, const std::string& key, bool color = false) {
  std::vector<std::string> words;
  std::set<std::string> judged;
  for (const ComparedRun& run : c.runs) {
    words.push_back(run.verdict_of(key));
    if (!words.back().empty()) judged.insert(words.back());
    if (words.back().empty()) words.back() = "not judged";
  }
  if (judged.empty()) return "";
  const bool alike = std::ranges::all_of(words, [&](const auto& w) { return w == words.front(); });
  const std::string text = alike ? words.front() : fmt::format("{}", fmt::join(words, " → "));
  return color && judged.size() > 1 ? red(text) : text;
}

// Returns whether runs differ in a figure; runs that lack it do not count.
bool differs(const analysis::FigureRow& row) {
  std::optional<double> first;
  for (const auto& value : row.values) {
    if (!value) continue;
    if (first && *value != *first) return true;
    first = value;
  }
  return false;
}

bool is_of_one_alone(const analysis::FigureRow& row) {
  return std::ranges::count_if(row.values, [](const auto& v) { return v.has_value(); }) < 2;
}

// Returns the judged figures, then the others by decreasing relative difference; with `all`, all
// figures in the summary's order.
std::vector<const analysis::FigureRow*> chosen_figures(const Comparison& c, bool all) {
  std::vector<const analysis::FigureRow*> judged, rest;
  for (const analysis::FigureRow& row : c.figures)
    if (all || !verdicts_of(c, row.key).empty())
      judged.push_back(&row);
    else if (analysis::size_of_change(row) > 0)
      rest.push_back(&row);
  std::ranges::stable_sort(rest, std::ranges::greater{},
                           [](const auto* row) { return analysis::size_of_change(*row); });
  rest.resize(std::min(rest.size(), most_figures));
  judged.insert(judged.end(), rest.begin(), rest.end());
  return judged;
}

std::vector<std::string> figure_cells(const Comparison& c, const analysis::FigureRow& row,
                                      const ComparisonText& how) {
  const Figure figure(row.key, how.units, c.runs.front().atmosphere);
  const std::optional<double>& first = row.values.front();
  std::vector<std::string> cells = {std::string(analysis::without_unit(row.key)),
                                    figure.value(first)};
  for (std::size_t i = 1; i < row.values.size(); ++i) {
    const std::optional<double>& other = row.values[i];
    const bool both = first && other;
    cells.push_back(figure.value(other));
    if (c.runs.size() == 2) cells.push_back(both ? figure.difference(*first, *other) : "");
    cells.push_back(both ? figure.relative(*first, *other) : "");
  }
  cells.push_back(verdicts_of(c, row.key, how.color));
  return cells;
}

void print_table(const TextTable& table, const ComparisonText& how, std::string& out) {
  if (!table.empty()) out += table.text_within(how.width);
}

// Prints the number of rows that are not shown, and the hint to see them.
void print_rest(std::size_t rest, std::string_view what, const ComparisonText& how,
                std::string& out) {
  if (rest > 0)
    print(out, "and {} more{}{}{}\n", rest, what, how.see_all.empty() ? "" : ": ", how.see_all);
}

void print_figures(const Comparison& c, const ComparisonText& how, std::string& out) {
  const auto differing = std::ranges::count_if(c.figures, differs);
  const auto alone = std::ranges::count_if(c.figures, is_of_one_alone);
  print(out, "\nNumbers: {} of {} differ{}\n", differing, c.figures.size(),
        alone > 0 ? fmt::format(", {} of one run alone", alone) : "");
  std::vector<std::string> titles = {"", "A"};
  for (std::size_t i = 1; i < c.runs.size(); ++i) {
    titles.push_back(letter_of(i));
    if (c.runs.size() == 2) titles.push_back("B − A");
    titles.push_back("");
  }
  titles.push_back("");
  std::vector<Align> align(titles.size(), Align::right);
  align.front() = align.back() = Align::left;

  TextTable table(titles, align);
  std::ptrdiff_t shown = 0;
  for (const analysis::FigureRow* row : chosen_figures(c, how.all)) {
    table.add(figure_cells(c, *row, how));
    shown += differs(*row);
  }
  print_table(table, how, out);
  print_rest(static_cast<std::size_t>(std::max<std::ptrdiff_t>(differing - shown, 0)),
             " that differ", how, out);
}

// --- parameters ---

std::string cut(const std::string& text) {
  if (columns(text) <= most_letters) return text;
  std::size_t end = most_letters - 2;
  while ((static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a letter
  return text.substr(0, end) + " …";
}

void print_parameters(const Comparison& c, const ComparisonText& how, std::string& out) {
  print(out, "\nParameters: {}\n",
        c.parameters.empty() ? "all equal" : fmt::format("{} differ", c.parameters.size()));
  std::vector<std::string> titles = {""};
  for (std::size_t i = 0; i < c.runs.size(); ++i) titles.push_back(letter_of(i));
  TextTable table(titles);
  std::size_t shown = 0;
  for (const ParameterRow& row : c.parameters) {
    if (!how.all && shown++ == most_parameters) break;
    std::vector<std::string> cells = {row.key};
    for (const auto& value : row.values) cells.push_back(value ? cut(*value) : "-");
    table.add(std::move(cells));
  }
  print_table(table, how, out);
  if (!how.all && c.parameters.size() > most_parameters)
    print_rest(c.parameters.size() - most_parameters, "", how, out);
}

// --- channels ---

std::string note_of(const analysis::Difference& d) {
  std::string note;
  if (d.how == analysis::Pairing::between) note = "between samples";
  if (d.how == analysis::Pairing::held)
    note = fmt::format("apart {:.2g} % of the time", 100 * d.rms * d.rms);
  if (d.gaps > 0) note += fmt::format("{}{} gaps", note.empty() ? "" : ", ", d.gaps);
  return note;
}

// Returns a difference with its unit. Unknown units of a log are shown unchanged.
std::string difference_text(double si, const std::string& unit, const ShownUnits& units) {
  const ShownUnit shown = unit_of_difference(units, unit, si);
  return with_unit(shown.of(si), digits_of(shown.of(si)), shown);
}

std::vector<std::string> channel_cells(const ChannelRow& row, const analysis::Difference& d,
                                       const ShownUnits& units) {
  if (d.same) return {row.channel.name(), "same samples"};
  if (d.equal()) return {row.channel.name(), "equal", "", "", "", "", "", note_of(d)};
  if (d.samples == 0) return {row.channel.name(), "never meet"};
  const std::string at = fmt::format("{:.4g} s", d.at);
  if (d.how == analysis::Pairing::held)
    return {row.channel.name(), "", "", "", "", at, "", note_of(d)};
  const auto text = [&](double si) { return difference_text(si, row.unit, units); };
  return {row.channel.name(),
          text(d.rms),
          d.span > 0 ? fmt::format("{:.2g} %", 100 * d.share()) : "",
          signed_text(text(d.bias), d.bias),
          signed_text(text(d.largest), d.largest),
          at,
          std::isfinite(d.correlation) ? fmt::format("{:.4f}", d.correlation) : "",
          note_of(d)};
}

// Prints the channels of one run compared with the first run.
void print_channels(const Comparison& c, std::size_t run, const ComparisonText& how,
                    std::string& out) {
  std::vector<const ChannelRow*> rows;
  std::size_t same = 0, compared = 0;
  for (const ChannelRow& row : c.channels) {
    const auto& d = row.differences[run];
    if (!d) continue;
    ++compared;
    same += d->same;
    if (how.all || !(d->same || d->equal())) rows.push_back(&row);
  }
  print(out, "\nChannels, {} against A: {} compared, {} with the same samples\n", letter_of(run),
        compared, same);
  const std::size_t differing = rows.size();
  if (!how.all) {
    std::ranges::stable_sort(rows, std::ranges::greater{},
                             [&](const ChannelRow* row) { return row->differences[run]->share(); });
    rows.resize(std::min(rows.size(), most_channels));
  }
  TextTable table({"", "rms", "of range", "bias", letter_of(run) + " − A at most", "at", "r", ""},
                  {Align::left, Align::right, Align::right, Align::right, Align::right,
                   Align::right, Align::right, Align::left});
  for (const ChannelRow* row : rows)
    table.add(channel_cells(*row, *row->differences[run], how.units));
  print_table(table, how, out);
  print_rest(differing - rows.size(), "", how, out);
}

}  // namespace

std::string text_of(const Comparison& comparison, const ComparisonText& how) {
  std::string out;
  print_runs(comparison, how.fit_clock, out);
  print_figures(comparison, how, out);
  print_parameters(comparison, how, out);
  for (std::size_t i = 1; i < comparison.runs.size(); ++i) print_channels(comparison, i, how, out);
  return out;
}

}  // namespace sinew::report
