// python/binding/episode.cpp - steps of sinew.gym: sets the action, advances the run and reads the
// observation. In C++ rather than Python, as computing a step of 10 ms takes only some ten
// microseconds.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/binding/numbers.h"
#include "python/binding/simulation.h"
#include "sinew/run/simulation/course.h"

namespace sinew::python {

namespace {

using Use = HeldSimulation::Use;
using HeldPointer = std::shared_ptr<HeldSimulation>;

using run::Course;

// Makes a course from Python's lists.
std::shared_ptr<Course> course_of(HeldSimulation& example, const std::vector<std::string>& settings,
                                  const std::vector<double>& offsets,
                                  const std::vector<double>& factors,
                                  const std::vector<std::string>& sights,
                                  const std::vector<double>& middles,
                                  const std::vector<double>& scales,
                                  const std::vector<std::string>& measures, double begin,
                                  double period) {
  run::Task task{.measures = measures, .begin = begin, .period = period};
  for (std::size_t i = 0; i < settings.size(); ++i)
    task.actions.push_back({settings[i], offsets.at(i), factors.at(i)});
  for (std::size_t i = 0; i < sights.size(); ++i)
    task.sights.push_back({sights[i], middles.at(i), scales.at(i)});
  const Use use(example);
  try {
    return std::make_shared<Course>(task, *use);
  } catch (const std::runtime_error& failed) {
    throw RunError(failed.what());
  }
}

void check_action(double number, std::size_t place) {
  if (!std::isfinite(number))
    throw std::invalid_argument(
        fmt::format("action: found {} in place {}; expected finite numbers", number, place));
}

// One run of a course.
class Episode {
 public:
  Episode(std::shared_ptr<Course> course, HeldPointer simulation)
      : course_(std::move(course)), simulation_(std::move(simulation)) {
    const Use use(*simulation_);
    if (use->tick() == 0) course_->begin(*use);
    refuse_failed(*use);
  }

  const HeldPointer& simulation() const { return simulation_; }
  const Course& course() const { return *course_; }

  void step(const double* action, double* seen, double* measured) {
    for (std::size_t i = 0; i < course_->actions(); ++i) check_action(action[i], i);
    const Use use(*simulation_);
    course_->step(*use, {action, course_->actions()});
    look_at(*use, seen, measured);
    ended_ = use->ended();
    if (ended_) refuse_failed(*use);
  }
  void look(double* seen, double* measured) const { look_at(*Use(*simulation_), seen, measured); }
  bool ended() const { return ended_; }

 private:
  void look_at(run::Simulation& s, double* seen, double* measured) const {
    course_->look(s, {seen, course_->sights()}, {measured, course_->measures()});
  }

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
  check_shape(action, {episode.course().actions()}, "action");
  Numbers seen(length(episode.course().sights())), measured(length(episode.course().measures()));
  episode.step(action.data(), seen.mutable_data(), measured.mutable_data());
  return py::make_tuple(seen, measured, episode.ended());
}

// Steps the episodes that are not skipped; a failed one does not stop the others.
py::tuple step_all(const std::vector<std::shared_ptr<Episode>>& episodes, const py::object& given,
                   const py::array_t<bool>& skipped) {
  const Numbers actions = numbers(given, "actions");
  if (episodes.empty()) throw std::invalid_argument("episodes: found none; expected one at least");
  const Course& course = episodes[0]->course();
  for (const auto& episode : episodes)
    if (!episode || &episode->course() != &course)
      throw std::invalid_argument("episodes: found some of another course; expected one course");
  check_shape(actions, {episodes.size(), course.actions()}, "actions");
  check_shape(skipped, {episodes.size()}, "skipped");
  for (std::size_t i = 0; i < episodes.size() * course.actions(); ++i)
    check_action(actions.data()[i], i);
  Numbers seen({episodes.size(), course.sights()}), measured({episodes.size(), course.measures()});
  py::array_t<bool> ended(length(episodes.size())), failed(length(episodes.size()));
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    double* sights = seen.mutable_data() + i * course.sights();
    double* measures = measured.mutable_data() + i * course.measures();
    bool fails = false;
    try {
      if (!skipped.data()[i])
        episodes[i]->step(actions.data() + i * course.actions(), sights, measures);
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
      .def(py::init(&course_of), py::arg("example"), py::arg("settings"), py::arg("offsets"),
           py::arg("factors"), py::arg("sights"), py::arg("middles"), py::arg("scales"),
           py::arg("measures"), py::arg("begin"), py::arg("period"))
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
