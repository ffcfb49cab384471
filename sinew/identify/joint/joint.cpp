#include "sinew/identify/joint/joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/joint/combinations.h"
#include "sinew/identify/joint/rows.h"
#include "sinew/identify/joint/torque.h"

namespace sinew::identify {

namespace {

constexpr std::array columns{
    Wanted{.name = "angle", .unit = "rad", .least = 0.01, .most = 7, .doc = "of the joint"},
    Wanted{.name = "flexor_pressure",
           .unit = "Pa abs",
           .least = 5e4,
           .most = 5e6,
           .optional = true,
           .doc = "in the muscle that flexes"},
    Wanted{.name = "extensor_pressure",
           .unit = "Pa abs",
           .least = 5e4,
           .most = 5e6,
           .optional = true,
           .doc = "in the muscle that extends"},
    Wanted{.name = "torque",
           .unit = "N m",
           .optional = true,
           .doc = "of all loads on the joint, raises the angle > 0"},
    Wanted{.name = "load", .unit = "kg", .optional = true, .doc = "hanging at the lever"}};

// A parameter with a wider 95 % interval, relative to itself, counts as not determined.
constexpr double widest_interval = 0.25;
// Excursion below which arm and force are one.
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

struct Slot {
  Parameter parameter;
  double Values::*place;
};

std::vector<Slot> slots_of(const Law& law, const JointTorque& joint, const JointSetup& setup) {
  const double longest = setup.actuator.braid.thread_length;
  const double shortest = actuator::shortest_length(setup.actuator.braid);
  std::vector<Slot> out;
  const auto add = [&](bool wanted, const char* name, const char* unit, double low, double high,
                       double scale, double Values::*place) {
    if (wanted)
      out.push_back(
          {{.name = name, .unit = unit, .low = low, .high = high, .scale = scale}, place});
  };
  const auto unknown = [](double known) { return !std::isfinite(known); };
  add(unknown(setup.moment_arm), "moment_arm", "m", 1e-4, 2 * longest, 0.1 * longest,
      &Values::moment_arm);
  add(law.hinge, "origin_ratio", "1", 1.02, 100, 1, &Values::origin_ratio);
  add(law.hinge, "origin_angle", "rad", 0.05, 3.1, 1, &Values::origin_angle);
  add(joint.has_flexor() && unknown(setup.flexor_length), "flexor_length", "m", 0.5 * shortest,
      1.5 * longest, 0.1 * longest, &Values::flexor_length);
  add(joint.has_extensor() && unknown(setup.extensor_length), "extensor_length", "m",
      0.5 * shortest, 1.5 * longest, 0.1 * longest, &Values::extensor_length);
  add(!setup.keep_force, "c0", "1", 0.01, 10, 0.5, &Values::c0);
  add(!setup.keep_force && law.pressure, "c1", "1/Pa", -1e-5, 1e-5,
      0.5 / std::max(joint.highest_gauge(), 1e4), &Values::c1);
  return out;
}

// Throws config::Error for a wish of what no law has.
void check_wishes(const JointTorque& joint, const JointSetup& setup, const Wishes& wishes) {
  std::vector<Parameter> all;
  for (const Law& law : laws)
    for (Slot& slot : slots_of(law, joint, setup)) all.push_back(std::move(slot.parameter));
  if (!wishes.empty()) wishes.check(all);
}

Values known_values(const JointSetup& setup) {
  Values v;
  if (std::isfinite(setup.moment_arm)) v.moment_arm = setup.moment_arm;
  if (std::isfinite(setup.flexor_length)) v.flexor_length = setup.flexor_length;
  if (std::isfinite(setup.extensor_length)) v.extensor_length = setup.extensor_length;
  return v;
}

Values with(Values v, const std::vector<Slot>& slots, std::span<const double> p) {
  for (std::size_t i = 0; i < slots.size(); ++i) v.*slots[i].place = p[i];
  return v;
}

// Short and long arms, short and long muscles.
std::vector<std::vector<double>> starts_of(const std::vector<Slot>& slots,
                                           const JointSetup& setup) {
  const double longest = setup.actuator.long_end.length > 0 ? setup.actuator.long_end.length
                                                            : setup.actuator.braid.thread_length;
  std::vector<std::vector<double>> out;
  for (const double arm : {0.1, 0.25, 0.6})
    for (const double mount : {0.8, 0.95}) {
      Values v{.moment_arm = arm * longest,
               .origin_ratio = 4,
               .origin_angle = 1.5,
               .flexor_length = mount * longest,
               .extensor_length = mount * longest,
               .c0 = 0.9};
      std::vector<double> p;
      for (const Slot& s : slots) p.push_back(v.*s.place);
      out.push_back(std::move(p));
    }
  return out;
}

struct Solved {
  Values values;
  Solution solution;
  std::string ambiguous;  // another answer that fits as well
};

double square_sum(const Solution& s) {
  return s.rms * s.rms * static_cast<double>(s.residuals.size());
}

// Something that matters is elsewhere although the residuals cannot tell, by ten times the noise's
// variance.
std::string another_answer(const Solution& best, const Solution& other) {
  const double s2 = best.standard_deviation * best.standard_deviation;
  if (square_sum(other) - square_sum(best) > 10 * s2 + 1e-9 * square_sum(best)) return "";
  for (const Estimate& e : best.estimates) {
    const double there = other[e.name].value;
    const bool matters = !e.name.starts_with("origin") && e.name != "c1";
    if (matters && std::abs(there - e.value) > widest_interval * std::abs(e.value))
      return fmt::format("{} {:.4g} {} and {:.4g} {} fit alike", e.name, e.value, e.unit, there,
                         e.unit);
  }
  return "";
}

Solved solve(const Law& law, const JointTorque& joint, const JointSetup& setup,
             const Wishes& wishes) {
  const std::vector<Slot> slots = slots_of(law, joint, setup);
  std::vector<Parameter> parameters;
  for (const Slot& s : slots) parameters.push_back(s.parameter);
  const Values known = known_values(setup);
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    joint.residuals(law, with(known, slots, p), r);
    return true;
  };
  std::vector<Solution> all;
  for (const std::vector<double>& start : starts_of(slots, setup)) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      parameters[i].start = std::clamp(start[i], parameters[i].low, parameters[i].high);
    all.push_back(least_squares(residuals, joint.rows(), parameters, wishes,
                                {.widest_interval = widest_interval}));
  }
  const auto best = std::min_element(all.begin(), all.end(), [](const auto& x, const auto& y) {
    return square_sum(x) < square_sum(y);
  });
  Solved out{with(known, slots, best->values), *best, ""};
  for (const Solution& other : all)
    if (out.ambiguous.empty()) out.ambiguous = another_answer(*best, other);
  return out;
}

