// python/binding/episode.cpp - what sinew.gym does in every step: an action becomes settings, the
// run goes on, what is seen becomes an observation. Here, and not in Python, since a step of 10 ms
// takes the computer some ten microseconds.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "python/binding/numbers.h"
#include "python/binding/simulation.h"

namespace sinew::python {

namespace {

using signals::Tick;
using Use = HeldSimulation::Use;
using HeldPointer = std::shared_ptr<HeldSimulation>;

// One number of the action: the setting is at (the plan's + offset a) exp(logarithm a).
struct Way {
  std::size_t setting = 0;
  double offset = 0, logarithm = 0;
};

// One number of the observation: (reading - middle) / scale.
struct Seen {
  double middle = 0, scale = 1;
};

// Course is what the episodes of a task share: how numbers are meant, and the plan's own settings
// in each period.
class Course {
 public:
  Course(HeldSimulation& example, const std::vector<std::string>& settings,
         const std::vector<double>& offsets, const std::vector<double>& factors,
         const std::vector<std::string>& sights, const std::vector<double>& middles,
         const std::vector<double>& scales, const std::vector<std::string>& measures, double begin,
         double period)
      : begin_(ticks(begin)), step_(ticks(period)) {
    const Use use(example);
    control_ = static_cast<Tick>(
        std::llround(use->experiment().plan.brain_period / signals::tick_seconds));
    if (step_ < control_ || step_ % control_ != 0)
      throw std::invalid_argument(
          fmt::format("period: found {} s; expected a multiple of the gait controller's {} s",
                      period, static_cast<double>(control_) * signals::tick_seconds));
    if (begin_ % control_ != 0)
      throw std::invalid_argument(
          fmt::format("begin: found {} s; expected a multiple of the gait controller's {} s", begin,
                      static_cast<double>(control_) * signals::tick_seconds));
    for (std::size_t i = 0; i < settings.size(); ++i)
      ways_.push_back({use->find_setting(settings[i]), offsets.at(i), std::log(factors.at(i))});
    for (std::size_t i = 0; i < sights.size(); ++i) {
      channels_.push_back(use->find(sights[i]));
      seen_.push_back({middles.at(i), scales.at(i)});
    }
    for (const std::string& name : measures) measure(*use, name);
    if (begin_ >= use->last())
      throw std::invalid_argument(
          fmt::format("begin: found {} s; expected less than the plan's {} s", begin,
                      static_cast<double>(use->last()) * signals::tick_seconds));
    learn_plan(*use);
  }

  Tick begin() const { return begin_; }
  std::size_t ways() const { return ways_.size(); }
  std::size_t sights() const { return seen_.size(); }
  std::size_t measures() const { return measured_.size(); }
  double period() const { return static_cast<double>(step_) * signals::tick_seconds; }

  // Runs on by a step; `action` has a number from -1 to 1 for each way, what is beyond is cut.
  void step(run::Simulation& s, const double* action) const {
    for (Tick passed = 0; passed < step_ && !s.ended(); passed += control_) {
      const auto row = static_cast<std::size_t>((s.tick() - begin_) / control_);
      if (row < rows())
        for (std::size_t i = 0; i < ways_.size(); ++i) {
          const double a = std::clamp(action[i], -1.0, 1.0);
          const double wanted = (plan_[row * ways_.size() + i] + ways_[i].offset * a) *
                                std::exp(ways_[i].logarithm * a);
          s.change(ways_[i].setting, std::clamp(wanted, 0.0, gait::Setting::most));
        }
      s.advance_to(s.tick() + control_);
    }
  }

  // `seen` has a number for each sight, `measured` for each measure.
  void look(run::Simulation& s, double* seen, double* measured) const {
    double readings[most_channels];
    s.read(channels_, {readings, channels_.size()});
    for (std::size_t i = 0; i < seen_.size(); ++i)
      seen[i] = (readings[i] - seen_[i].middle) / seen_[i].scale;
    const Tick periods = std::max<Tick>(0, (s.tick() - begin_) / control_ - 1);
    const std::size_t row = std::min(static_cast<std::size_t>(periods), rows() - 1);
    for (std::size_t i = 0; i < measured_.size(); ++i)
      measured[i] = measured_[i].of_plan ? plan_[row * ways_.size() + measured_[i].place]
                                         : readings[measured_[i].place];
  }

 private:
  static constexpr std::size_t most_channels = 1024;

  // A measure is a channel, or "plan:KEY": what the plan has of one of the settings.
  struct Measured {
    bool of_plan = false;
    std::size_t place = 0;  // among the readings, or the ways
  };

  std::size_t rows() const { return ways_.empty() ? 1 : plan_.size() / ways_.size(); }

  void measure(const run::Simulation& s, const std::string& name) {
    constexpr std::string_view of_plan = "plan:";
    if (!name.starts_with(of_plan)) {
      measured_.push_back({false, channels_.size()});
      channels_.push_back(s.find(name));
      return;
    }
    const std::size_t setting = s.find_setting(std::string_view(name).substr(of_plan.size()));
    const auto way = std::ranges::find(ways_, setting, &Way::setting);
    if (way == ways_.end())
      throw std::invalid_argument(fmt::format(
          "measures: found {}; expected the setting of one of the task's actions", name));
    measured_.push_back({true, static_cast<std::size_t>(way - ways_.begin())});
  }

  static Tick ticks(double seconds) {
    check_time(seconds);
    return static_cast<Tick>(std::llround(seconds / signals::tick_seconds));
  }

