#include "sinew/identify/actuator/geometry_file.h"

#include "sinew/actuator/actuator.h"
#include "sinew/identify/fit/provenance.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

// Fills in what a braid leaves open, so that the file can be read: the mesh ends where its threads
// lie straight, and nothing is lost yet.
actuator::Actuator actuator_of(const actuator::Braid& braid, const std::string& name,
                               const std::string& source, const Report* report,
                               Provenance& provenance) {
  actuator::Actuator a;
  a.name = name;
  a.braid = braid;
  a.long_end = {.length = 0.93 * braid.thread_length, .stiffness = 87563.4, .damping = 122.6};
  a.short_end.stiffness = a.long_end.stiffness;
  a.short_end.damping = a.long_end.damping;

  const std::string path = "actuator." + name + ".";
  for (const char* key : {"thread_length", "turns"}) {
    const Estimate* found = nullptr;
    if (report)
      for (const Estimate& e : report->best().parameters)
        if (e.name == key) found = &e;
    if (found)
      provenance.fitted(path + "braid." + key, *found, source);
    else
      provenance.given(path + "braid." + key, source);
  }
  provenance.guessed(path + "long_end.length", "as the thesis's share of the thread's length");
  for (const char* end : {"long_end", "short_end"})
    for (const char* key : {"stiffness", "damping"})
      provenance.guessed(path + end + "." + key, "the thesis's actuator, appendix A");
  return a;
}

}  // namespace

std::string braid_file(const actuator::Braid& braid, const std::string& name,
                       const std::string& source, const Report* report) {
  Provenance provenance;
  const actuator::Actuator a = actuator_of(braid, name, source, report, provenance);
  return actuator_file(a, provenance);
}

Json describe(const actuator::Braid& braid) {
  return {{"thread_length_m", braid.thread_length},
          {"turns", braid.turns},
          {"shortest_length_m", actuator::shortest_length(braid)}};
}

}  // namespace sinew::identify