std::string error_text(const Combination& c) {
  if (!std::isfinite(c.relative_error)) return c.text + " not at all";
  return fmt::format("{} +- {:.2g} %", c.text, 100 * c.relative_error);
}

// What the data cannot tell apart; empty where everything that matters is determined.
std::string inseparable(const Solved& solved) {
  const Solution& s = solved.solution;
  std::string which;
  for (const Estimate& e : s.estimates) {
    const bool matters = !e.name.starts_with("origin");
    if (matters && e.free && (e.at_bound || !e.identifiable))
      which += (which.empty() ? "" : ", ") + e.name;
  }
  if (which.empty() && solved.ambiguous.empty()) return "";
  std::string out = which.empty() ? solved.ambiguous : which + " cannot be told apart";
  const std::vector<Combination> all = combinations_of(s);
  if (!all.empty() && std::isfinite(all.front().relative_error))
    out += "; determined is " + error_text(all.front());
  if (all.size() > 1) out += "; worst is " + error_text(all.back());
  return out;
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

std::pair<Measured, Measured> every_third(const Measured& data) {
  std::vector<std::size_t> keep, out;
  for (std::size_t i = 0; i < data.rows(); ++i) (i % 3 == 2 ? out : keep).push_back(i);
  return {data.subset(keep), data.subset(out)};
}

std::vector<double> residuals_of(const Law& law, const JointTorque& joint, const Values& values) {
  std::vector<double> r(joint.rows());
  joint.residuals(law, values, r);
  return r;
}

// One law, fitted to all rows and scored on what is held out.
Fit tried_fit(const Law& law, const JointTorque& joint, const JointTorque& some,
              const JointTorque& others, bool refit, const JointSetup& setup, const Wishes& wishes,
              double full_scale, Solved& solved) {
  Fit fit{.model = law.name, .law = law.law, .source = law.source};
  try {
    solved = solve(law, joint, setup, wishes);
    fit.parameters = solved.solution.estimates;
    fit.refused = inseparable(solved);
    fit.fit = score(solved.solution.residuals, full_scale);
    fit.residuals = told_from(solved.solution.residuals);
    const Values values = refit ? solve(law, some, setup, wishes).values : solved.values;
    const std::vector<double> unseen = residuals_of(law, others, values);
    fit.held_out = score(unseen, full_scale);
    const std::vector<double> told = told_from(unseen);
    if (!refit) fit.residuals.insert(fit.residuals.end(), told.begin(), told.end());
  } catch (const Refusal& e) {
    fit.refused = e.what();
  }
  return fit;
}

// Arms over the angles that were measured.
void put_cam(const Measured& data, const JointTorque& joint, const Hinge& cord, double rest,
             JointResult& out) {
  const double low = smallest(data["angle"]), high = largest(data["angle"]);
  constexpr int pieces = 8;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = low + (high - low) * i / pieces;
    const double q = joint.sign() * (angle - rest);
    out.cam_angle.push_back(angle);
    out.cam_flexor.push_back(cord.arm(q));
    out.cam_extensor.push_back(cord.arm(-q));
  }
}

