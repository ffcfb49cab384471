// tune/study.fields.h - keys of studies/*.toml.
#pragma once

#include "sinew/config/shown_units.h"
#include "sinew/tune/study.h"
#include "sinew/units/field.h"

namespace sinew::tune {

template <class Visitor>
void fields(Visitor& v, Study& s) {
  v.text({.name = "title", .doc = "of the study"}, s.title);
  v.text({.name = "reproduces", .optional = true, .doc = "section and figures"}, s.reproduces);
  v.text({.name = "experiment", .doc = "file of the experiment, relative to this one"},
         s.experiment);
  v.texts({.name = "set", .optional = true, .doc = "key=value, for every run"}, s.set);
  v.texts({.name = "vary", .optional = true, .doc = "KEY=a,b,c unit or KEY=from:to:n unit"},
          s.vary);
  v.texts({.name = "range", .optional = true, .doc = "KEY=from:to unit [log|whole], sampled"},
          s.range);
  v.choice({.name = "sample", .optional = true, .doc = "how points lie between the ranges' ends"},
           s.sample,
           {{"sobol", Sample::Kind::sobol},
            {"latin", Sample::Kind::latin},
            {"random", Sample::Kind::random}});
  v.integer({.name = "points", .min = 0, .max = 1000000, .optional = true, .doc = "of the sample"},
            s.points);
  v.integer({.name = "sample_seed", .min = 0, .optional = true, .doc = "of the sample's points"},
            s.sample_seed);
  v.integer({.name = "seeds", .min = 0, .max = 10000, .optional = true, .doc = "runs per point"},
            s.seeds);
  v.text({.name = "largest", .optional = true, .doc = "like vary: the key that is searched"},
         s.largest);
  v.texts({.name = "where", .optional = true, .doc = "key < value: what must hold"}, s.where);
  v.integer({.name = "halvings",
             .min = 0,
             .max = 50,
             .optional = true,
             .doc = "of the interval that the search finds"},
            s.halvings);
  v.texts({.name = "report", .optional = true, .doc = "keys of summary.json: key [unit]"},
          s.report);
  v.text({.name = "units",
          .optional = true,
          .doc = "of figures that name none: si, thesis, metric, or metric,length=cm"},
         s.units);
  config::report_wrong_units(v, s.units);
  v.flag({.name = "allow_unreachable", .optional = true, .doc = "as sinew run's"},
         s.allow_unreachable);
}

}  // namespace sinew::tune
