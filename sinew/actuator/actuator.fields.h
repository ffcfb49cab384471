// actuator/actuator.fields.h - the keys of robots/*/actuator.toml: name, unit, range, meaning.
//
// units/field.h describes the visitor. Checks that involve several keys (the braid is given, L_max
// is in its range) are in check.h.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/bladder.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension.h"
#include "sinew/units/constants.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::actuator {

// Visits thread length and turns, or the opened mesh that determines them. The mesh is not stored:
// a file that is written has length and turns.
template <class Visitor>
void fields(Visitor& v, Braid& braid) {
  v.number({.name = "thread_length",
            .unit = "m",
            .min = 1e-4,
            .max = 10,
            .why = "no braid is shorter or longer",
            .optional = true,
            .doc = "b, length of one thread [17]; or give trapezoids"},
           braid.thread_length);
  v.number({.name = "turns",
            .unit = "1",
            .min = 0.01,
            .max = 1e4,
            .why = "a thread winds about the axis",
            .optional = true,
            .doc = "n, turns of one thread about the axis [18]; or give trapezoids"},
           braid.turns);

  double lengthwise = 0, around = 0, side = 0;
  v.group({.name = "trapezoids",
           .optional = true,
           .doc = "count of the opened mesh, thesis figure 2-4"},
          [&](auto& g) {
            const auto counted = [&](std::string_view name, std::string_view doc, double& value) {
              g.number({.name = name,
                        .unit = "1",
                        .min = 0,
                        .max = 1e5,
                        .least = 1,
                        .why = "trapezoids are counted",
                        .doc = doc},
                       value);
            };
            counted("lengthwise", "A, trapezoids along the mesh [14]", lengthwise);
            counted("around", "B, trapezoids around the mesh [15]", around);
            g.number({.name = "side",
                      .unit = "m",
                      .min = 0,
                      .max = 1,
                      .least = 1e-6,
                      .why = "a trapezoid can be seen",
                      .doc = "l, side of one trapezoid"},
                     side);
          });
  const bool mesh = lengthwise > 0 && around > 0 && side > 0;
  const bool thread = braid.thread_length > 0 && braid.turns > 0;
  if (mesh && (braid.thread_length > 0 || braid.turns > 0)) {
    units::report_conflict(v, "trapezoids", "a second description of the braid",
                           "thread_length and turns, or trapezoids");
  } else if (!mesh && !thread) {
    units::report_conflict(v, "thread_length", "no complete braid",
                           "thread_length and turns, or trapezoids");
  }
  if (mesh) braid = braid_from_trapezoids(lengthwise, around, side);
}

// Rejects a polynomial whose share is implausible at the ends of its range.
template <class Visitor>
void check_share(Visitor& v, const Effectiveness& e) {
  constexpr double least = -0.5, most = 3;  // a line through a threshold begins below 0
  for (const double gauge : {e.valid_from, e.valid_to}) {
    const double share = effectiveness(e, gauge, units::atmosphere);
    if (share >= least && share <= most) continue;
    units::report_conflict(
        v, "polynomial", "a share of " + std::to_string(share) + " where it is valid",
        "-0.5 to 3: a share of the ideal tension", "the units of the coefficients");
    return;
  }
}

