// run/simulation/course.h - a run as somebody sees it who learns: an action every so often, and
// after it an observation.
//
//   const Course course({.actions = {{.setting = "control.angle.hip", .offset = 0.2}},
//                        .sights = {{.channel = "/joint/hip/angle", .middle = 4.9, .scale = 0.5}},
//                        .measures = {"/true/trolley/position"}},
//                       example);
//   Simulation leg(experiment);
//   course.begin(leg);
//   while (!leg.ended()) {
//     course.step(leg, action);
//     course.look(leg, seen, measured);
//   }
//
// An action has a number a from -1 to 1 for each setting that it moves, which is then at
//
//   (the plan's + offset a) factor^a          so that 0 is the plan itself, to the last bit
//
// in each of the gait controller's periods anew. An observation has a number for each sight,
// (reading - middle)/scale; a measure is a reading as it is. The plan's own settings are learnt
// once, from a run of the plan.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

// Holds what an action changes, what is seen of it, and what a reward needs.
struct Task {
  struct Action {
    std::string setting;  // "control.stiffness.hip"
    double offset = 0;    // in the setting's SI unit
    double factor = 1;    // above 0 [-]
  };
  struct Sight {
    std::string channel;           // "/joint/hip/angle"
    double middle = 0, scale = 1;  // in the channel's unit
  };

  std::vector<Action> actions;
  std::vector<Sight> sights;
  // Channels that a reward needs; "plan:KEY" is what the plan has of the setting of an action.
  std::vector<std::string> measures;
  double begin = 0.6;    // before it the plan goes alone [s]
  double period = 0.05;  // of a step [s]
};

class Course {
 public:
  // `example` is a simulation at its start of the experiment that is meant; it is run to its plan's
  // end. Throws std::invalid_argument for settings and channels that there are not, and for times
  // that are no multiples of the gait controller's period; std::runtime_error where the plan itself
  // fails.
  Course(const Task& task, Simulation& example);

  // How many numbers an action, what is seen, and the measures have.
  std::size_t actions() const { return ways_.size(); }
  std::size_t sights() const { return seen_.size(); }
  std::size_t measures() const { return measured_.size(); }
  double period() const { return static_cast<double>(step_) * signals::tick_seconds; }  // [s]

  // Runs a simulation that stands at its start up to where the course begins.
  void begin(Simulation& s) const noexcept { s.advance_to(begin_); }

  // Runs on by a step, or to the plan's end. `action` has a finite number for each action; what is
  // beyond -1 and 1 is cut.
  void step(Simulation& s, std::span<const double> action) const;

  // Tells what is seen now: a number for each sight, and one for each measure.
  void look(Simulation& s, std::span<double> seen, std::span<double> measured) const noexcept;

 private:
  struct Way {
    std::size_t setting = 0;
    double offset = 0, logarithm = 0;
  };
  struct Seen {
    double middle = 0, scale = 1;
  };
  struct Measured {
    bool of_plan = false;
    std::size_t place = 0;  // among the readings, or the ways
  };
  static constexpr std::size_t most_channels = 1024;

  std::size_t rows() const noexcept { return ways_.empty() ? 1 : plan_.size() / ways_.size(); }
  void measure(const Simulation& s, const std::string& name);
  void check_times(const Simulation& s, const Task& task) const;
  void learn_plan(Simulation& s);

  signals::Tick begin_, step_, control_;  // control_: the gait controller's period
  std::vector<Way> ways_;
  std::vector<Seen> seen_;
  std::vector<std::size_t> channels_;  // of the sights, then of the measures
  std::vector<Measured> measured_;
  std::vector<double> plan_;  // [period][way], from begin_ on
};

}  // namespace sinew::run
