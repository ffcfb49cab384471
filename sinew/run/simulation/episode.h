// run/simulation/episode.h - a run as an episode for learning: an action in each step, followed by
// an observation.
//
//   const Episode episode({.actions = {{.setting = "control.angle.hip", .offset = 0.2}},
//                         .observations = {{.channel = "/joint/hip/angle", .middle = 4.9,
//                                           .scale = 0.5}},
//                         .measures = {"/true/trolley/position"}},
//                        example);
//   Simulation leg(experiment);
//   episode.begin(leg);
//   while (!leg.ended()) {
//     episode.step(leg, action);
//     episode.observe(leg, observed, measured);
//   }
//
// An action has a number a from -1 to 1 for each setting that it changes, which is then set to
//
//   (value in the plan + offset a) factor^a          so that 0 is the plan itself, to the last bit
//
// in each period of the gait controller. An observation is (reading - middle)/scale of a channel; a
// measure is an unscaled reading. The settings of the plan are recorded once, from a run of the
// plan.
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
  struct Observation {
    std::string channel;           // "/joint/hip/angle"
    double middle = 0, scale = 1;  // in the channel's unit
  };

  std::vector<Action> actions;
  std::vector<Observation> observations;
  // Channels that a reward needs; "plan:KEY" is the planned value of an action's setting.
  std::vector<std::string> measures;
  double begin = 0.6;    // start of the first step; the plan runs alone before it [s]
  double period = 0.05;  // duration of a step [s]
};

class Episode {
 public:
  // `example` is a simulation of the experiment, at its start; it is run to the end of its plan.
  // Throws std::invalid_argument for unknown settings and channels, and for times that are not
  // multiples of the gait controller's period; std::runtime_error if the plan itself fails.
  Episode(const Task& task, Simulation& example);

  // Returns the same episode of an experiment that differs in numbers: with the plan of its own.
  // It begins with a simulation at its start, which is left unchanged. If that plan fails, its
  // settings stay afterwards. Throws std::invalid_argument as the constructor does.
  Episode of(const Simulation& other) const;

  // Return the number of values in an action, in an observation, and of the measures.
  std::size_t actions() const { return actions_.size(); }
  std::size_t observations() const { return scalings_.size(); }
  std::size_t measures() const { return measured_.size(); }
  double period() const { return static_cast<double>(step_) * signals::tick_seconds; }  // [s]

  // Runs a simulation from its start to the start of the first step.
  void begin(Simulation& s) const noexcept { s.advance_to(begin_); }

  // Runs a step, or to the end of the plan. `action` has a finite number for each action, which is
  // limited to -1 ... 1.
  void step(Simulation& s, std::span<const double> action) const;

  // The parts of these, for a loop of your own: the first step's start, and a step's length; a
  // step's part, at whose start act() sets the settings; whether observe() reads true values.
  signals::Tick first() const noexcept { return begin_; }
  signals::Tick length() const noexcept { return step_; }
  signals::Tick part() const noexcept { return control_; }
  void act(Simulation& s, std::span<const double> action) const;
  bool observes_truths(const Simulation& s) const { return s.is_true(channels_); }

  // Writes a number for each observation and a number for each measure.
  void observe(Simulation& s, std::span<double> observed,
               std::span<double> measured) const noexcept;

 private:
  struct Action {
    std::size_t setting = 0;
    double offset = 0, logarithm = 0;
  };
  struct Scaling {
    double middle = 0, scale = 1;
  };
  struct Measured {
    bool of_plan = false;
    std::size_t place = 0;  // index in the readings, or in actions_
  };
  static constexpr std::size_t most_channels = 1024;

  // Takes the task; the plan is missing.
  Episode(const Task& task, const Simulation& example);

  std::size_t rows() const noexcept {
    return actions_.empty() ? 1 : plan_.size() / actions_.size();
  }
  void measure(const Simulation& s, const std::string& name);
  void check_times(const Simulation& s, const Task& task) const;
  void record_plan(Simulation& s);
  void plan_alone(const experiment::Experiment& e);

  Task task_;
  signals::Tick begin_, step_, control_;  // control_: the gait controller's period
  std::vector<Action> actions_;
  std::vector<Scaling> scalings_;
  std::vector<std::size_t> channels_;  // channels of the observations, then those of the measures
  std::vector<Measured> measured_;
  std::vector<double> plan_;  // [period][way], from begin_ on
};

}  // namespace sinew::run