template <class Visitor>
void fields(Visitor& v, Effectiveness& e) {
  std::vector<double> coefficients{e.c0, e.c1, e.c2};
  v.polynomial({.name = "polynomial",
                .unit = "1",
                .doc = "c0 + c1 p + c2 p^2, effective share of the ideal tension [30]"},
               coefficients, "Pa");
  if (coefficients.size() > 3) {
    units::report_conflict(v, "polynomial", std::to_string(coefficients.size()) + " coefficients",
                           "at most 3");
  }
  coefficients.resize(3);
  e.c0 = coefficients[0];
  e.c1 = coefficients[1];
  e.c2 = coefficients[2];

  v.choice(
      {.name = "argument",
       .doc = "pressure p of the polynomial: gauge in [30], absolute in appendix A"},
      e.argument,
      {{"gauge", Effectiveness::Argument::gauge}, {"absolute", Effectiveness::Argument::absolute}});
  v.number({.name = "scale",
            .unit = "1",
            .min = 0,
            .max = 2,
            .why = "no more than all of the ideal tension arrives, by a wide margin",
            .optional = true,
            .doc = "factor of the polynomial"},
           e.scale);

  std::vector<double> valid{e.valid_from, e.valid_to};
  v.numbers({.name = "valid",
             .unit = "Pa gauge",
             .optional = true,
             .doc = "lowest and highest fitted pressure; constant outside"},
            valid);
  if (valid.size() != 2 || !(valid[0] < valid[1])) {
    units::report_conflict(v, "valid", "no range of pressures", "the lowest and the highest",
                           R"(["0 psi gauge", "110 psi gauge"])");
  }
  valid.resize(2);
  e.valid_from = valid[0];
  e.valid_to = valid[1];
  units::optional_amount(v, "threshold", "Pa gauge",
                         "gauge pressure at which the bladder touches the mesh; not in the thesis",
                         e.threshold);
  check_share(v, e);
}

template <class Visitor>
void fields(Visitor& v, LongEnd& end) {
  units::amount(v, "length", "m", "L_max, length from which the threads stretch [32]", end.length);
  units::amount(v, "stiffness", "N/m", "K_braid, stiffness of the threads [32]", end.stiffness);
  units::amount(v, "damping", "N s/m", "C_braid, damping of the threads [35]", end.damping);
}

template <class Visitor>
void fields(Visitor& v, ShortEnd& end) {
  v.choice({.name = "law",
            .doc = "stop: an end stop; zero: no tension, as printed in [31]; empirical: 5 F + 10 "
                   "F_damping, from appendix A"},
           end.law,
           {{"stop", ShortEnd::Law::stop},
            {"zero", ShortEnd::Law::zero},
            {"empirical", ShortEnd::Law::empirical}});
  units::optional_amount(v, "stiffness", "N/m", "stiffness of the stop in compression",
                         end.stiffness);
  units::optional_amount(v, "damping", "N s/m", "damping of the stop", end.damping);
}

template <class Visitor>
void fields(Visitor& v, Loss& loss) {
  units::amount(v, "viscous", "N s/m", "c, viscous loss [33]", loss.viscous);
  units::amount(v, "coulomb_length", "m", "Q = mu N/k, dry friction per stiffness [33]",
                loss.coulomb_length);
  v.choice({.name = "coulomb_scale",
            .doc = "stiffness k in Q k: secant [34], of the sealed muscle [45], or constant"},
           loss.coulomb_scale,
           {{"secant", Loss::Scale::secant},
            {"sealed", Loss::Scale::sealed},
            {"constant", Loss::Scale::constant}});
  units::optional_amount(v, "coulomb_stiffness", "N/m", "k if coulomb_scale = \"constant\"",
                         loss.coulomb_stiffness);
  v.flag({.name = "stick",
          .optional = true,
          .doc = "false: friction by the sign of the speed, as printed; it creeps under load"},
         loss.stick);
  if (loss.coulomb_scale == Loss::Scale::constant && !(loss.coulomb_stiffness > 0)) {
    units::report_conflict(v, "coulomb_scale", "\"constant\" without a stiffness",
                           "a coulomb_stiffness above zero with it");
  }
}

