#include "sinew/report/figures/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sinew::report {
namespace {

// Formats a number with three digits, or more if the band is narrow.
std::string number(double value, const Band& band) {
  const double width = band.highest - band.lowest;
  if (value == 0 || (std::isfinite(width) && std::fabs(value) < 1e-5 * width)) return "0";
  const int size = static_cast<int>(std::floor(std::log10(std::fabs(value))));
  int digits = 3;
  if (std::isfinite(width) && width > 0)
    digits = size - static_cast<int>(std::floor(std::log10(width))) + 2;
  if (size < 7) digits = std::max(digits, size + 1);  // 1000, no 1e+03
  std::string text = fmt::format("{:.{}g}", value, std::clamp(digits, 3, 7));
  return text.find('e') == text.npos ? text : fmt::format("{:.2g}", value);
}

std::string with_unit(std::string text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

std::string band_text(const Band& b, const std::string& unit) {
  const auto end = [](double x) { return fmt::format("{:.6g}", x); };
  if (std::isinf(b.lowest) && std::isinf(b.highest)) return "";
  if (std::isinf(b.lowest)) return with_unit("at most " + end(b.highest), unit);
  if (std::isinf(b.highest)) return with_unit("at least " + end(b.lowest), unit);
  return with_unit(fmt::format("{} to {}", end(b.lowest), end(b.highest)), unit);
}

}  // namespace

Claim judge(StatementClass statement_class, const Measured& m) {
  if (m.accept.wording == analysis::Wording::another && m.why.empty())
    throw std::logic_error("a band of our own without its reason: " + m.says);
  Claim c{.where = m.where, .says = m.says, .reported = m.reported, .quantity = m.quantity};
  c.computed = std::isfinite(m.computed) ? with_unit(number(m.computed, m.accept), m.unit) : "none";
  c.accept = band_text(m.accept, m.unit);
  c.why = m.why;
  c.statement_class = statement_class;
  c.wording = m.accept.wording;
  const bool inside = m.accept.holds(m.computed);
  c.verdict = inside ? Agreement::agrees : Agreement::differs;
  if (m.because.empty()) return c;
  c.verdict = inside ? Agreement::agrees_unexpectedly : Agreement::differs_as_known;
  c.why += fmt::format("{}Known to differ: {}", c.why.empty() ? "" : ". ", m.because);
  return c;
}

Claim not_applicable(std::string where, std::string says, std::string reported, std::string why) {
  return {.where = std::move(where),
          .says = std::move(says),
          .reported = std::move(reported),
          .quantity = {},
          .computed = {},
          .accept = {},
          .why = std::move(why)};
}

Claim claim(const analysis::Verdict& v) {
  Claim out{.where = v.source,
            .says = {},
            .reported = v.reported,
            .quantity = v.key,
            .computed = v.computed,
            .accept = v.accept,
            .why = v.band_reason,
            .verdict = v.agreement,
            .statement_class = v.statement_class,
            .wording = v.wording};
  // The source of a verdict ends with the reason of a known difference.
  constexpr std::string_view mark = ". Why: ";
  if (const std::size_t at = out.where.find(mark); at != out.where.npos) {
    out.why +=
        (out.why.empty() ? "" : ". ") + ("Known to differ: " + out.where.substr(at + mark.size()));
    out.where.resize(at);
  }
  return out;
}

void count(Tally& tally, const std::vector<Claim>& claims) {
  for (const Claim& c : claims) tally.add(c.statement_class, c.verdict);
}

int Tally::of(Agreement verdict) const {
  int sum = 0;
  for (const StatementClass c : all_classes) sum += of(c, verdict);
  return sum;
}

int Tally::of(StatementClass statement_class) const {
  int sum = 0;
  for (const Agreement v : all_verdicts) sum += of(statement_class, v);
  return sum;
}

int Tally::total() const {
  int sum = 0;
  for (const Agreement v : all_verdicts) sum += of(v);
  return sum;
}

}  // namespace sinew::report
