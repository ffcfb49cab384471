#include "sinew/identify/joint/joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sinew/actuator/braid.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/joint/torque.h"

namespace sinew::identify {

namespace {

// --- poses of a joint as rows of a report ---

// Returns the load's torque at every pose; those of `others` are held out if they are a separate
// file.
Rows rows_of(const Measured& data, const JointTorque& joint,
             const std::optional<Measured>& held_out, const std::optional<JointTorque>& others) {
  Rows out;
  out.x = "angle";
  out.x_unit = "rad";
  out.at = data["angle"];
  out.measured = joint.torque();
  out.scattered = true;  // pressures vary as well
  if (!held_out) return out;
  const std::vector<double>& angle = (*held_out)["angle"];
  out.held_out.assign(out.size(), false);
  out.at.insert(out.at.end(), angle.begin(), angle.end());
  out.measured.insert(out.measured.end(), others->torque().begin(), others->torque().end());
  out.held_out.resize(out.size(), true);
  return out;
}

// --- parameters of a joint under a model ---

// Accesses the value of a parameter.
using JointPlace = std::function<double&(JointValues&)>;

// A parameter of the search, with access to its value.
struct JointSlot {
  Parameter parameter;
  JointPlace place;
};

// Adds parameters of motion and of the torque sensors. The first recording has no gain, unless the
// force is known.
void add_sensors(const JointTorque& joint, const JointSetup& setup, std::vector<JointSlot>& out) {
  const double most = joint.largest_torque();
  const auto add = [&](std::string name, const char* unit, double low, double high, double scale,
                       JointPlace place) {
    out.push_back(
        {{.name = std::move(name), .unit = unit, .low = low, .high = high, .scale = scale},
         std::move(place)});
  };
  if (setup.moving) {
    add("friction", "N m", 0, 10 * most, 0.1 * most, &JointValues::friction);
    add("damping", "N m s/rad", 0, 1e3 * most / joint.fastest(), 0.1 * most / joint.fastest(),
        &JointValues::damping);
    add("delay", "s", -0.2, 0.2, 0.05, &JointValues::delay);
  }
  for (std::size_t k = 0; k < joint.recordings(); ++k) {
    const std::string of =
        k < setup.recordings.size() && joint.recordings() > 1 ? " of " + setup.recordings[k] : "";
    if (setup.torque_bias)
      add("torque_bias" + of, "N m", -most, most, 0.1 * most,
          [k](JointValues& v) -> double& { return v.bias[k]; });
    if (setup.torque_gain && (k > 0 || setup.keep_force))
      add("torque_gain" + of, "1", 0.1, 10, 0.1,
          [k](JointValues& v) -> double& { return v.gain[k]; });
  }
}

// Returns the parameters of the model, without those that the setup gives.
std::vector<JointSlot> joint_slots(const JointLaw& law, const JointTorque& joint,
                                   const JointSetup& setup) {
  const double longest = setup.actuator.braid.thread_length;
  const double shortest = actuator::shortest_length(setup.actuator.braid);
  std::vector<JointSlot> out;
  const auto add = [&](bool wanted, const char* name, const char* unit, double low, double high,
                       double scale, JointPlace place) {
    if (wanted)
      out.push_back(
          {{.name = name, .unit = unit, .low = low, .high = high, .scale = scale}, place});
  };
  const auto unknown = [](double known) { return !std::isfinite(known); };
  add(unknown(setup.moment_arm), "moment_arm", "m", 1e-4, 2 * longest, 0.1 * longest,
      &JointValues::moment_arm);
  add(law.hinge, "origin_ratio", "1", 1.02, 100, 1, &JointValues::origin_ratio);
  add(law.hinge, "origin_angle", "rad", 0.05, 3.1, 1, &JointValues::origin_angle);
  add(joint.has_flexor() && unknown(setup.flexor_length), "flexor_length", "m", 0.5 * shortest,
      1.5 * longest, 0.1 * longest, &JointValues::flexor_length);
  add(joint.has_extensor() && unknown(setup.extensor_length), "extensor_length", "m",
      0.5 * shortest, 1.5 * longest, 0.1 * longest, &JointValues::extensor_length);
  add(!setup.keep_force, "c0", "1", 0.01, 10, 0.5, &JointValues::c0);
  add(!setup.keep_force && law.pressure, "c1", "1/Pa", -1e-5, 1e-5,
      0.5 / std::max(joint.highest_gauge(), 1e4), &JointValues::c1);
  add_sensors(joint, setup, out);
  return out;
}

// Returns the values with those of the setup and these parameters.
JointValues joint_known(const JointTorque& joint, const JointSetup& setup) {
  JointValues v;
  v.bias.assign(joint.recordings(), 0.0);
  v.gain.assign(joint.recordings(), 1.0);
  if (std::isfinite(setup.moment_arm)) v.moment_arm = setup.moment_arm;
  if (std::isfinite(setup.flexor_length)) v.flexor_length = setup.flexor_length;
  if (std::isfinite(setup.extensor_length)) v.extensor_length = setup.extensor_length;
  return v;
}

JointValues joint_with(JointValues v, const std::vector<JointSlot>& slots,
                       std::span<const double> p) {
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i].place(v) = p[i];
  return v;
}

// Returns start values: short and long arms, short and long muscles.
std::vector<std::vector<double>> joint_starts(const std::vector<JointSlot>& slots,
                                              const JointTorque& joint, const JointSetup& setup) {
  const double longest = setup.actuator.long_end.length > 0 ? setup.actuator.long_end.length
                                                            : setup.actuator.braid.thread_length;
  std::vector<std::vector<double>> out;
  for (const double arm : {0.1, 0.25, 0.6})
    for (const double mount : {0.8, 0.95}) {
      JointValues v{.moment_arm = arm * longest,
                    .origin_ratio = 4,
                    .origin_angle = 1.5,
                    .flexor_length = mount * longest,
                    .extensor_length = mount * longest,
                    .c0 = 0.9};
      v.friction = 0.05 * joint.largest_torque();
      v.bias.assign(joint.recordings(), 0.0);
      v.gain.assign(joint.recordings(), 1.0);
      std::vector<double> p;
      for (const JointSlot& s : slots) p.push_back(s.place(v));
      out.push_back(std::move(p));
    }
  return out;
}

// --- products of a joint's parameters that the data determine ---

// Returns whether the parameter is not of the sensors, the friction or the damping.
bool of_the_joint(std::string_view name) {
  for (const std::string_view other : {"torque_", "friction", "damping", "delay"})
    if (name.starts_with(other)) return false;
  return true;
}

// Returns the principal axes of the relative errors, best determined first, for the
// parameters that are positive and within their bounds.
std::vector<Combination> combinations_of(const Solution& s) {
  std::vector<std::size_t> which;
  const std::size_t n = s.estimates.size();
  for (std::size_t i = 0; i < n; ++i)
    if (s.estimates[i].value > 0 && s.estimates[i].free && of_the_joint(s.estimates[i].name) &&
        !s.estimates[i].at_bound && s.estimates[i].name != "c1")
      which.push_back(i);
  const std::size_t m = which.size();
  Matrix relative(m, m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k)
      relative(i, k) =
          s.covariance[which[i] * n + which[k]] / (s.values[which[i]] * s.values[which[k]]);
  std::vector<Combination> out;
  if (!relative.is_finite()) {
    for (const std::string& text : s.undetermined) out.push_back({text, unbounded});
    return out;
  }
  const Axes axes = axes_of_positive(relative);
  for (std::size_t k = 0; k < m; ++k) {
    Combination c;
    const std::span<const double> power = axes.axes.column(k);
    const double largest =
        *std::ranges::max_element(power, {}, [](double x) { return std::abs(x); });
    const double sign = largest < 0 ? -1 : 1;
    for (std::size_t i = 0; i < m; ++i)
      if (std::abs(power[i]) > 0.05)
        c.text += fmt::format("{}{}^{:.2f}", c.text.empty() ? "" : " ", s.estimates[which[i]].name,
                              sign * power[i]);
    c.relative_error = t_quantile(std::max(1, s.freedom)) * std::sqrt(axes.values[k]);
    out.push_back(std::move(c));
  }
  return out;
}

constexpr ColumnSpec columns[] = {
    {"angle", "rad", 0.01, 7, needed_column, "of the joint"},
    {"flexor_pressure", "Pa abs", 5e4, 5e6, optional_column, "in the muscle that flexes"},
    {"extensor_pressure", "Pa abs", 5e4, 5e6, optional_column, "in the muscle that extends"},
    {"torque", "N m", 0, 0, optional_column, "of all loads on the joint, raises the angle > 0"},
    {"load", "kg", 0, 0, optional_column, "hanging at the lever"},
    {"time", "s", 0, 0, optional_column, "of a joint that moves"},
};

// A parameter with a wider 95 % interval, relative to its value, is not determined.
constexpr double widest_interval = 0.25;
// Step of derivatives for a moving joint, whose dry friction has kinks.
constexpr double across_kinks = 0.01;
// Excursion below which arm and force are not separable.
constexpr double least_excursion = 5 * std::numbers::pi / 180;

constexpr std::array laws{
    JointLaw{"round", "T = r F(L_m - r q), Eff = c0", "[22], a round cam", false, false},
    JointLaw{"round_pressure", "T = r F(L_m - r q), Eff = c0 + c1 P_g", "[22], [30], a round cam",
             false, true},
    JointLaw{"hinge", "T = r(q) F(L_m - s(q)), Eff = c0, between two points", "[22], cosine rule",
             true, false},
    JointLaw{"hinge_pressure", "T = r(q) F(L_m - s(q)), Eff = c0 + c1 P_g, between two points",
             "[22], [30], cosine rule", true, true}};

using Law = JointLaw;
using Values = JointValues;

// Returns whether the parameter affects a muscle's force or arm.
bool of_muscles(std::string_view name) {
  for (const std::string_view one : {"moment_arm", "flexor_length", "extensor_length", "c0", "c1"})
    if (name == one) return true;
  return false;
}

// Returns a description of another solution with a different muscle parameter, if the residuals do
// not exclude it: by less than ten times the noise's variance. Empty if no other exists.
std::string other_solution(const SolverOptions& options, const Solution& best,
                           const Solution& other) {
  const double s2 = best.standard_deviation * best.standard_deviation;
  const double least = loss_of(best.residuals, options);
  if (loss_of(other.residuals, options) - least > 10 * s2 + 1e-9 * least) return "";
  for (const Estimate& e : best.estimates) {
    const double there = other[e.name].value;
    const bool matters = of_muscles(e.name) && e.name != "c1";
    if (matters && std::abs(there - e.value) > widest_interval * std::abs(e.value))
      return fmt::format("{} {:.4g} {} and {:.4g} {} fit alike", e.name, e.value, e.unit, there,
                         e.unit);
  }
  return "";
}

std::string error_text(const Combination& c) {
  if (!std::isfinite(c.relative_error)) return c.text + " is not determined";
  return fmt::format("{} +- {:.2g} %", c.text, 100 * c.relative_error);
}

// Throws Refusal with the parameters that the data do not separate, or with another solution that
// fits as well, unless all muscle parameters are determined.
void refuse_inseparable(const FitProblem& problem, std::span<const Solution> all_starts,
                        Solution& s) {
  std::string which, ambiguous;
  for (const Solution& other : all_starts)
    if (ambiguous.empty()) ambiguous = other_solution(problem.options, s, other);
  for (const Estimate& e : s.estimates) {
    const bool matters = of_muscles(e.name);
    if (matters && e.free && (e.at_bound || !e.identifiable))
      which += (which.empty() ? "" : ", ") + e.name;
  }
  if (which.empty() && ambiguous.empty()) return;
  std::string out = which.empty() ? ambiguous : which + " cannot be separated";
  const std::vector<Combination> all = combinations_of(s);
  if (!all.empty() && std::isfinite(all.front().relative_error))
    out += "; determined is " + error_text(all.front());
  if (all.size() > 1) out += "; worst is " + error_text(all.back());
  throw Refusal(out);
}

void refuse_unusable(const Measured& data, const JointTorque& joint, const JointSetup& setup) {
  if (!joint.has_flexor() && !joint.has_extensor())
    throw Refusal(data.file, "no pressure",
                  "a column flexor_pressure or extensor_pressure, or both",
                  "names.flexor_pressure=NAME");
  const bool known = data.has("torque") || data.has("load") || std::isfinite(setup.load) ||
                     (setup.limb > 0 && setup.limb_lever > 0);
  if (!known)
    throw Refusal(data.file, "no known load",
                  "one: angles and pressures alone give no torque a scale, every force law would "
                  "do with some arm",
                  "a column torque or load, or load=MASS and lever=LENGTH");
  if (!data.has("torque") && !(setup.lever > 0) && !(setup.limb_lever > 0))
    throw Refusal(data.file, "a load without a lever", "where it hangs", "lever=\"6 in\"");
  double most = 0, mean = 0;
  for (const double t : joint.torque()) {
    most = std::max(most, std::abs(t));
    mean += t / static_cast<double>(joint.rows());
  }
  if (!(most > 0))
    throw Refusal(data.file, "loads whose torque is zero throughout", "a torque that is known",
                  "another down=ANGLE, or loads");
  refuse_constant(data, "angle", least_excursion,
                  "angles that differ by more than 5 deg: at one angle the arm and the force are "
                  "one number",
                  "more loads and pressures");
  // A single muscle holds against the load.
  const double pulls = joint.has_flexor() ? joint.sign() : -joint.sign();
  if (joint.has_flexor() != joint.has_extensor() && pulls * mean > 0)
    throw Refusal(data.file, "a load that pulls the way the muscle pulls", "one against it",
                  "the sign of torque, the other flexion=SENSE, or down=ANGLE");
}

// Throws Refusal if columns are missing that the sensor settings need.
void refuse_without_torque(const Measured& data, const JointSetup& setup) {
  if ((setup.torque_bias || setup.torque_gain || setup.moving) && !data.has("torque"))
    throw Refusal(data.file, "no torque", "one, whose sensor has a bias, a gain or a delay",
                  "a column torque, or a joint at rest");
  if (setup.moving && !data.has("time"))
    throw Refusal(data.file, "no time", "it, of a joint that moves", "names.time=NAME");
  const bool one = !data.has("recording") || largest(data["recording"]) == 0;
  if (setup.torque_gain && one && !setup.keep_force)
    throw Refusal(data.file, "one recording whose gain is to be found",
                  "a force that is known: the gain of a torque is that of the force",
                  "keep_force=true, or another recording");
}

// Returns the last third of each recording, as neighbouring samples of a motion are not
// independent.
Split last_thirds(const Measured& data) {
  Split out;
  const std::vector<double>* of = data.has("recording") ? &data["recording"] : nullptr;
  for (std::size_t from = 0; from < data.rows();) {
    std::size_t to = from;
    while (to < data.rows() && (!of || (*of)[to] == (*of)[from])) ++to;
    for (std::size_t i = from; i < to; ++i)
      (3 * (i - from) < 2 * (to - from) ? out.fitted : out.held_out).push_back(i);
    from = to;
  }
  return out;
}

Split every_third(const Measured& data) {
  Split out;
  for (std::size_t i = 0; i < data.rows(); ++i)
    (i % 3 == 2 ? out.held_out : out.fitted).push_back(i);
  return out;
}

// Returns a law that predicts the unbalanced torque of each row, which is measured as zero. Rows of
// `others` are scored and not fitted; null: the splits are.
Candidate candidate_of(const Law& law, const JointTorque& joint, const JointTorque* others,
                       const JointSetup& setup, const Constraints& constraints) {
  const std::vector<JointSlot> slots = joint_slots(law, joint, setup);
  Candidate out{.model = law.name,
                .law = law.law,
                .source = law.source,
                .starts = joint_starts(slots, joint, setup),
                .search_tolerance = 0,
                .options = {.correlated = setup.moving,
                            .widest_interval = widest_interval,
                            .difference = setup.moving ? across_kinks : SolverOptions{}.difference},
                .constraints = constraints,
                .may_be_at_bounds = true,
                .finish = refuse_inseparable};
  for (const JointSlot& s : slots) out.parameters.push_back(s.parameter);
  const auto torque_of = [&law, slots, known = joint_known(joint, setup)](
                             const JointTorque& of, std::span<const double> p,
                             std::span<double> values) {
    of.residuals(law, joint_with(known, slots, p), values);
    for (double& sum : values) sum = -sum;  // predicted - measured
  };
  out.predict = [&joint, torque_of](std::span<const double> p, std::span<double> values) {
    torque_of(joint, p, values);
    return true;
  };
  if (others)
    out.left_out = [others, torque_of](const Solution& whole) {
      std::vector<double> values(others->rows());
      torque_of(*others, whole.values, values);
      return values;
    };
  return out;
}

// Writes the arms over the measured angles.
void put_cam(const Measured& data, const JointTorque& joint, const Hinge& tendon, double rest,
             JointResult& out) {
  const double low = smallest(data["angle"]), high = largest(data["angle"]);
  constexpr int pieces = 8;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = low + (high - low) * i / pieces;
    const double q = joint.sign() * (angle - rest);
    out.cam_angle.push_back(angle);
    out.cam_flexor.push_back(tendon.arm(q));
    out.cam_extensor.push_back(tendon.arm(-q));
  }
}

