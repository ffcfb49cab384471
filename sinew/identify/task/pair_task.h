// identify/task/pair_task.h - `sinew identify pair`: a sealed antagonistic pair that is moved, from
// effort, position and pressures over time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/pair/pair.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct PairSettings {
  std::string rigs;
  HeldOut hold_out;
  std::string window = "20 ms", model;
  WishTexts wishes;
  std::string joint = "joint", base;
};

template <class Visitor>
void fields(Visitor& v, PairSettings& s) {
  v.method({"pair",
            "stiffness, dry friction, losses and trapped air of an antagonistic pair that is "
            "sealed and moved by hand or motor"});
  v.text(
      Setting{"rigs", "A,A,B: the rig of each file; recordings of one have its sensors in common"}
          .at_commas(),
      s.rigs);
  v.hold_out(Setting{"hold_out",
                     "\"7 s..14 s\" or \"7 s..\": times of each file, or a FILE, that score the "
                     "laws and are not fitted"}
                 .repeated(),
             s.hold_out);
  v.quantity({"window", "of the parabolas that give velocity and acceleration", "s",
              config::above_zero(10, "of a few samples")},
             s.window);
  v.choice({"model", "only this law"}, s.model, pair_models());
  fields(v, s.wishes);
  v.text(Setting{"joint", "its name in the robot's file that is written"}.in_python("joint_name"),
         s.joint);
  v.file({"base", "robot whose joint it is, named in the file that is written"}, s.base);
}

// Holds what was found, with the robot's file.
struct PairFound {
  PairResult result;
  std::string joint, base, source;

  // The robot's file, as it would stand at `out`. Throws config::Error, and Refusal for a slide.
  std::string file(const std::string& out) const;
};

// Returns whether the text is a range of times, "7 s..14 s", rather than a file's name.
bool is_time_range(std::string_view text);

// Throws config::Error and Refusal.
PairFound find_pair(const std::vector<Source>& sources, const PairSettings& settings);

// Returns the report with stiffness, sensors and trapped air, as `--json` prints it.
Json to_json(const PairFound& found);

}  // namespace sinew::identify
