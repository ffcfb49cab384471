// analysis/reported.fields.h - the keys of [[reported]].
#pragma once

#include "sinew/analysis/reported.h"
#include "sinew/units/complain.h"
#include "sinew/units/field.h"

namespace sinew::analysis {

template <class Visitor>
void fields(Visitor& v, Reported& r, double atmosphere) {
  v.text({.name = "key", .doc = "of summary.json"}, r.key);
  v.text({.name = "value", .doc = "as reported"}, r.value);
  v.texts({.name = "accept", .optional = true, .doc = "lowest and highest that agrees"}, r.accept);
  v.text({.name = "source", .doc = "where it is reported"}, r.source);

  if (const auto m = mistake_in_accept(r, atmosphere))
    units::complain(v, "accept", m->found, m->expected, m->try_this);
}

}  // namespace sinew::analysis