template <class Visitor>
void fields(Visitor& v, Bladder& bladder) {
  v.choice({.name = "fit",
            .optional = true,
            .doc = "stretched: up to the mesh; oversized: loose, without tension and threshold; "
                   "liner: the same of a film, without a wall; thesis 7.3"},
           bladder.fit,
           {{"stretched", Bladder::Fit::stretched},
            {"oversized", Bladder::Fit::oversized},
            {"liner", Bladder::Fit::liner}});
  units::amount(v, "stiffness", "N/m", "k_1, in parallel with the braid; not in the thesis",
                bladder.stiffness);
  units::optional_amount(v, "rest_length", "m", "L_r, length without tension", bladder.rest_length);
  v.number({.name = "quadratic",
            .unit = "N/m2",
            .optional = true,
            .doc = "k_2, tension per squared elongation"},
           bladder.quadratic);
  v.number({.name = "cubic",
            .unit = "N/m3",
            .optional = true,
            .doc = "k_3, tension per cubed elongation"},
           bladder.cubic);
  units::optional_amount(v, "saturating_tension", "N",
                         "S, tension that is lost over the first contraction",
                         bladder.saturating_tension);
  v.number({.name = "saturation_length",
            .unit = "m",
            .min = 0,
            .least = 1e-6,
            .why = "a shorter one has no effect",
            .optional = true,
            .doc = "lambda, contraction over which S is lost"},
           bladder.saturation_length);

  std::vector<double> valid{bladder.valid_from, bladder.valid_to};
  v.numbers({.name = "valid",
             .unit = "m",
             .optional = true,
             .doc = "shortest and longest fitted length; the tension is constant outside"},
            valid);
  if (valid.size() != 2 || !(valid[0] < valid[1])) {
    units::report_conflict(v, "valid", "no range of lengths", "the shortest and the longest",
                           R"(["80 mm", "100 mm"])");
  }
  valid.resize(2);
  bladder.valid_from = valid[0];
  bladder.valid_to = valid[1];
  if (bladder.saturating_tension != 0 && !(bladder.saturation_length > 0)) {
    units::report_conflict(v, "saturating_tension", "no way over which it is lost",
                           "a saturation_length above zero with it");
  }
}

template <class Visitor>
void fields(Visitor& v, Caps& caps) {
  units::amount(v, "length", "m", "d, both ends together; the braid has the rest of the length",
                caps.length);
}

template <class Visitor>
void fields(Visitor& v, Taper& taper) {
  v.number({.name = "gain",
            .unit = "1",
            .min = 0.1,
            .max = 10,
            .doc = "kappa_0, factor of the contraction"},
           taper.gain);
  v.number({.name = "extra_gain",
            .unit = "1",
            .min = 0,
            .max = 10,
            .optional = true,
            .doc = "kappa_low, added to the factor without pressure"},
           taper.extra_gain);
  v.number({.name = "extra_pressure",
            .unit = "Pa diff",
            .min = 0,
            .least = 1,
            .why = "a smaller one has no effect",
            .optional = true,
            .doc = "P_low, pressure over which kappa_low disappears"},
           taper.extra_pressure);
  units::amount(v, "rest_length", "m", "L_0, length without contraction", taper.rest_length);
  if (taper.extra_gain != 0 && !(taper.extra_pressure > 0)) {
    units::report_conflict(v, "extra_gain", "no pressure over which it goes",
                           "an extra_pressure above zero with it");
  }
}

template <class Visitor>
void fields(Visitor& v, Wall& wall) {
  units::amount(v, "thickness", "m", "h_w, thickness of tube and mesh together", wall.thickness);
}

template <class Visitor>
void fields(Visitor& v, AirVolume& air) {
  v.number({.name = "offset",
            .unit = "m3",
            .doc = "V_a, added to the braid's volume; below 0: a thick wall or an insert"},
           air.offset);
}

// Visits a range as two numbers, the lower first.
template <class Visitor>
void ends(Visitor& v, const units::Field& field, const char* example, double& low, double& high) {
  std::vector<double> both{low, high};
  v.numbers(field, both);
  if (both.size() != 2 || !(both[0] <= both[1]))
    units::report_conflict(v, field.name, "no range", "the lower end and the upper one", example);
  both.resize(2);
  low = both[0];
  high = both[1];
}

