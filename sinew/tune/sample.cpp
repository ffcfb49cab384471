#include "sinew/tune/sample.h"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <numeric>

#include "sinew/config/diagnostics.h"
#include "sinew/units/hash.h"

namespace sinew::tune {
namespace {

constexpr const char* example = "\"joint.hip.angle_gain=0.02:0.4 %/count log\"";

// Returns 64 bits for a point, or a digit, of a range, independent of the number of points.
std::uint64_t bits(std::uint64_t seed, std::size_t range, std::uint64_t point) {
  return units::mix(units::mix(units::mix(seed) + range) + point);
}

// Returns a number in [0, 1) from the upper 53 bits.
double share(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

std::vector<double> random_shares(const Sample& s) {
  const std::size_t d = s.ranges.size();
  std::vector<double> out(s.points * d);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = share(bits(s.seed, i % d, i / d));
  return out;
}

// Permutes the parts of each range independently.
std::vector<double> latin_shares(const Sample& s) {
  const std::size_t d = s.ranges.size();
  std::vector<double> out(s.points * d);
  std::vector<std::size_t> order(s.points);
  for (std::size_t range = 0; range < d; ++range) {
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t left = s.points; left > 1; --left)  // Fisher and Yates
      std::swap(order[left - 1], order[bits(~s.seed, range, left) % left]);
    for (std::size_t i = 0; i < s.points; ++i)
      out[i * d + range] = (static_cast<double>(order[i]) + share(bits(s.seed, range, i))) /
                           static_cast<double>(s.points);
  }
  return out;
}

}  // namespace

// The engine omits the sequence's first point, which is 0. It is added here, since the first 2^m
// points are not spread evenly without it.
std::vector<double> sobol_shares(std::size_t d, std::size_t points, std::uint64_t seed) {
  std::vector<double> out(points * d);
  boost::random::sobol engine(d);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint64_t digits = i < d ? 0 : engine();
    out[i] = share(digits ^ bits(seed, i % d, 0));
  }
  return out;
}

Value Range::at(double share) const {
  const double from = *axis.values.front().number, to = *axis.values.back().number;
  if (scale == Scale::log) return axis.at(from * std::pow(to / from, share));
  if (scale == Scale::linear) return axis.at(from + share * (to - from));
  return axis.at(from + std::floor(share * (to - from + 1)));
}

double Range::share_of(double number) const {
  const double from = *axis.values.front().number, to = *axis.values.back().number;
  if (scale == Scale::log) return std::log(number / from) / std::log(to / from);
  if (scale == Scale::linear) return (number - from) / (to - from);
  return (number - from + 0.5) / (to - from + 1);
}

Range parse_range(std::string_view text, std::string_view setting) {
  Range out;
  const std::size_t blank = trimmed(text).rfind(' ');
  const std::string_view last =
      blank == text.npos ? std::string_view() : trimmed(text).substr(blank + 1);
  if (last == "log") out.scale = Range::Scale::log;
  if (last == "whole") out.scale = Range::Scale::whole;
  const bool said = out.scale != Range::Scale::linear;
  out.axis = parse_ends(said ? trimmed(text).substr(0, blank) : text, setting, example);
  const auto refuse = [&](const char* expected) {
    config::fail({std::string(setting), 0, 0}, "", config::in_quotes(text), expected, example);
  };
  for (const Value& end : out.axis.values) {
    if (out.scale == Range::Scale::log && !(*end.number > 0))
      refuse("ends above 0, which have a logarithm");
    if (out.scale == Range::Scale::whole && *end.number != std::floor(*end.number))
      refuse("whole ends");
  }
  return out;
}

std::vector<double> shares(const Sample& s) {
  if (!s.given.empty() || s.given_later || s.ranges.empty()) return s.given;
  if (s.kind == Sample::Kind::random) return random_shares(s);
  return s.kind == Sample::Kind::latin ? latin_shares(s)
                                       : sobol_shares(s.ranges.size(), s.points, s.seed);
}

}  // namespace sinew::tune
