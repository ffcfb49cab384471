// run/simulation/course.h - a run as an episode for learning: an action in each step, followed by
// an observation.
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
// An action has a number a from -1 to 1 for each setting that it changes, which is then set to
//
//   (value in the plan + offset a) factor^a          so that 0 is the plan itself, to the last bit
//
// in each period of the gait controller. An observation has the number (reading - middle)/scale for
// each sight; a measure is an unscaled reading. The settings of the plan are recorded once, from a
// run of the plan.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

// Definition of actions, observations and measures for a reward.
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
  // Channels that a reward needs; "plan:KEY" is the planned value of an action's setting.
  std::vector<std::string> measures;
  double begin = 0.6;    // start of the first step; the plan runs alone before it [s]
  double period = 0.05;  // duration of a step [s]
};

class Course {
 public:
  // `example` is a simulation of the experiment, at its start; it is run to the end of its plan.
  // Throws std::invalid_argument for unknown settings and channels, and for times that are not
  // multiples of the gait controller's period; std::runtime_error if the plan itself fails.
  Course(const Task& task, Simulation& example);

  // Return the number of values in an action, in an observation, and of the measures.
  std::size_t actions() const { return ways_.size(); }
  std::size_t sights() const { return seen_.size(); }
  std::size_t measures() const { return measured_.size(); }
  double period() const { return static_cast<double>(step_) * signals::tick_seconds; }  // [s]

  // Runs a simulation from its start to the start of the first step.
  void begin(Simulation& s) const noexcept { s.advance_to(begin_); }

  // Runs a step, or to the end of the plan. `action` has a finite number for each action, which is
  // limited to -1 ... 1.
  void step(Simulation& s, std::span<const double> action) const;

  // Writes the present observation, a number for each sight, and a number for each measure.
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
    std::size_t place = 0;  // index in the readings, or in ways_
  };
  static constexpr std::size_t most_channels = 1024;

  std::size_t rows() const noexcept { return ways_.empty() ? 1 : plan_.size() / ways_.size(); }
  void measure(const Simulation& s, const std::string& name);
  void check_times(const Simulation& s, const Task& task) const;
  void learn_plan(Simulation& s);

  signals::Tick begin_, step_, control_;  // control_: the gait controller's period
  std::vector<Way> ways_;
  std::vector<Seen> seen_;
  std::vector<std::size_t> channels_;  // channels of the sights, then those of the measures
  std::vector<Measured> measured_;
  std::vector<double> plan_;  // [period][way], from begin_ on
};

}  // namespace sinew::run