template <class Visitor>
void fields(Visitor& v, Prediction& p) {
  units::amount(v, "rest_length", "m", "L_0 of the measured muscle", p.rest_length);
  v.numbers(
      {.name = "lengths", .unit = "m", .min = 0, .doc = "measured lengths, in ascending order"},
      p.lengths);
  if (!std::ranges::is_sorted(p.lengths))
    units::report_conflict(v, "lengths", "lengths in another order",
                           "lengths from the shortest to the longest",
                           R"(["80 mm", "90 mm", "100 mm"])");
  ends(v, {.name = "pressures", .unit = "Pa gauge", .doc = "lowest and highest measured pressure"},
       R"(["0 kPa gauge", "600 kPa gauge"])", p.lowest, p.highest);
  // Half-widths about the law that contain 68 % and 95 % of the measured forces.
  units::amount(v, "inside_68", "N",
                "half-width (68 %) at these lengths and between these pressures", p.inside_68);
  units::amount(v, "inside_95", "N",
                "half-width (95 %) at these lengths and between these pressures", p.inside_95);
  units::optional_amount(
      v, "per_force_68", "1",
      "share of the force whose square is added to that of every half-width (68 %)",
      p.per_force_68);
  units::optional_amount(
      v, "per_force_95", "1",
      "share of the force whose square is added to that of every half-width (95 %)",
      p.per_force_95);
  units::optional_amount(v, "between_68", "N",
                         "half-width (68 %) halfway in the widest gap between lengths; 0: unknown",
                         p.between_68);
  units::optional_amount(v, "between_95", "N",
                         "half-width (95 %) halfway in the widest gap between lengths; 0: unknown",
                         p.between_95);
  units::optional_amount(v, "beyond_68", "N",
                         "half-width (68 %) a fifth of their range beyond the lengths; 0: unknown",
                         p.beyond_68);
  units::optional_amount(v, "beyond_95", "N",
                         "half-width (95 %) a fifth of their range beyond the lengths; 0: unknown",
                         p.beyond_95);
  units::optional_amount(v, "above_68", "N",
                         "half-width (68 %) a fifth of their range above the pressures; 0: unknown",
                         p.above_68);
  units::optional_amount(v, "above_95", "N",
                         "half-width (95 %) a fifth of their range above the pressures; 0: unknown",
                         p.above_95);
  units::optional_amount(v, "other_68", "1",
                         "half-width (68 %) at other rest lengths and no force, share of the "
                         "largest force; 0: unknown",
                         p.other_68);
  units::optional_amount(v, "other_95", "1",
                         "half-width (95 %) at other rest lengths and no force, share of the "
                         "largest force; 0: unknown",
                         p.other_95);
  units::optional_amount(v, "other_reach", "1",
                         "|ln(L/L_0)| up to which other rest lengths L were tested", p.other_reach);
  if ((p.rest_length > 0 || p.inside_95 > 0) && p.lengths.empty())
    units::report_conflict(v, "lengths", "none", "at least the one that was measured",
                           R"(["80 mm", "90 mm", "100 mm"])");
}

// 0: unknown, so that a file may have bounds alone.
template <class Visitor>
void fields(Visitor& v, Life& life) {
  constexpr std::string_view counted = "a cycle is counted as one or a half";
  v.number({.name = "contraction",
            .unit = "1",
            .min = 0,
            .max = 0.5,
            .least = 1e-3,
            .why = "a braid contracts by less than half",
            .optional = true,
            .doc = "Delta_ref, range of contraction of the counted cycles, of long_end.length"},
           life.contraction);
  units::optional_amount(v, "pressure", "Pa gauge",
                         "highest pressure of the counted cycles; 0: life at any pressure",
                         life.pressure);
  v.number({.name = "cycles_over",
            .unit = "1",
            .min = 0,
            .least = 0.5,
            .why = counted,
            .optional = true,
            .doc = "mean number of cycles until an actuator fails, lower bound; 0: unknown"},
           life.cycles_over);
  v.number({.name = "cycles_under",
            .unit = "1",
            .min = 0,
            .least = 0.5,
            .why = counted,
            .optional = true,
            .doc = "mean number of cycles until an actuator fails, upper bound; 0: unknown"},
           life.cycles_under);
  ends(v,
       {.name = "exponent",
        .unit = "1",
        .min = 0,
        .max = 30,
        .optional = true,
        .doc = "m, smallest and largest exponent of the cycles by the contraction"},
       R"(["1", "8"])", life.exponent_least, life.exponent_most);
  ends(
      v,
      {.name = "factor",
       .unit = "1",
       .min = 1e-6,
       .max = 1e6,
       .why = "no bladder lasts a million times as long as another",
       .optional = true,
       .doc = "f, smallest and largest factor of the cycles, for another bladder than the counted"},
      R"(["1", "24"])", life.factor_least, life.factor_most);
  const bool counts = life.cycles_over > 0 || life.cycles_under > 0;
  if (counts && !(life.contraction > 0))
    units::report_conflict(v, "contraction", "no contraction of the counted cycles",
                           "their range of contraction", "contraction = \"20 %\"");
  if (life.cycles_under > 0 && life.cycles_under < life.cycles_over)
    units::report_conflict(v, "cycles_under", "an upper bound below cycles_over",
                           "one above it, or no upper bound");
}