void refuse_if_all_are(const Report& report, const std::string& file) {
  std::string reasons;
  for (const Fit& fit : report.fits) {
    if (fit.refused.empty()) return;
    reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", fit.model, fit.refused);
  }
  throw Refusal(file, "no model whose values the data determine (" + reasons + ")",
                "poses that separate arm, length and force",
                "larger excursions, moment_arm=LENGTH, flexor_length=LENGTH, or keep_force=true");
}

// Gives a held-out recording a number that no fitted one has.
std::optional<Measured> as_another(std::optional<Measured> held_out, std::size_t number) {
  if (!held_out) return held_out;
  held_out->columns.push_back(
      {.name = "recording",
       .unit = "1",
       .values = std::vector<double>(held_out->rows(), static_cast<double>(number))});
  return held_out;
}

void refuse_other_columns(const Measured& data, const Measured& held_out) {
  for (const Column& c : data.columns)
    if (!held_out.has(c.name))
      throw Refusal(held_out.file, fmt::format("no column {}", c.name),
                    fmt::format("the columns of {}", data.file), "");
}

}  // namespace

std::span<const ColumnSpec> joint_columns(bool moving) {
  return std::span<const ColumnSpec>(columns).first(std::size(columns) - (moving ? 0 : 1));
}

std::vector<std::string> joint_models() { return names_of_laws(laws); }

