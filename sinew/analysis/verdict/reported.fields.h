// analysis/verdict/reported.fields.h - the keys of [[reported]].
#pragma once

#include "sinew/analysis/verdict/reported.h"
#include "sinew/units/report_conflict.h"

namespace sinew::analysis {

template <class Visitor>
void fields(Visitor& v, Reported& r, double atmosphere) {
  config::fields(v, r);
  if (const auto m = mistake_in_band(r, atmosphere))
    units::report_conflict(v, r.accept.empty() ? "wording" : "accept", m->found, m->expected,
                           m->try_this);
}

}  // namespace sinew::analysis
