// python/binding/episode.cpp - steps of sinew.gym: sets the action, advances the run and reads the
// observation. In C++ rather than Python, as computing a step of 10 ms takes only some ten
// microseconds.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/binding/numbers.h"
#include "python/binding/simulation.h"
#include "sinew/run/simulation/episode.h"

namespace sinew::python {

namespace {

using Use = HeldSimulation::Use;
using HeldPointer = std::shared_ptr<HeldSimulation>;

using run::Episode;

// Makes the definition of episodes from Python's lists.
std::shared_ptr<Episode> make_episode(
    HeldSimulation& example, const std::vector<std::string>& settings,
    const std::vector<double>& offsets, const std::vector<double>& factors,
    const std::vector<std::string>& observations, const std::vector<double>& middles,
    const std::vector<double>& scales, const std::vector<std::string>& measures, double begin,
    double period) {
  run::Task task{.measures = measures, .begin = begin, .period = period};
  for (std::size_t i = 0; i < settings.size(); ++i)
    task.actions.push_back({settings[i], offsets.at(i), factors.at(i)});
  for (std::size_t i = 0; i < observations.size(); ++i)
    task.observations.push_back({observations[i], middles.at(i), scales.at(i)});
  const Use use(example);
  try {
    return std::make_shared<Episode>(task, *use);
  } catch (const std::runtime_error& failed) {
    throw RunError(failed.what());
  }
}

void check_action(double number, std::size_t place) {
  if (!std::isfinite(number))
    throw std::invalid_argument(
        fmt::format("action: found {} in place {}; expected finite numbers", number, place));
}

// One run of an episode.
class HeldEpisode {
 public:
  HeldEpisode(std::shared_ptr<Episode> definition, HeldPointer simulation)
      : definition_(std::move(definition)), simulation_(std::move(simulation)) {
    const Use use(*simulation_);
    if (use->tick() == 0) definition_->begin(*use);
    refuse_failed(*use);
  }

  const HeldPointer& simulation() const { return simulation_; }
  const Episode& definition() const { return *definition_; }

  void step(const double* action, double* observed, double* measured) {
    for (std::size_t i = 0; i < definition_->actions(); ++i) check_action(action[i], i);
    const Use use(*simulation_);
    definition_->step(*use, {action, definition_->actions()});
    read_into(*use, observed, measured);
    ended_ = use->ended();
    if (ended_) refuse_failed(*use);
  }
  void observe(double* observed, double* measured) const {
    read_into(*Use(*simulation_), observed, measured);
  }
  bool ended() const { return ended_; }

 private:
  void read_into(run::Simulation& s, double* observed, double* measured) const {
    definition_->observe(s, {observed, definition_->observations()},
                         {measured, definition_->measures()});
  }

  std::shared_ptr<Episode> definition_;
  HeldPointer simulation_;
  bool ended_ = false;
};

py::ssize_t length(std::size_t n) { return static_cast<py::ssize_t>(n); }

py::tuple observe(HeldEpisode& episode) {
  Numbers observed(length(episode.definition().observations())),
      measured(length(episode.definition().measures()));
  episode.observe(observed.mutable_data(), measured.mutable_data());
  return py::make_tuple(observed, measured);
}

py::tuple step(HeldEpisode& episode, const py::object& given) {
  const Numbers action = numbers(given, "action");
  check_shape(action, {episode.definition().actions()}, "action");
  Numbers observed(length(episode.definition().observations())),
      measured(length(episode.definition().measures()));
  episode.step(action.data(), observed.mutable_data(), measured.mutable_data());
  return py::make_tuple(observed, measured, episode.ended());
}

// Steps the episodes that are not skipped; a failed one does not stop the others.
py::tuple step_each(const std::vector<std::shared_ptr<HeldEpisode>>& episodes,
                    const py::object& given, const py::array_t<bool>& skipped) {
  const Numbers actions = numbers(given, "actions");
  if (episodes.empty()) throw std::invalid_argument("episodes: found none; expected one at least");
  const Episode& definition = episodes[0]->definition();
  for (const auto& episode : episodes)
    if (!episode || &episode->definition() != &definition)
      throw std::invalid_argument("episodes: found several definitions; expected one");
  check_shape(actions, {episodes.size(), definition.actions()}, "actions");
  check_shape(skipped, {episodes.size()}, "skipped");
  for (std::size_t i = 0; i < episodes.size() * definition.actions(); ++i)
    check_action(actions.data()[i], i);
  Numbers observed({episodes.size(), definition.observations()}),
      measured({episodes.size(), definition.measures()});
  py::array_t<bool> ended(length(episodes.size())), failed(length(episodes.size()));
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    double* observations = observed.mutable_data() + i * definition.observations();
    double* measures = measured.mutable_data() + i * definition.measures();
    bool fails = false;
    try {
      if (!skipped.data()[i])
        episodes[i]->step(actions.data() + i * definition.actions(), observations, measures);
    } catch (const RunError&) {
      fails = true;
    }
    if (fails || skipped.data()[i]) episodes[i]->observe(observations, measures);
    failed.mutable_data()[i] = fails;
    ended.mutable_data()[i] = episodes[i]->ended();
  }
  return py::make_tuple(observed, measured, ended, failed);
}

}  // namespace

void bind_episode(py::module_& m) {
  py::class_<Episode, std::shared_ptr<Episode>>(m, "EpisodeDefinition")
      .def(py::init(&make_episode), py::arg("example"), py::arg("settings"), py::arg("offsets"),
           py::arg("factors"), py::arg("observations"), py::arg("middles"), py::arg("scales"),
           py::arg("measures"), py::arg("begin"), py::arg("period"))
      .def_property_readonly("period", &Episode::period);
  py::class_<HeldEpisode, std::shared_ptr<HeldEpisode>>(m, "Episode")
      .def(py::init<std::shared_ptr<Episode>, HeldPointer>(), py::arg("definition").none(false),
           py::arg("simulation").none(false))
      .def_property_readonly("simulation", &HeldEpisode::simulation)
      .def("observe", &observe)
      .def("step", &step, py::arg("action"));
  m.def("step_episodes", &step_each, py::arg("episodes"), py::arg("actions"), py::arg("skipped"));
}

}  // namespace sinew::python
