// tune/study.fields.h - keys of studies/*.toml.
#pragma once

#include "sinew/config/shown_units.h"
#include "sinew/tune/study.h"
#include "sinew/units/field.h"

namespace sinew::tune {

// Visits the keys that a study and a tuning share.
template <class Visitor, class File>
void common_fields(Visitor& v, File& f) {
  v.text({.name = "title", .doc = "title of the study"}, f.title);
  v.text({.name = "reproduces", .optional = true, .doc = "section and figures of the thesis"},
         f.reproduces);
  v.text({.name = "experiment", .doc = "file of the experiment, relative to this file"},
         f.experiment);
  v.texts({.name = "set", .optional = true, .doc = "KEY=VALUE for every run"}, f.set);
}
template <class Visitor, class File>
void reach_field(Visitor& v, File& f) {
  v.flag({.name = "allow_unreachable",
          .optional = true,
          .doc = "true: also run foot paths out of reach, like sinew run's option"},
         f.allow_unreachable);
}

template <class Visitor>
void fields(Visitor& v, Study& s) {
  common_fields(v, s);
  v.texts({.name = "vary", .optional = true, .doc = "grid: KEY=a,b,c unit or KEY=from:to:n unit"},
          s.vary);
  v.texts({.name = "range", .optional = true, .doc = "sampled range: KEY=from:to unit [log|whole]"},
          s.range);
  v.choice({.name = "sample", .optional = true, .doc = "distribution of the points in the ranges"},
           s.sample,
           {{"sobol", Sample::Kind::sobol},
            {"latin", Sample::Kind::latin},
            {"random", Sample::Kind::random}});
  v.integer({.name = "points",
             .min = 0,
             .max = 1000000,
             .optional = true,
             .doc = "number of points of the sample"},
            s.points);
  v.integer({.name = "sample_seed", .min = 0, .optional = true, .doc = "seed of the sample"},
            s.sample_seed);
  v.integer({.name = "seeds",
             .min = 0,
             .max = 10000,
             .optional = true,
             .doc = "runs per point with different noise; 0: one, with the experiment's seed"},
            s.seeds);
  v.text({.name = "largest",
          .optional = true,
          .doc = "key whose largest valid value is searched, like vary"},
         s.largest);
  v.texts({.name = "where", .optional = true, .doc = "conditions on results: KEY < VALUE"},
          s.where);
  v.integer({.name = "halvings",
             .min = 0,
             .max = 50,
             .optional = true,
             .doc = "number of times that the search halves its interval"},
            s.halvings);
  v.texts({.name = "report",
           .optional = true,
           .doc = "results in the tables: KEY [unit], of summary.json"},
          s.report);
  v.text({.name = "units",
          .optional = true,
          .doc = "units of results without one: si, thesis, metric, or metric,length=cm"},
         s.units);
  config::report_wrong_units(v, s.units);
  reach_field(v, s);
}

}  // namespace sinew::tune
