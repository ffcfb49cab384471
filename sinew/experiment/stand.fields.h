// experiment/stand.fields.h - keys of an experiment on a test stand.
#pragma once

#include <string_view>

#include "sinew/experiment/stand.h"
#include "sinew/robot/stand.fields.h"
#include "sinew/units/field.h"

namespace sinew::experiment {

template <class Visitor>
void law_fields(Visitor& v, Stand::Drive& d) {
  units::optional_amount(v, "desired", "m", "feed-forward, feedback: desired length", d.desired);
  robot::points(v, "lengths",
                {.name = "length", .unit = "m", .min = 0, .why = "a length is not negative"},
                "feed-forward, feedback: desired length over time", d.lengths);
  units::optional_amount(v, "assumed_load", "N", "feed-forward: assumed load on the element",
                         d.assumed_load);
  v.choice(
      {.name = "law",
       .optional = true,
       .doc = "feedback: pulses beyond the dead band, or a duty proportional to the error"},
      d.law,
      {{"on-off", Stand::Drive::Law::on_off}, {"proportional", Stand::Drive::Law::proportional}});
  v.text({.name = "sensor", .optional = true, .doc = "feedback: sensor of the length"}, d.sensor);
  units::optional_amount(v, "dead_band", "m", "feedback: largest error without a pulse",
                         d.dead_band);
  units::optional_amount(v, "gain", "1/m", "proportional: duty per error", d.gain);
}

template <class Visitor>
void fields(Visitor& v, Stand::Drive& d) {
  using Kind = Stand::Drive::Kind;
  v.choice({.name = "kind",
            .doc = "a duty (pwm), single pulses, a length by the model (feed-forward) or by a "
                   "sensor (feedback)"},
           d.kind,
           {{"none", Kind::none},
            {"pwm", Kind::pwm},
            {"pulses", Kind::pulses},
            {"feed-forward", Kind::feed_forward},
            {"feedback", Kind::feedback}});
  v.number({.name = "period",
            .unit = "s",
            .min = 1e-3,
            .max = 6,
            .optional = true,
            .doc = "period of pulses and laws, a multiple of 0.1 ms"},
           d.period);
  units::optional_share(v, "duty", "pwm: duty of the inlet", d.duty);
  robot::points(v, "duties",
                {.name = "duty", .unit = "1", .min = 0, .max = 1, .why = "a share of the period"},
                "pwm: duty over time, in steps", d.duties);
  v.list({.name = "pulses", .optional = true, .doc = "pulses: single openings of a valve"},
         d.pulses, [](auto& g, Stand::Drive::Pulse& p) {
           units::amount(g, "at", "s", "time of the electrical edge", p.at);
           units::amount(g, "open", "s", "duration of the pulse", p.open);
           g.flag({.name = "exhaust", .optional = true, .doc = "true: the exhaust, not the inlet"},
                  p.exhaust);
         });
  law_fields(v, d);
}

template <class Visitor>
void start_fields(Visitor& v, Stand& e) {
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 0,
            .max = 2e6,
            .least = 1e3,
            .why = "air of a muscle, no vacuum",
            .optional = true,
            .doc = "pressure of the air at the start"},
           e.start_pressure);
  robot::size(v, "length", "m", 1e-4, "a muscle that can be seen",
              "length at the start; 0: where the load is in balance", e.start_length);
  v.number({.name = "displacement",
            .unit = "m",
            .optional = true,
            .doc = "shift from there with the same air, positive downwards"},
           e.displacement);
}

template <class Visitor>
void fields(Visitor& v, Stand::Sweep& s) {
  const auto share = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "1", .min = 0, .max = 1, .doc = doc}, value);
  };
  share("from", "first duty", s.from);
  share("to", "last duty", s.to);
  v.number({.name = "step",
            .unit = "1",
            .min = 0,
            .max = 1,
            .least = 1e-4,
            .why = "each step is a run of its own",
            .doc = "difference between two duties"},
           s.step);
}

template <class Visitor>
void fields(Visitor& v, Stand::Measured& m) {
  robot::size(v, "period", "s", 1e-4, "a tick",
              "time between rows of measured.csv; 0: that of the log", m.period);
  units::optional_amount(v, "from", "s", "time of the first row", m.from);
}

// Visits the keys that describe an experiment's stand; title, seed, air and log are keys of every
// experiment.
template <class Visitor>
void fields(Visitor& v, Stand& s) {
  v.number({.name = "duration", .unit = "s", .min = 1e-3, .max = 1e5, .doc = "duration of the run"},
           s.duration);
  v.number({.name = "step",
            .unit = "s",
            .min = 1e-6,
            .max = 1e-2,
            .optional = true,
            .doc = "longest time step"},
           s.step);
  v.number({.name = "accuracy",
            .unit = "1",
            .min = 1e-12,
            .max = 1e-3,
            .optional = true,
            .doc = "error of an oscillation per radian, which shortens the steps"},
           s.accuracy);
  robot::fields(v, static_cast<robot::Stand&>(s));
  v.group({.name = "start", .optional = true, .doc = "state at time 0"},
          [&](auto& g) { start_fields(g, s); });
  v.group({.name = "drive", .optional = true, .doc = "drive of the valves"},
          [&](auto& g) { fields(g, s.drive); });
  v.group({.name = "sweep", .optional = true, .doc = "sweep of the duty, one run per duty"},
          [&](auto& g) { fields(g, s.sweep); });
  v.group({.name = "measured", .optional = true, .doc = "readings of the sensors in measured.csv"},
          [&](auto& g) { fields(g, s.measured); });
}

}  // namespace sinew::experiment