void refuse_if_all_are(const Report& report, const std::string& file) {
  std::string reasons;
  for (const Fit& fit : report.fits) {
    if (fit.refused.empty()) return;
    reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", fit.model, fit.refused);
  }
  throw Refusal(file, "no model whose values the data determine (" + reasons + ")",
                "poses that tell arm, length and force apart",
                "larger excursions, moment_arm=LENGTH, flexor_length=LENGTH, or keep_force=true");
}

void refuse_other_columns(const Measured& data, const Measured& held_out) {
  for (const Column& c : data.columns)
    if (!held_out.has(c.name))
      throw Refusal(held_out.file, fmt::format("no column {}", c.name),
                    fmt::format("the columns of {}", data.file), "");
}

}  // namespace

std::span<const Wanted> joint_columns() { return columns; }

std::vector<std::string> joint_models() {
  std::vector<std::string> out;
  for (const Law& law : laws) out.emplace_back(law.name);
  return out;
}

JointResult identify_joint(const Measured& data, const std::optional<Measured>& held_out,
                           const JointSetup& setup, std::string_view model, const Wishes& wishes) {
  const JointTorque joint(data, setup);
  refuse_unusable(data, joint, setup);
  if (held_out) refuse_other_columns(data, *held_out);
  check_wishes(joint, setup, wishes);
  const auto [seen, unseen] = held_out ? std::pair(data, *held_out) : every_third(data);
  const JointTorque some(seen, setup), others(unseen, setup);

  JointResult out;
  Report& report = out.report;
  report.subject = "force law and moment arm of a joint";
  report.quantity = "torque";
  report.unit = "N m";
  for (const double t : joint.torque())
    report.full_scale = std::max(report.full_scale, std::abs(t));
  report.full_scale_is = "the largest torque of the load";
  report.held_out_is = held_out ? held_out->file : "every third row";
  report.notes = data.notes;

  std::vector<const Law*> tried;
  std::vector<Solved> solved;
  for (const Law& law : laws) {
    if (!model.empty() && model != law.name) continue;
    if (setup.keep_force && law.pressure) continue;  // the force is what it is
    tried.push_back(&law);
    solved.emplace_back();
    report.fits.push_back(tried_fit(law, joint, some, others, !held_out, setup, wishes,
                                    report.full_scale, solved.back()));
  }
  if (tried.empty()) throw std::invalid_argument(fmt::format("no model {}", model));
  refuse_if_all_are(report, data.file);
  report.rows = rows_of(data, joint, held_out, others);
  choose(report);

  const Law& law = *tried[report.chosen];
  const Values& v = solved[report.chosen].values;
  joint.warn_of_ends(law, v, report.warnings);
  out.combinations = combinations_of(solved[report.chosen].solution);
  out.moment_arm = v.moment_arm;
  out.flexor_length = joint.has_flexor() ? v.flexor_length : to_be_found;
  out.extensor_length = joint.has_extensor() ? v.extensor_length : to_be_found;
  out.effectiveness = joint.effectiveness(v);
  if (law.hinge) {
    const Hinge cord = JointTorque::hinge(law, v);
    report.fits[report.chosen].notes.push_back(
        fmt::format("the points are {:.4g} m and {:.4g} m from the joint, or the other way round",
                    cord.origin(), cord.insertion()));
    put_cam(data, joint, cord, setup.rest_angle, out);
  }
  return out;
}

}  // namespace sinew::identify
