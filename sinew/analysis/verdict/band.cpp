#include "sinew/analysis/verdict/band.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <tuple>

namespace sinew::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double small_share = 0.05, large_share = 0.2, about_share = 0.1;
constexpr double rounding_share = 1e-9;
constexpr double points = 2, largest_share_of_points = 0.25;

// Returns value ± distance, widened by the rounding of binary fractions, so that a value at the end
// is inside.
Band within(double value, double distance, Wording wording) {
  const double rounding = 1e-12 * (std::fabs(value) + distance);
  return {value - distance - rounding, value + distance + rounding, wording};
}

}  // namespace

Band measured(double value, double last_digit, double reading_error) {
  const double distance = std::max(last_digit / 2, small_share * std::fabs(value));
  return within(value, distance + reading_error, Wording::measured);
}

Band percentage(double percents, double reading_error) {
  const double distance = std::min(points, largest_share_of_points * std::fabs(percents));
  return within(percents, distance + reading_error, Wording::percentage);
}

Band about(double value, double reading_error) {
  return within(value, about_share * std::fabs(value) + reading_error, Wording::about);
}

Band negligible(double of) {
  const double most = small_share * std::fabs(of);
  return {-most, most, Wording::negligible};
}

Band small(double of) {
  const double most = large_share * std::fabs(of);
  return {-most, most, Wording::small};
}

Band noticeable(double of) { return {small_share * of, infinity, Wording::noticeable}; }
Band substantial(double of) { return {large_share * of, infinity, Wording::substantial}; }

Band much_less(double of) {
  return {-infinity, of - large_share * std::fabs(of), Wording::much_less};
}

Band much_more(double of) {
  return {of + large_share * std::fabs(of), infinity, Wording::much_more};
}

Band range(double lowest, double highest) { return {lowest, highest, Wording::range}; }
Band at_least(double lowest) { return {lowest, infinity, Wording::range}; }
Band at_most(double highest) { return {-infinity, highest, Wording::range}; }

Band computed(double value, double last_digit) {
  return within(value, last_digit / 2, Wording::computed);
}

Band identity(double of) {
  const double most = rounding_share * std::fabs(of);
  return {-most, most, Wording::computed};
}

Band another(double lowest, double highest) { return {lowest, highest, Wording::another}; }

std::string_view rule_of(Wording wording) {
  switch (wording) {
    case Wording::measured:
      return "a measured number: half its last digit, or 5 % of the number where that is more";
    case Wording::percentage:
      return "a percentage: 2 points, at most a quarter of the number";
    case Wording::about:
      return "\"about\": 10 %";
    case Wording::negligible:
      return "negligible: under 5 % of the range";
    case Wording::noticeable:
      return "named as present: not under 5 % of the range";
    case Wording::small:
      return "small, slight: not substantial, under 20 %";
    case Wording::substantial:
      return "substantial: over 20 %";
    case Wording::much_less:
      return "much less: by over 20 %";
    case Wording::much_more:
      return "much more: by over 20 %";
    case Wording::range:
      return "a range: itself";
    case Wording::computed:
      return "computed: half its last digit, or rounding";
    case Wording::another:
      break;
  }
  return "another band";
}

namespace {

struct Number {
  double value = 0, last_digit = 1;
  std::size_t begin = 0, end = 0;  // in the text
};

bool starts_number(std::string_view text, std::size_t i) {
  constexpr std::string_view digits = "0123456789";
  if (i > 0 && text[i - 1] != ' ') return false;
  if (text[i] == '-' || text[i] == '.') ++i;
  return i < text.size() && digits.find(text[i]) != digits.npos;
}

Number number_at(std::string_view text, std::size_t i) {
  Number out{.begin = i};
  const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), out.value);
  (void)error;  // it starts like a number
  out.end = static_cast<std::size_t>(end - text.data());
  const std::string_view digits = text.substr(i, out.end - i);
  const std::size_t exponent = digits.find_first_of("eE"), point = digits.find('.');
  const std::string_view mantissa = digits.substr(0, exponent);
  int power = point == digits.npos ? 0 : -static_cast<int>(mantissa.size() - point - 1);
  if (exponent != digits.npos) {
    int more = 0;
    const std::size_t at = exponent + 1 + (digits[exponent + 1] == '+');
    std::from_chars(digits.data() + at, digits.data() + digits.size(), more);
    power += more;
  }
  out.last_digit = std::pow(10.0, power);
  return out;
}

bool holds_word(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](auto w) { return text.find(w) != text.npos; });
}

}  // namespace

QuotedNumber quoted_number(std::string_view words) {
  std::array<Number, 2> last;
  int count = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!starts_number(words, i)) continue;
    last[0] = last[1];
    last[1] = number_at(words, i);
    ++count;
    i = last[1].end;
  }
  if (count == 0) return {};
  QuotedNumber out{.found = true,
                   .lowest = last[1].value,
                   .highest = last[1].value,
                   .last_digit = last[1].last_digit};
  const std::size_t unit = words.find_first_not_of(' ', last[1].end);
  if (unit != words.npos) out.unit = words.substr(unit);
  const std::string_view before = words.substr(0, last[1].begin);
  if (count > 1 && words.substr(last[0].end, last[1].begin - last[0].end) == " to ")
    std::tie(out.lowest, out.highest) = std::minmax(last[0].value, last[1].value);
  else if (holds_word(before, {"below ", "at most ", "less than ", "under "}))
    out.lowest = -infinity;
  else if (holds_word(before, {"above ", "at least ", "more than ", "over "}))
    out.highest = infinity;
  return out;
}

}  // namespace sinew::analysis
