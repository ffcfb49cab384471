#include "sinew/run/card/speed.h"

#include <chrono>
#include <stdexcept>
#include <vector>

#include "sinew/run/card/on_card.h"
#include "sinew/run/card/plan_table.h"
#include "sinew/run/setup/machine_setup.h"

namespace sinew::run {
namespace {

// Returns walks of an experiment with the seeds from 1 on. They record nothing, and end before this
// tick.
std::vector<Walk> walks_of(const experiment::Experiment& experiment, const Controllers& controllers,
                           const PlanTable& plan, std::size_t count, signals::Tick last) {
  const SingleBoard board{controllers.boards().each().front(), controllers.scan().period};
  plant::Setup setup = planar_setup(experiment);
  std::vector<Walk> out;
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    setup.seed = i + 1;
    out.emplace_back(plant::FlatLeg(setup), board, Walk::Timing{last, last, last});
    out.back().set_plan(
        0, {nullptr, static_cast<std::int64_t>(plan.commands().size()), plan.vents_at()});
  }
  return out;
}

}  // namespace

double runs_per_second(Card& card, const experiment::Experiment& experiment) {
  const Controllers controllers(experiment, nullptr);
  const signals::Tick last = experiment::last_tick(experiment);
  const PlanTable plan(experiment, controllers);
  const auto batched = [&](std::vector<Walk>& walks) {
    return Batched{.walks = walks, .commands = plan.commands()};
  };
  std::vector<Walk> empty = walks_of(experiment, controllers, plan, 1, 0);
  card.launch(batched(empty));  // compiles the program

  std::vector<Walk> walks = walks_of(experiment, controllers, plan, card.runs(), last);
  std::vector<Walk> first(walks.begin(), walks.begin() + 1);
  const auto begin = std::chrono::steady_clock::now();
  card.launch(batched(walks));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;

  launch_on_processor(batched(first));
  if (walks.front().status() != first.front().status() ||
      walks.front().leg().nodes() != first.front().leg().nodes())
    throw std::runtime_error(
        "found another end of a run on the graphics card than on the processor; expected the same; "
        "use the processor (device cpu)");
  return static_cast<double>(walks.size()) / took.count();
}

}  // namespace sinew::run
