// Samples and figures of a walk, another gait of the same leg, the best of several gains, and a
// muscle's law.
//
//   look_and_sweep [SHARE]     SHARE is the folder that has robots/ and experiments/: the sources,
//                              or <prefix>/share/sinew
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "sinew/actuator/operating_point.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/tune/study.h"

namespace {

using namespace sinew;

constexpr double degrees = 57.29577951308232;

void show(const experiment::Experiment& walk) {
  std::printf("%s: %.1f s, seed %d\n", walk.title.c_str(),
              experiment::last_tick(walk) * signals::tick_seconds, walk.seed);
  const config::Origin* hip = config::find_origin(walk.origins, "control.stiffness.hip");
  std::printf("the hip is as stiff as %.3f %s, %s in %s\n", config::quantity(hip->text, hip->unit),
              hip->unit.c_str(), hip->text.c_str(), hip->source.c_str());
}

// A run gives samples and figures.
void look(const experiment::Experiment& walk, const analysis::Machine& machine) {
  const signals::Table table = run::run(walk).table;
  const signals::Column& angle = *table.column("/joint/hip/angle");
  const auto [least, most] = std::minmax_element(angle.begin(), angle.end());
  std::printf("%zu topics; the hip moves from %.0f to %.0f deg\n", table.series.size(),
              *least * degrees, *most * degrees);

  const analysis::Summary summary = analysis::summarize(table, machine);
  std::printf("the trolley goes %.3f m\n", *summary.find("trolley.distance_m"));
  const auto verdicts = analysis::compare(summary, machine.reported);
  for (std::size_t i = 0; i < 3; ++i)
    std::printf("  %s: %s, reported %s: %s\n", verdicts[i].key.c_str(),
                verdicts[i].computed.c_str(), verdicts[i].reported.c_str(),
                std::string(to_text(verdicts[i].agreement)).c_str());
}

// A run that is controlled by the program: two continuations from the same time.
void hold(const experiment::Experiment& walk) {
  run::Simulation leg(walk), soft(walk);
  leg.advance_by(2.2);
  soft.restore(leg.save());
  soft.change("control.stiffness.hip", 1.0);
  for (const auto& [one, name] : {std::pair{&leg, "as planned"}, {&soft, "with a soft hip"}}) {
    one->advance_by(1.5);
    std::printf("%s: at %.1f s the trolley is at %.3f m\n", name, one->time(),
                one->read("/true/trolley/position"));
  }
}

// Many runs on two cores.
void sweep(const std::string& file) {
  const tune::Sweep gains = tune::sweep_of({.experiment = file,
                                            .vary = {"joint.hip.angle_gain=1e-4:2e-3:20 1/count"},
                                            .report = {"joints.hip.tracking_rms_rad [deg]"}});
  const std::vector<tune::Row> rows = tune::sweep(gains, {.threads = 2});
  const auto tracking = [](const tune::Row& row) { return std::stod(row.cells[1]); };
  const tune::Row best = std::ranges::min(rows, {}, tracking);
  std::printf("of %zu gains %.3f %%/count tracks best, to %.2f deg\n", rows.size(),
              100 * std::stod(best.cells[0]), tracking(best));
}

// Laws without a simulation.
void ask_the_law(const std::string& file) {
  const auto read = experiment::load_machine_file(file).experiment;
  const auto pull = [&](double length, double pressure) {
    return actuator::operating_point(read.actuators.front(), length, pressure,
                                     {read.air.atmosphere, read.air.polytropic_exponent})
        .tension;
  };
  for (const double length : {0.065, 0.075, 0.085})
    std::printf("at %.0f mm it pulls %.1f N at 2 bar and %.1f N at 4 bar\n", 1e3 * length,
                pull(length, 2e5), pull(length, 4e5));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  const std::string file = share + "/experiments/walk-test-1.toml";
  try {
    const config::Node root = config::compose(file);
    const experiment::Experiment walk = run::buildable(root, file);
    show(walk);
    look(walk, analysis::read_machine(root));
    hold(walk);
    sweep(share + "/experiments/leg-in-air.toml");
    ask_the_law(share + "/robots/leg/actuator.toml");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
