#include <algorithm>
#include <array>
#include <utility>

#include "cli/thesis/thesis.h"

namespace sinew::cli::thesis {
namespace {

// Of keys that the experiments of chapters 3 and 6 have judged.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> words = {{
    {"swing.period_s", "Period of the swing"},
    {"swing.damping_ratio", "Damping ratio"},
    {"swing.coulomb_length_m", "Coulomb constant Q"},
    {"swing.viscous_N_s_per_m", "Viscous constant c"},
    {"stand.final_length_m", "Length at rest"},
    {"stand.greatest_force_N", "Greatest force"},
    {"pulsed.length_m", "Settled length"},
    {"pulsed.length_ripple_m", "Ripple of the length"},
    {"pulsed.pressure_Pa", "Settled pressure"},
    {"pulsed.pressure_ripple_diff_Pa", "Ripple of the pressure"},
}};

}  // namespace

report::Claim Section::number(const char* says, const char* theirs, const char* quantity,
                              double ours, const char* unit, report::Band accept, const char* why,
                              const char* because) const {
  return report::judge({.where = where_,
                        .says = says,
                        .theirs = theirs,
                        .quantity = quantity,
                        .ours = ours,
                        .unit = unit,
                        .accept = accept,
                        .why = why,
                        .because = because});
}

report::Claim in_words(const analysis::Verdict& verdict) {
  report::Claim out = report::claim(verdict);
  const auto* known = std::ranges::find(words, verdict.key, &decltype(words)::value_type::first);
  if (known != words.end()) out.says = known->second;
  return out;
}

}  // namespace sinew::cli::thesis
