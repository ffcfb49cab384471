// tune/optimizer/tuning.fields.h - keys of a tuning's file.
#pragma once

#include "sinew/tune/optimizer/tuning.h"
#include "sinew/tune/study.fields.h"
#include "sinew/units/field.h"

namespace sinew::tune {

template <class Visitor>
void fields(Visitor& v, Case& one) {
  v.text({.name = "name", .doc = "name in tables"}, one.name);
  v.text(
      {.name = "experiment", .optional = true, .doc = "another experiment, relative to this file"},
      one.experiment);
  v.texts({.name = "set", .optional = true, .doc = "KEY=VALUE in this case only"}, one.sets);
  v.number({.name = "weight",
            .unit = "1",
            .min = 1e-6,
            .max = 1e6,
            .optional = true,
            .doc = "weight relative to the others"},
           one.weight);
}

template <class Visitor>
void goal_fields(Visitor& v, TuningFile& f) {
  v.texts({.name = "maximize", .optional = true, .doc = "goals: KEY [unit], of summary.json"},
          f.maximize);
  v.texts({.name = "minimize", .optional = true, .doc = "goals that are to be small"}, f.minimize);
  v.texts({.name = "where", .optional = true, .doc = "conditions on results: KEY < VALUE unit"},
          f.where);
  v.choice({.name = "over", .optional = true, .doc = "value of a goal over a candidate's runs"},
           f.over, {{"mean", Goals::Over::mean}, {"worst", Goals::Over::worst}});
  v.number({.name = "hold",
            .unit = "1",
            .min = 0.01,
            .max = 1,
            .why = "a share of the runs",
            .optional = true,
            .doc = "smallest share of a candidate's runs in which all of `where` hold"},
           f.hold);
  v.texts({.name = "report", .optional = true, .doc = "further results in the tables: KEY [unit]"},
          f.report);
}

template <class Visitor>
void method_fields(Visitor& v, TuningFile& f) {
  using Method = TuningFile::Method;
  v.choice({.name = "method",
            .optional = true,
            .doc = "automatic: cmaes for one goal, nsga2 for several"},
           f.method,
           {{"automatic", Method::automatic}, {"cmaes", Method::cmaes}, {"nsga2", Method::nsga2}});
  v.integer({.name = "population",
             .min = 0,
             .max = 10000,
             .optional = true,
             .doc = "candidates of a generation; 0: from the number of ranges"},
            f.population);
  v.integer({.name = "generations",
             .min = 1,
             .max = 100000,
             .optional = true,
             .doc = "largest number of generations"},
            f.generations);
  v.integer({.name = "tuner_seed", .min = 0, .optional = true, .doc = "seed of the candidates"},
            f.tuner_seed);
  v.number({.name = "step",
            .unit = "1",
            .min = 0.001,
            .max = 1,
            .optional = true,
            .doc = "cmaes: first step, as a share of each range"},
           f.step);
}

template <class Visitor>
void fields(Visitor& v, TuningFile& f) {
  common_fields(v, f);
  // The key is not called `range`, which is the range of a number elsewhere.
  v.texts({.name = "tune", .doc = "tuned range: KEY=from:to unit [log|whole]"}, f.tune);
  goal_fields(v, f);
  method_fields(v, f);
  v.integer({.name = "seeds",
             .min = 0,
             .max = 10000,
             .optional = true,
             .doc = "runs of a candidate with different noise; 0: one, with the experiment's seed"},
            f.seeds);
  v.texts({.name = "spread", .optional = true, .doc = "uncertain values, like tune"}, f.spread);
  v.integer({.name = "draws",
             .min = 0,
             .max = 10000,
             .optional = true,
             .doc = "number of points in the spread at which a candidate is run"},
            f.draws);
  v.integer({.name = "spread_seed", .min = 0, .optional = true, .doc = "seed of these points"},
            f.spread_seed);
  v.list({.name = "case", .optional = true, .doc = "cases in which every candidate is run"},
         f.cases, [](auto& each, Case& one) { fields(each, one); });
  reach_field(v, f);
}

}  // namespace sinew::tune