template <class Visitor>
void fields(Visitor& v, Series& series) {
  v.number({.name = "compliance",
            .unit = "m/N",
            .min = 0,
            .max = 0.01,
            .doc = "C_s, elongation of both ends together per tension; 0: rigid ends"},
           series.compliance);
}

template <class Visitor>
void fields(Visitor& v, Toe& toe) {
  v.number({.name = "tension",
            .unit = "N",
            .min = 0,
            .max = 1e4,
            .doc = "F_toe, tension about which a slack muscle straightens; 0: it pulls at once"},
           toe.tension);
}

template <class Visitor>
void fields(Visitor& v, Hysteresis& h) {
  units::amount(v, "half_width", "Pa diff",
                "w_0, half the pressure gap between filling and venting at one length",
                h.half_width);
  v.number({.name = "width_per_pressure",
            .unit = "1",
            .min = 0,
            .max = 0.9,
            .optional = true,
            .doc = "w_P, growth of half_width per gauge pressure"},
           h.width_per_pressure);
  units::optional_amount(
      v, "width_per_contraction", "Pa diff",
      "w_eps, growth of half_width per contraction, which counts from long_end.length",
      h.width_per_contraction);
  v.number({.name = "width_per_tension",
            .unit = "1",
            .min = 0,
            .max = 0.4,
            .optional = true,
            .doc = "w_F, share of the tension by which filling pulls less and venting more"},
           h.width_per_tension);
  if (width_growth(h) >= most_width_growth)
    units::report_conflict(
        v, "width_per_tension", "a half-width that grows as fast as the pressure",
        "width_per_pressure + 2 width_per_tension below 1", "a smaller width_per_pressure");
  v.number({.name = "volume_pressure",
            .unit = "Pa diff",
            .min = 0,
            .least = 1,
            .why = "a smaller one has no effect",
            .optional = true,
            .doc = "P_V, pressure with the effect of the greatest volume on the friction; 0: the "
                   "length has none"},
           h.volume_pressure);
}

template <class Visitor>
void fields(Visitor& v, Creep& creep) {
  // Shows only the elements that are set.
  std::vector<double> share, time;
  for (std::size_t i = 0; i < creep.share.size(); ++i) {
    if (creep.share[i] == 0) continue;
    share.push_back(creep.share[i]);
    time.push_back(creep.time[i]);
  }
  v.numbers({.name = "share",
             .unit = "1",
             .min = 0,
             .max = 1,
             .doc = "chi, share of the tension that is delayed; one or two elements"},
            share);
  v.numbers({.name = "time",
             .unit = "s",
             .min = 1e-3,
             .why = "a shorter delay has no effect",
             .doc = "time constant of each element"},
            time);
  bool slow = true;
  for (const double tau : time) slow = slow && tau > 0;
  if (share.size() != time.size() || share.size() > creep.share.size() || !slow) {
    units::report_conflict(
        v, "share",
        std::to_string(share.size()) + " shares and " + std::to_string(time.size()) + " times",
        "as many times above zero as shares, one or two", R"(share = ["3 %"], time = ["10 s"])");
  }
  share.resize(creep.share.size());
  time.resize(creep.time.size());
  for (std::size_t i = 0; i < share.size(); ++i) {
    creep.share[i] = share[i];
    creep.time[i] = time[i];
  }
}

