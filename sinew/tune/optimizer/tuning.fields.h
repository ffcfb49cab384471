// tune/optimizer/tuning.fields.h - keys of a tuning's file.
#pragma once

#include "sinew/tune/optimizer/tuning.h"
#include "sinew/units/field.h"

namespace sinew::tune {

template <class Visitor>
void fields(Visitor& v, Case& one) {
  v.text({.name = "name", .doc = "as tables call it"}, one.name);
  v.text({.name = "experiment", .optional = true, .doc = "another file, relative to this one"},
         one.experiment);
  v.texts({.name = "set", .optional = true, .doc = "key=value, in this case alone"}, one.sets);
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
  v.texts({.name = "maximize", .optional = true, .doc = "key of summary.json, or key [unit]"},
          f.maximize);
  v.texts({.name = "minimize", .optional = true, .doc = "the same"}, f.minimize);
  v.texts({.name = "where", .optional = true, .doc = "key < value unit: what must hold"}, f.where);
  v.choice({.name = "over", .optional = true, .doc = "what of a candidate's runs is its goal"},
           f.over, {{"mean", Goals::Over::mean}, {"worst", Goals::Over::worst}});
  v.number({.name = "hold",
            .unit = "1",
            .min = 0.01,
            .max = 1,
            .why = "a share of the runs",
            .optional = true,
            .doc = "of a candidate's runs in which all of `where` must hold"},
           f.hold);
  v.texts({.name = "report", .optional = true, .doc = "more figures for the tables"}, f.report);
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
             .doc = "candidates of a generation; 0: as many as suit the ranges"},
            f.population);
  v.integer({.name = "generations", .min = 1, .max = 100000, .optional = true, .doc = "at most"},
            f.generations);
  v.integer({.name = "tuner_seed", .min = 0, .optional = true, .doc = "other candidates"},
            f.tuner_seed);
  v.number({.name = "step",
            .unit = "1",
            .min = 0.001,
            .max = 1,
            .optional = true,
            .doc = "cmaes: first step, a share of each range"},
           f.step);
}

template <class Visitor>
void fields(Visitor& v, TuningFile& f) {
  v.text({.name = "title", .doc = "of the study"}, f.title);
  v.text({.name = "reproduces", .optional = true, .doc = "section and figures"}, f.reproduces);
  v.text({.name = "experiment", .doc = "file of the experiment, relative to this one"},
         f.experiment);
  v.texts({.name = "set", .optional = true, .doc = "key=value, for every run"}, f.set);
  // The key is not called `range`, which is the range of a number elsewhere.
  v.texts({.name = "tune", .doc = "KEY=from:to unit [log|whole]"}, f.tune);
  goal_fields(v, f);
  method_fields(v, f);
  v.integer({.name = "seeds",
             .min = 0,
             .max = 10000,
             .optional = true,
             .doc = "runs of a candidate with other noise; 0: the experiment's own"},
            f.seeds);
  v.texts({.name = "spread", .optional = true, .doc = "like tune: what is not known closely"},
          f.spread);
  v.integer({.name = "draws",
             .min = 0,
             .max = 10000,
             .optional = true,
             .doc = "points of the spread at which a candidate is run"},
            f.draws);
  v.integer({.name = "spread_seed", .min = 0, .optional = true, .doc = "other draws"},
            f.spread_seed);
  v.list({.name = "case", .optional = true, .doc = "circumstances of each candidate"}, f.cases,
         [](auto& each, Case& one) { fields(each, one); });
  v.flag({.name = "allow_unreachable", .optional = true, .doc = "as sinew run's"},
         f.allow_unreachable);
}

}  // namespace sinew::tune