JointResult identify_joint(const Measured& data, const std::optional<Measured>& other,
                           const JointSetup& setup, std::string_view model,
                           const Constraints& constraints, host::Tally* done) {
  const JointTorque joint(data, setup);
  const std::optional<Measured> held_out = as_another(other, joint.recordings());
  refuse_without_torque(data, setup);
  refuse_unusable(data, joint, setup);
  if (held_out) refuse_other_columns(data, *held_out);
  std::optional<JointTorque> others;
  if (held_out) others.emplace(*held_out, setup);

  JointResult out;
  Report& report = out.report;
  report.set_subject("force law and moment arm of a joint", "torque", "N m",
                     "the largest torque of the load");
  for (const double t : joint.torque())
    report.full_scale = std::max(report.full_scale, std::abs(t));
  report.held_out_is = held_out       ? held_out->file
                       : setup.moving ? "the last third of each recording"
                                      : "every third row";
  report.notes = data.notes;
  report.not_shown = {"the joint at angles and pressures between which no pose was measured"};

  std::vector<Candidate> candidates;
  for (const Law& law : laws)
    if (!setup.keep_force || !law.pressure)  // the force may be given
      candidates.push_back(
          candidate_of(law, joint, others ? &*others : nullptr, setup, constraints));
  check_constraints(candidates);
  Trial trial{.measured = std::vector<double>(data.rows(), 0.0),
              .weights = data.weights,
              .variances = data.variances,
              .has_band = false,
              .shows_left_out = held_out.has_value(),
              .model = model};
  for (std::size_t i = 0; !data.has("torque") && i < trial.variances.size(); ++i)
    trial.variances[i] *= std::pow(joint.torque_per_load(i), 2);
  if (!held_out) trial.splits = {setup.moving ? last_thirds(data) : every_third(data)};
  fit_candidates(std::move(candidates), trial, report, done);
  refuse_if_all_are(report, data.file);
  report.rows = rows_of(data, joint, held_out, others);
  std::vector<std::shared_ptr<const Refit>> refits;  // until the choice
  for (const Fit& fit : report.fits) refits.push_back(fit.refit);
  conclude(report);

  const Law& law = *std::ranges::find(laws, report.best().model, &Law::name);
  const Solution& solution = refits[report.chosen]->solution;
  const Values v =
      joint_with(joint_known(joint, setup), joint_slots(law, joint, setup), solution.values);
  joint.warn_of_ends(law, v, report.warnings);
  out.combinations = combinations_of(solution);
  out.moment_arm = v.moment_arm;
  out.flexor_length = joint.has_flexor() ? v.flexor_length : to_be_found;
  out.extensor_length = joint.has_extensor() ? v.extensor_length : to_be_found;
  out.effectiveness = joint.effectiveness(v);
  if (law.hinge) {
    const Hinge tendon = JointTorque::hinge(law, v);
    report.fits[report.chosen].notes.push_back(
        fmt::format("the points are {:.4g} m and {:.4g} m from the joint, or the other way round",
                    tendon.origin(), tendon.insertion()));
    put_cam(data, joint, tendon, setup.rest_angle, out);
  }
  return out;
}

}  // namespace sinew::identify
