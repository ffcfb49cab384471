// experiment/stand.fields.h - keys of an experiment on a test stand.
#pragma once

#include <string_view>

#include "sinew/experiment/stand.h"
#include "sinew/robot/stand.fields.h"
#include "sinew/units/field.h"

namespace sinew::experiment {

template <class Visitor>
void law_fields(Visitor& v, Stand::Drive& d) {
  robot::amount(v, "desired", "m", 0, "feed-forward, feedback: length", d.desired);
  robot::points(
      v, "lengths",
      {.name = "length", .unit = "m", .min = 0, .why = "no muscle is shorter than nothing"},
      "feed-forward, feedback: desired over time", d.lengths);
  robot::amount(v, "believed_load", "N", 0, "feed-forward: what hangs on the element",
                d.believed_load);
  v.choice(
      {.name = "law", .optional = true, .doc = "feedback"}, d.law,
      {{"on-off", Stand::Drive::Law::on_off}, {"proportional", Stand::Drive::Law::proportional}});
  v.text({.name = "sensor", .optional = true, .doc = "feedback: of the length"}, d.sensor);
  robot::amount(v, "dead_band", "m", 0, "feedback: error without a pulse", d.dead_band);
  robot::amount(v, "gain", "1/m", 0, "proportional: duty per error", d.gain);
}

template <class Visitor>
void fields(Visitor& v, Stand::Drive& d) {
  using Kind = Stand::Drive::Kind;
  v.choice({.name = "kind", .doc = "what opens and shuts the valves"}, d.kind,
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
            .doc = "of pulses and laws, a multiple of 0.1 ms"},
           d.period);
  v.number({.name = "duty", .unit = "1", .min = 0, .max = 1, .optional = true, .doc = "pwm"},
           d.duty);
  robot::points(v, "duties",
                {.name = "duty", .unit = "1", .min = 0, .max = 1, .why = "a share of the period"},
                "pwm: from an instant on", d.duties);
  v.list({.name = "pulses", .optional = true, .doc = "single ones"}, d.pulses,
         [](auto& g, Stand::Drive::Pulse& p) {
           g.number({.name = "at", .unit = "s", .min = 0, .doc = "edge of the coil"}, p.at);
           g.number({.name = "open", .unit = "s", .min = 0, .doc = "how long"}, p.open);
           g.flag({.name = "exhaust", .optional = true, .doc = "of the exhaust, not the inlet"},
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
            .doc = "of the air"},
           e.start_pressure);
  robot::size(v, "length", "m", 1e-4, "a muscle that can be seen", "0: where the load hangs",
              e.start_length);
  v.number({.name = "displacement",
            .unit = "m",
            .optional = true,
            .doc = "from there with the same air, down > 0"},
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
            .doc = "between them"},
           s.step);
}

template <class Visitor>
void fields(Visitor& v, Stand::Measured& m) {
  robot::size(v, "period", "s", 1e-4, "a tick", "between rows of measured.csv; 0: that of the log",
              m.period);
  robot::amount(v, "from", "s", 0, "the first row", m.from);
}

// Visits the keys that describe an experiment's stand; title, seed, air and log are keys of every
// experiment.
template <class Visitor>
void fields(Visitor& v, Stand& s) {
  v.number({.name = "duration", .unit = "s", .min = 1e-3, .max = 1e5, .doc = "of the run"},
           s.duration);
  v.number({.name = "step",
            .unit = "s",
            .min = 1e-6,
            .max = 1e-2,
            .optional = true,
            .doc = "between committed nodes"},
           s.step);
  v.number({.name = "accuracy",
            .unit = "1",
            .min = 1e-12,
            .max = 1e-3,
            .optional = true,
            .doc = "of a swing, per radian: shorter pieces between nodes"},
           s.accuracy);
  robot::fields(v, static_cast<robot::Stand&>(s));
  v.group({.name = "start", .optional = true, .doc = "at time 0"},
          [&](auto& g) { start_fields(g, s); });
  v.group({.name = "drive", .optional = true, .doc = "of the valves"},
          [&](auto& g) { fields(g, s.drive); });
  v.group({.name = "sweep", .optional = true, .doc = "each duty on a stand of its own"},
          [&](auto& g) { fields(g, s.sweep); });
  v.group({.name = "measured", .optional = true, .doc = "what the sensors leave as CSV"},
          [&](auto& g) { fields(g, s.measured); });
}

}  // namespace sinew::experiment
