// design/life_method.cpp - `sinew design life`: cycles and time until muscles fail, as a range.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/life.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/origin.h"
#include "sinew/design/methods.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/units/quantity.h"

namespace sinew::design {

namespace {

using LifeBounds = actuator::Bounds;
using actuator::Life;

// Published numbers of tests of muscles, whose contraction and pressure are not given with them;
// and the ratio of latex to silicone.
constexpr double clamped_under = 18000, swaged_over = 120e6, latex_to_silicone = 24;

// The life that is used, and what it rests on.
struct Evidence {
  Life life;
  std::vector<std::string> sources;
  bool is_of_file = false;
};

Evidence evidence_of(const LifeSettings& s, const experiment::Experiment& file,
                     const actuator::Actuator& a) {
  if (s.made == "clamped")
    return {
        {.contraction = 0.2, .cycles_under = clamped_under},
        {"clamped or looped ends: failed in under 18,000 cycles (summed up by Woods et al. 2012)"}};
  if (s.made == "swaged")
    return {
        {.contraction = 0.2, .cycles_over = actuator::life_from_failures(0, swaged_over).least},
        {"swaged ends: tested for over 120 million cycles without a failure (Woods et al. 2012); "
         "the mean of such muscles is over 32.5 million with 95 %, if it was one muscle"}};
  if (!actuator::has_life(a.life))
    config::fail({s.actuator, 0, 0}, "life", "nothing",
                 "bounds of the cycles of its muscles, or the kind of their ends",
                 "made=clamped or made=swaged");
  Evidence out{.life = a.life, .is_of_file = true};
  for (const char* key : {"cycles_over", "cycles_under", "exponent", "factor"})
    if (const config::Origin* o =
            config::find_origin(file.origins, "actuator." + a.name + ".life." + key);
        o && !o->source.empty())
      out.sources.push_back(fmt::format("{}: {}", key, o->source));
  return out;
}

// Adds a range: unknown bounds stay unknown; without any the value is left out.
void add(Result& out, const std::string& key, const std::string& name, const std::string& unit,
         LifeBounds bounds, const std::string& note) {
  Value v{.key = key, .name = name, .unit = unit, .note = note};
  v.number = Value::unknown;
  if (unit == "s") v.shown_in = "h";
  if (bounds.least > 0) v.low = bounds.least;
  if (std::isfinite(bounds.most)) v.high = bounds.most;
  out.values.push_back(v);
}

// Cycles over the contraction, by both bounds.
Table table_of(const Life& life, double pressure) {
  Table out{"contractions",
            "Cycles of one muscle over its contraction",
            {{"contraction", "contraction"}, {"cycles_from", "from"}, {"cycles_to", "to"}},
            {}};
  for (int percent = 5; percent <= 30; percent += 5) {
    const LifeBounds b = actuator::cycles_of_life(life, 0.01 * percent, pressure);
    out.rows.push_back({0.01 * percent, b.least > 0 ? b.least : Value::unknown,
                        std::isfinite(b.most) ? b.most : Value::unknown});
  }
  return out;
}

// The probability that no muscle has failed, over time.
report::Plot survival_plot(LifeBounds life, double per_second, int muscles) {
  report::Plot out{.name = "survival",
                   .title = "Probability that no muscle has failed",
                   .x = {"time", "h", 0},
                   .y = {"probability", "-", 0, 1}};
  const double last = std::isfinite(life.most) ? life.most : life.least;
  if (!(last > 0)) return out;
  report::Curve least{.label = "at least"}, most{.label = "at most"};
  for (int i = 0; i <= 100; ++i) {
    const double cycles = 3 * last / muscles * i / 100;
    const LifeBounds b = actuator::survival(life, muscles, cycles);
    for (report::Curve* c : {&least, &most}) c->xs.push_back(cycles / per_second / 3600);
    least.ys.push_back(b.least), most.ys.push_back(b.most);
  }
  if (life.least > 0) out.curves.push_back(least);
  if (std::isfinite(life.most)) out.curves.push_back(most);
  return out;
}

}  // namespace

Result design(const LifeSettings& s) {
  const auto file = experiment::load_machine_file(s.actuator).experiment;
  const config::SettingValues values(s, file.air.atmosphere);
  const actuator::Actuator& a =
      config::named(file.actuators, s.name, "name", "actuator", s.actuator);
  Evidence evidence = evidence_of(s, file, a);
  if (s.silicone) {
    evidence.life.factor_least /= latex_to_silicone, evidence.life.factor_most /= latex_to_silicone;
    evidence.sources.emplace_back(
        "silicone in place of latex: latex lasts 24 times as many cycles (Klute and Hannaford "
        "1998)");
  }
  if (!evidence.is_of_file && !s.pressure.empty())
    config::refuse_setting("pressure", "a pressure with made=" + s.made,
                           "none: that of the published tests is unknown");
  const double contraction = values.of(s.contraction);
  const double pressure = values.given(s.pressure).value_or(Value::unknown);
  const double frequency = values.of(s.cycles), duty = values.of(s.duty);
  // Published tests state no contraction, so that theirs are not scaled.
  const double of_law = evidence.is_of_file ? contraction : evidence.life.contraction;
  const LifeBounds one = actuator::cycles_of_life(evidence.life, of_law, pressure);
  const LifeBounds time = actuator::time_of_life(one, frequency, duty);
  const double n = s.muscles;

  Result out{.method = "life",
             .title = fmt::format("life of {} muscle{} `{}` that contract{} by {:.3g} %", s.muscles,
                                  s.muscles > 1 ? "s" : "", a.name, s.muscles > 1 ? "" : "s",
                                  100 * contraction)};
  add(out, "cycles", "cycles of one muscle", "1", one, "mean until it fails");
  add(out, "time_s", "time of one muscle", "s", time, "mean, as the robot is used");
  add(out, "first_failure_s", "time to the first failure", "s", {time.least / n, time.most / n},
      s.muscles > 1 ? fmt::format("mean, of {} muscles", s.muscles) : "mean");
  if (const auto duration = values.given(s.duration)) {
    const LifeBounds b = actuator::survival(one, n, *duration * frequency * duty);
    const bool known = one.least > 0 || std::isfinite(one.most);
    out.values.push_back({"survival", "probability that none fails", Value::unknown, "1",
                          known && one.least > 0 ? b.least : Value::unknown,
                          known && std::isfinite(one.most) ? b.most : Value::unknown,
                          "within " + units::format_quantity(*duration, "s", "h", 4)});
  }
  if (evidence.is_of_file) out.tables = {table_of(evidence.life, pressure)};
  if (report::Plot plot = survival_plot(one, frequency * duty, s.muscles); !plot.curves.empty())
    out.plots = {std::move(plot)};
  for (const std::string& source : evidence.sources) out.notes.push_back(source);
  out.notes.emplace_back(
      "a range without an end is not known on that side; no value within it is more likely");
  if (!evidence.is_of_file)
    out.notes.emplace_back("the contraction of these tests is not published: it is not scaled");
  out.unseen = {
      "Wear: failures are taken to come at a constant rate, so that an old muscle is as "
      "good as a new one.",
      "Faults of making, heat, a mesh that rubs on an edge, pressures above the tested ones."};
  return out;
}

}  // namespace sinew::design