// The actuator's name is the key of the table that contains this one.
template <class Visitor>
void fields(Visitor& v, Actuator& a) {
  v.group({.name = "braid", .doc = "geometry of the mesh"}, [&](auto& g) { fields(g, a.braid); });
  v.group({.name = "effectiveness", .optional = true, .doc = "losses of tension, by pressure"},
          [&](auto& g) { fields(g, a.effectiveness); });
  v.group({.name = "long_end", .doc = "end where the threads are straight and stretch"},
          [&](auto& g) { fields(g, a.long_end); });
  v.group({.name = "short_end", .doc = "end where the mesh is widest, at b/sqrt 3"},
          [&](auto& g) { fields(g, a.short_end); });
  v.group({.name = "loss", .doc = "losses in motion"}, [&](auto& g) { fields(g, a.loss); });
  v.group({.name = "bladder", .optional = true, .doc = "inner tube, as a spring"},
          [&](auto& g) { fields(g, a.bladder); });
  v.group({.name = "caps", .optional = true, .doc = "parts at the ends that do not contract"},
          [&](auto& g) { fields(g, a.caps); });
  v.group({.name = "taper", .optional = true, .doc = "tapering ends, by Tondu and Lopez"},
          [&](auto& g) { fields(g, a.taper); });
  v.group({.name = "wall", .optional = true, .doc = "wall of the tube, by Chou and Hannaford"},
          [&](auto& g) { fields(g, a.wall); });
  v.group({.name = "air", .optional = true, .doc = "air volume in addition to the braid's"},
          [&](auto& g) { fields(g, a.air); });
  v.group({.name = "series", .optional = true, .doc = "elastic ends"},
          [&](auto& g) { fields(g, a.series); });
  v.group(
      {.name = "toe", .optional = true, .doc = "soft beginning of the tension of a slack muscle"},
      [&](auto& g) { fields(g, a.toe); });
  loosen(a);
  if (tapers(a.taper) && !(a.taper.rest_length > a.caps.length)) {
    units::report_conflict(v, "taper", "no rest_length",
                           "that of the muscle without pressure and load");
  } else if (a.long_end.length < shortest_length(a)) {
    units::report_conflict(v, "long_end",
                           "a greatest length below the shortest, thread_length / sqrt 3",
                           "a length between that and the thread's");
  } else if (a.long_end.length > (1 + 1e-12) * (a.braid.thread_length + a.caps.length)) {
    units::report_conflict(v, "long_end", "a greatest length above thread_length and caps.length",
                           "a length between thread_length / sqrt 3 and the thread's");
  } else if (a.air.offset < 0 && !(volume(a, a.long_end.length) > 0)) {
    units::report_conflict(v, "air", "an offset that leaves no air at long_end.length",
                           "one that leaves some: above minus the volume of the braid there");
  }
  v.group({.name = "hysteresis",
           .optional = true,
           .doc = "friction that depends on the direction of the pressure"},
          [&](auto& g) { fields(g, a.hysteresis); });
  v.group({.name = "creep", .optional = true, .doc = "delayed tension"},
          [&](auto& g) { fields(g, a.creep); });
  v.group({.name = "life", .optional = true, .doc = "cycles until an actuator fails, as a range"},
          [&](auto& g) { fields(g, a.life); });
  v.group({.name = "prediction",
           .optional = true,
           .doc = "half-widths about the law that contain 68 % or 95 % of measured forces"},
          [&](auto& g) { fields(g, a.prediction); });
}

// Visits all actuators of a file.
template <class Visitor>
void fields(Visitor& v, std::vector<Actuator>& actuators) {
  v.each({.name = "actuator", .doc = "actuators, by name"}, actuators,
         [](auto& g, Actuator& a) { fields(g, a); });
}

}  // namespace sinew::actuator
