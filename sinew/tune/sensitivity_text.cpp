#include "sinew/tune/sensitivity_text.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/report/text/text_table.h"

namespace sinew::tune {
namespace {

std::string three_digits(const std::string& number) {
  return number.empty() ? "" : fmt::format("{:.3g}", std::stod(number));
}

// Without the figure's name, and an interval behind its number.
std::vector<std::string> shown(const std::vector<std::string>& headings,
                               const std::vector<std::string>& row) {
  std::vector<std::string> out{row[1]};
  for (std::size_t i = 2; i < row.size(); ++i) {
    out.push_back(three_digits(row[i]));
    if (i + 1 == row.size() || !headings[i + 1].ends_with(", low")) continue;
    out.push_back(fmt::format("{} to {}", three_digits(row[i + 1]), three_digits(row[i + 2])));
    i += 2;
  }
  return out;
}

std::vector<std::string> titles_of(const std::vector<std::string>& headings) {
  std::vector<std::string> out{""};
  for (std::size_t i = 2; i < headings.size(); ++i) {
    if (headings[i].ends_with(", high")) continue;
    out.push_back(headings[i].ends_with(", low") ? "95 %" : headings[i]);
  }
  return out;
}

}  // namespace

std::string text_of(const Design& design, const Sweep& runs, const FigureSensitivity& figure) {
  if (!figure.found) return figure.figure + ": too few runs have it, or it never changes\n";
  const Sensitivity& s = *figure.found;
  const std::vector<std::string> headings = sensitivity_headings(design.method);
  const std::vector<std::string> titles = titles_of(headings);
  std::vector<report::TextTable::Align> align(titles.size(), report::TextTable::Align::right);
  align.front() = report::TextTable::Align::left;
  report::TextTable table(titles, align);
  for (const auto& row : sensitivity_rows(design, runs, {figure})) table.add(shown(headings, row));
  return fmt::format("{}: mean {:.5g}, standard deviation {:.3g}{}\n{}", figure.figure, s.mean,
                     std::sqrt(s.variance),
                     s.left_out > 0 ? fmt::format(", {} left out", s.left_out) : "",
                     table.text("  "));
}

}  // namespace sinew::tune