  // A period's settings are there once its first tick has passed.
  void learn_plan(run::Simulation& s) {
    if (channels_.size() > most_channels)
      throw std::invalid_argument(
          fmt::format("channels: found {}; expected {} at most", channels_.size(), most_channels));
    for (Tick t = begin_; t < s.last(); t += control_) {
      s.advance_to(t + 1);
      for (const Way& way : ways_) plan_.push_back(s.value_of(way.setting));
    }
    refuse_failed(s);
  }

  Tick begin_, step_, control_ = 100;
  std::vector<Way> ways_;
  std::vector<Seen> seen_;
  std::vector<std::size_t> channels_;  // of the sights, then of the measures
  std::vector<Measured> measured_;
  std::vector<double> plan_;  // [period][way], from begin_ on
};

void check_action(double number, std::size_t place) {
  if (!std::isfinite(number))
    throw std::invalid_argument(
        fmt::format("action: found {} in place {}; expected finite numbers", number, place));
}

// Episode is one run of a course.
class Episode {
 public:
  Episode(std::shared_ptr<Course> course, HeldPointer simulation)
      : course_(std::move(course)), simulation_(std::move(simulation)) {
    const Use use(*simulation_);
    if (use->tick() == 0) use->advance_to(course_->begin());
    refuse_failed(*use);
  }

  const HeldPointer& simulation() const { return simulation_; }
  const Course& course() const { return *course_; }

  void step(const double* action, double* seen, double* measured) {
    for (std::size_t i = 0; i < course_->ways(); ++i) check_action(action[i], i);
    const Use use(*simulation_);
    course_->step(*use, action);
    course_->look(*use, seen, measured);
    ended_ = use->ended();
    if (ended_) refuse_failed(*use);
  }
  void look(double* seen, double* measured) const {
    course_->look(*Use(*simulation_), seen, measured);
  }
  bool ended() const { return ended_; }

 private:
  std::shared_ptr<Course> course_;
  HeldPointer simulation_;
  bool ended_ = false;
};

py::ssize_t length(std::size_t n) { return static_cast<py::ssize_t>(n); }

py::tuple look(Episode& episode) {
  Numbers seen(length(episode.course().sights())), measured(length(episode.course().measures()));
  episode.look(seen.mutable_data(), measured.mutable_data());
  return py::make_tuple(seen, measured);
}

py::tuple step(Episode& episode, const py::object& given) {
  const Numbers action = numbers(given, "action");
  check_shape(action, {episode.course().ways()}, "action");
  Numbers seen(length(episode.course().sights())), measured(length(episode.course().measures()));
  episode.step(action.data(), seen.mutable_data(), measured.mutable_data());
  return py::make_tuple(seen, measured, episode.ended());
}

// Steps those that are not to be skipped; one that fails keeps none of the others from going on.
py::tuple step_all(const std::vector<std::shared_ptr<Episode>>& episodes, const py::object& given,
                   const py::array_t<bool>& skipped) {
  const Numbers actions = numbers(given, "actions");
  if (episodes.empty()) throw std::invalid_argument("episodes: found none; expected one at least");
  const Course& course = episodes[0]->course();
  for (const auto& episode : episodes)
    if (!episode || &episode->course() != &course)
      throw std::invalid_argument("episodes: found some of another course; expected one course");
  check_shape(actions, {episodes.size(), course.ways()}, "actions");
  check_shape(skipped, {episodes.size()}, "skipped");
  for (std::size_t i = 0; i < episodes.size() * course.ways(); ++i)
    check_action(actions.data()[i], i);
  Numbers seen({episodes.size(), course.sights()}), measured({episodes.size(), course.measures()});
  py::array_t<bool> ended(length(episodes.size())), failed(length(episodes.size()));
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    double* sights = seen.mutable_data() + i * course.sights();
    double* measures = measured.mutable_data() + i * course.measures();
    bool fails = false;
    try {
      if (!skipped.data()[i])
        episodes[i]->step(actions.data() + i * course.ways(), sights, measures);
    } catch (const RunError&) {
      fails = true;
    }
    if (fails || skipped.data()[i]) episodes[i]->look(sights, measures);
    failed.mutable_data()[i] = fails;
    ended.mutable_data()[i] = episodes[i]->ended();
  }
  return py::make_tuple(seen, measured, ended, failed);
}

}  // namespace

void bind_episode(py::module_& m) {
  py::class_<Course, std::shared_ptr<Course>>(m, "Course")
      .def(py::init<HeldSimulation&, const std::vector<std::string>&, const std::vector<double>&,
                    const std::vector<double>&, const std::vector<std::string>&,
                    const std::vector<double>&, const std::vector<double>&,
                    const std::vector<std::string>&, double, double>(),
           py::arg("example"), py::arg("settings"), py::arg("offsets"), py::arg("factors"),
           py::arg("sights"), py::arg("middles"), py::arg("scales"), py::arg("measures"),
           py::arg("begin"), py::arg("period"))
      .def_property_readonly("period", &Course::period);
  py::class_<Episode, std::shared_ptr<Episode>>(m, "Episode")
      .def(py::init<std::shared_ptr<Course>, HeldPointer>(), py::arg("course").none(false),
           py::arg("simulation").none(false))
      .def_property_readonly("simulation", &Episode::simulation)
      .def("look", &look)
      .def("step", &step, py::arg("action"));
  m.def("step_episodes", &step_all, py::arg("episodes"), py::arg("actions"), py::arg("skipped"));
}

}  // namespace sinew::python
