// config/reported.h - a figure that a source reports, as an experiment's [[reported]] says it.
// Experiments carry it, the analysis judges by it (analysis/reported.h).
#pragma once

#include <string>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::config {

struct Reported {
  std::string key;                  // of summary.json, "trolley.distance_m"
  std::string value;                // as reported, free text that ends with the unit
  std::vector<std::string> accept;  // lowest and highest that agrees; empty: not judged
  std::string source;
  std::string because;  // why ours is known to differ; empty: it should agree
};

template <class Visitor>
void fields(Visitor& v, Reported& r) {
  v.text({.name = "key", .doc = "of summary.json"}, r.key);
  v.text({.name = "value", .doc = "as reported"}, r.value);
  v.texts({.name = "accept", .optional = true, .doc = "lowest and highest that agrees"}, r.accept);
  v.text({.name = "source", .doc = "where it is reported"}, r.source);
  v.text({.name = "because", .optional = true, .doc = "why ours is known to differ"}, r.because);
}

}  // namespace sinew::config
