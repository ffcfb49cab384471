// python/binding/episode.cpp - steps of sinew.gym: sets the action, advances the run and reads the
// observation. In C++ rather than Python, as computing a step of 10 ms takes only some ten
// microseconds.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/binding/numbers.h"
#include "python/binding/simulation.h"
#include "sinew/run/ensemble/episodes.h"
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

using HeldEpisodes = Guarded<run::Episodes>;

std::shared_ptr<HeldEpisodes> make_episodes(std::shared_ptr<Episode> definition,
                                            const py::object& experiment,
                                            const std::vector<std::string>& parameters,
                                            std::size_t count, int threads) {
  if (threads < 0)
    throw std::invalid_argument(fmt::format("threads: found {}; expected 0 or more", threads));
  const ExperimentPointer e = from_file(experiment, py::none());
  auto ensemble = std::make_shared<const run::Ensemble>(e->path, e->sets, parameters,
                                                        std::vector<std::string>{});
  return std::make_shared<HeldEpisodes>("episodes", std::move(definition), std::move(ensemble),
                                        count, threads);
}

// Begins the episodes of these places, each with its seed and its row of values.
void begin_each(HeldEpisodes& episodes, const std::vector<std::size_t>& places,
                const std::vector<int>& seeds, const py::object& given) {
  const HeldEpisodes::Use use(episodes);
  const Numbers values = numbers(given, "values");
  const std::size_t width = use->parameters();
  check_shape(values, {places.size(), width}, "values");
  for (std::size_t k = 0; k < places.size(); ++k)
    use->begin(places[k], seeds.at(k), {values.data() + k * width, width});
}

py::tuple step_each(HeldEpisodes& episodes, const py::object& given) {
  const HeldEpisodes::Use use(episodes);
  const Numbers actions = numbers(given, "actions");
  const Episode& definition = use->definition();
  const std::size_t count = use->count();
  check_shape(actions, {count, definition.actions()}, "actions");
  for (std::size_t i = 0; i < count * definition.actions(); ++i) check_action(actions.data()[i], i);
  Numbers observed({count, definition.observations()}), measured({count, definition.measures()});
  py::array_t<bool> ended(length(count)), failed(length(count));
  const run::Episodes::Results results{
      .observed = {observed.mutable_data(), count * definition.observations()},
      .measured = {measured.mutable_data(), count * definition.measures()},
      .ended = {ended.mutable_data(), count},
      .failed = {failed.mutable_data(), count}};
  {
    const std::span<const double> from(actions.data(), count * definition.actions());
    const py::gil_scoped_release others;
    use->step(from, results);
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
  py::class_<HeldEpisodes, std::shared_ptr<HeldEpisodes>>(m, "Episodes")
      .def(py::init(&make_episodes), py::arg("definition").none(false), py::arg("experiment"),
           py::arg("parameters"), py::arg("count"), py::arg("threads"))
      .def("begin", &begin_each, py::arg("places"), py::arg("seeds"), py::arg("values"))
      .def("step", &step_each, py::arg("actions"))
      .def(
          "cause",
          [](HeldEpisodes& episodes, std::size_t place) {
            return HeldEpisodes::Use(episodes)->cause(place);
          },
          py::arg("place"));
}

}  // namespace sinew::python
