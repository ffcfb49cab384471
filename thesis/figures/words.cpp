#include <algorithm>
#include <array>
#include <utility>

#include "thesis/figures/thesis.h"

namespace sinew::thesis {
namespace {

// Descriptions of the keys that the experiments of chapters 3, 6 and 7 judge.
constexpr std::array<std::pair<std::string_view, std::string_view>, 28> words = {{
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
    {"trolley.distance_m", "Distance"},
    {"trolley.mean_speed_m_per_s", "Mean speed"},
    {"trolley.distance_from_torques_m", "Distance by integrating the forces of 6-8"},
    {"trolley.distance_from_torques_by_plan_m",
     "Distance by integrating the forces of 6-8 in planned stance alone"},
    {"joints.hip.passiveness", "Passiveness of the hip"},
    {"joints.knee.passiveness", "Passiveness of the knee"},
    {"joints.hip.excursion_rad", "Excursion of the hip"},
    {"joints.knee.excursion_rad", "Excursion of the knee"},
    {"phases.swing.joints.hip.fewest_turning_points",
     "The hip oscillates in every swing: turning points of its error, the fewest in one"},
    {"phases.swing.joints.knee.fewest_turning_points",
     "The knee oscillates in every swing: turning points of its error, the fewest in one"},
    {"joints.hip.velocity_jump_largest_rad_per_s", "Jump of the velocity from sample to sample"},
    {"muscles.hip_extensor.own_scale_peak_tension_N",
     "The greatest force, a reading of the hip's extensor by its own scale, is near the predicted "
     "one"},
    {"foot.extension_time_s", "Time from the retracted to the extended position, 10 to 90 % of x"},
    {"foot.extension_time_to_peak_s",
     "Time from the retracted position to the first peak of x, 10 to 90 %"},
    {"foot.slip_per_step_m", "Way that the foot slides in a step"},
    {"foot.step_repeat_rms_m", "The foot's path does not repeat itself"},
    {"ground_reaction.mean_normal_stance_true_N", "Foot forces are greater than in test 1"},
    {"rollers.front.min_load_N", "The leg lifts the front roller off the track"},
}};

}  // namespace

report::Claim Section::number(StatementClass statement_class, const std::string& says,
                              const std::string& reported, const std::string& quantity,
                              double computed, const std::string& unit, const report::Band& accept,
                              const std::string& why, const std::string& because) const {
  return report::judge(statement_class, {.where = where_,
                                         .says = says,
                                         .reported = reported,
                                         .quantity = quantity,
                                         .computed = computed,
                                         .unit = unit,
                                         .accept = accept,
                                         .why = why,
                                         .because = because});
}

report::Claim described_claim(const analysis::Verdict& verdict) {
  report::Claim out = report::claim(verdict);
  const auto* known = std::ranges::find(words, verdict.key, &decltype(words)::value_type::first);
  if (known != words.end()) out.says = known->second;
  return out;
}

std::string spaced_name(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace sinew::thesis
