#include "sinew/identify/actuator/static_explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sinew::identify {

namespace {

constexpr double near_scatters = 3, near_share = 0.01;  // of the largest force
constexpr double other_mount = 0.004;  // of the longest length: less is the same one

// One thing that may have happened to a number.
struct Slip {
  double factor;
  std::string_view words;
};

// The force that was written down is the true one times this.
constexpr Slip of_force[] = {{-1, "its sign is the other one"},
                             {10, "ten times what the law has: a slipped decimal"},
                             {0.1, "a tenth of what the law has: a slipped decimal"},
                             {100, "a hundred times what the law has: a slipped decimal"},
                             {0.01, "a hundredth of what the law has: a slipped decimal"},
                             {2, "twice what the law has: counted double"},
                             {0.5, "half of what the law has: counted for one of two"},
                             {4.4482216, "4.45 times what the law has: N in place of lbf"},
                             {1 / 4.4482216, "what the law has over 4.45: lbf in place of N"},
                             {1 / 9.80665, "what the law has over 9.81: kg in place of N"}};

// The pressure that was written down is the true one times this.
constexpr Slip of_pressure[] = {
    {10, "as at a tenth of its pressure: a slipped decimal"},
    {0.1, "as at ten times its pressure: a slipped decimal"},
    {2, "as at half its pressure"},
    {0.5, "as at twice its pressure"},
    {6.894757, "as at its pressure over 6.89: kPa in place of psi"},
    {1 / 6.894757, "as at 6.89 times its pressure: psi in place of kPa"}};

// Looks for the explanation that comes nearest.
class SlipSearch {
 public:
  // `within`: how near is near enough  [N].
  SlipSearch(const StaticFit& fit, const StaticScales& scales, double within)
      : fit_(fit), scales_(scales), within_(within), least_(within) {}

  // Would the law have the measured force there, were the point this one and the force so?
  void ask(const StaticPoint& as, double force, std::string words) {
    const double law = predicted(fit_.setting, scales_, as);
    if (law < 2 * within_) return;  // no force says nothing of where it was read
    const double off = std::abs(law - force);
    if (off > least_) return;
    least_ = off;
    words_ = std::move(words);
  }

  const std::string& words() const { return words_; }

 private:
  const StaticFit& fit_;
  const StaticScales& scales_;
  double within_, least_;
  std::string words_;
};

}  // namespace

std::string explanation_of(const StaticPoint& point, const StaticFit& fit,
                           const StaticScales& scales, std::span<const StaticPoint> points,
                           double scatter) {
  const double within = std::max(near_scatters * scatter, near_share * scales.full_scale);
  if (std::abs(point.force) < within)
    return "no force where the law pulls: slack, not connected, or not measured";
  SlipSearch search(fit, scales, within);
  for (const Slip& slip : of_force)
    search.ask(point, point.force / slip.factor, std::string(slip.words));
  for (const Slip& slip : of_pressure) {
    StaticPoint as = point;
    as.pressure /= slip.factor;
    if (as.pressure < 1.5 * scales.top_pressure)
      search.ask(as, point.force, std::string(slip.words));
  }
  double longest = 0;
  for (const StaticPoint& p : points) longest = std::max(longest, p.length);
  for (const StaticPoint& p : points) {
    if (p.rest_length != point.rest_length) continue;
    if (std::abs(p.length - point.length) < other_mount * longest) continue;
    StaticPoint as = point;
    as.length = p.length;
    search.ask(as, point.force,
               fmt::format("as at {:.4g} mm, another mount of these data", 1e3 * p.length));
  }
  return search.words().empty() ? "nothing in these data explains it" : search.words();
}

}  // namespace sinew::identify
