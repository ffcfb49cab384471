#include "sinew/identify/pair/pair_law.h"

#include <algorithm>
#include <cmath>

#include "sinew/identify/data/series.h"

namespace sinew::identify {

namespace {

constexpr auto none = PairFriction::none, dry = PairFriction::dry, bristle = PairFriction::bristle,
               fading = PairFriction::fading;
constexpr const char* hooke = "Hooke";
constexpr const char* coulomb = "Hooke, Coulomb";
constexpr const char* slip = "Maxwell slip with one element";
constexpr const char* forgets = "Maxwell slip that relaxes";

// clang-format off
constexpr std::array all_laws{
    PairLaw{"spring",                 "F = k x",                                 hooke,   true,  false, false, false, none},
    PairLaw{"spring_viscous",         "F = k x + c v",                           hooke,   true,  false, true,  false, none},
    PairLaw{"spring_dry",             "F = k x + D sign v",                      coulomb, true,  false, false, false, dry},
    PairLaw{"spring_viscous_dry",     "F = k x + c v + D sign v",                coulomb, true,  false, true,  false, dry},
    PairLaw{"spring_bristle",         "F = k x + D w(x)",                        slip,    true,  false, false, false, bristle},
    PairLaw{"spring_viscous_bristle", "F = k x + c v + D w(x)",                  slip,    true,  false, true,  false, bristle},
    PairLaw{"spring_fading",          "F = k x + D w(x, t)",                     forgets, true,  false, false, false, fading},
    PairLaw{"spring_viscous_fading",  "F = k x + c v + D w(x, t)",               forgets, true,  false, true,  false, fading},
    PairLaw{"spring_mass_fading",     "F = k x + c v + m a + D w(x, t)",         forgets, true,  false, true,  true,  fading},
    PairLaw{"air_bristle",            "F = A dP + D w(x)",                       slip,    false, true,  false, false, bristle},
    PairLaw{"air_fading",             "F = A dP + D w(x, t)",                    forgets, false, true,  false, false, fading},
    PairLaw{"both_fading",            "F = k x + A dP + D w(x, t)",              forgets, true,  true,  false, false, fading},
    PairLaw{"all",                    "F = k x + A dP + c v + m a + D w(x, t)",  forgets, true,  true,  true,  true,  fading}};
// clang-format on

}  // namespace

std::span<const PairLaw> pair_laws() { return all_laws; }

std::vector<double> pair_pressure(const PairRecord& record) {
  if (record.pressure.empty()) return {};
  const double share = record.pressure.size() == 1 ? 2 : 1;
  std::vector<double> out(record.size(), 0.0);
  for (const std::vector<double>& p : record.pressure) {
    const double sign = line_through(record.at, p).slope() < 0 ? -share : share;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += sign * p[i];
  }
  double mean = 0;
  for (const double p : out) mean += p / static_cast<double>(out.size());
  for (double& p : out) p -= mean;
  return out;
}

void pair_friction(const PairLaw& law, const PairValues& values, double start,
                   const PairRecord& record, std::span<double> out) {
  const std::size_t n = record.size();
  if (law.friction == dry) {
    for (std::size_t i = 0; i < n; ++i)
      out[i] = record.rate[i] > 0 ? 1.0 : record.rate[i] < 0 ? -1.0 : 0.0;
    return;
  }
  double w = start, last_step = -1, kept = 1;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      const double step = record.time[i] - record.time[i - 1];
      if (law.friction == fading && std::abs(step - last_step) > 1e-6 * step) {
        kept = std::exp(-step / values.fade_time);
        last_step = step;
      }
      w = std::clamp(w * kept + (record.at[i] - record.at[i - 1]) / values.presliding, -1.0, 1.0);
    }
    out[i] = w;
  }
}

void pair_effort(const PairLaw& law, const PairValues& v, double start, double delay,
                 const PairRecord& record, std::span<const double> pressure,
                 std::span<double> out) {
  const std::size_t n = record.size();
  std::vector<double> inside(n, 0.0);
  if (law.friction != none) pair_friction(law, v, start, record, inside);
  for (std::size_t i = 0; i < n; ++i) {
    inside[i] = v.friction * inside[i] + v.stiffness * record.at[i] + v.viscous * record.rate[i] +
                v.mass * record.acceleration[i];
    if (law.air) inside[i] += v.area * pressure[i];
  }
  if (delay != 0)
    delayed(record.time, inside, delay, out);
  else
    std::ranges::copy(inside, out.begin());
}

}  // namespace sinew::identify
