// The same four steps with three kinds of valves, the distance walked on half a litre of air, and
// the cost of a leak.
//
//   what_air_costs [SHARE]     SHARE is the folder that has experiments/: the sources, or
//                              <prefix>/share/sinew
#include <cstdio>
#include <exception>
#include <string>

#include "sinew/tune/study.h"

namespace {

using namespace sinew;

void compare_plumbing(const std::string& experiments) {
  std::printf("experiment             way [m]  passiveness  air per step [g]\n");
  for (const char* name : {"walk-test-1", "walk-3-way", "walk-with-regulators"}) {
    const tune::RunResult result = tune::run_once(experiments + name + ".toml", {});
    const double* passiveness = result.summary.find("passiveness");
    std::printf("%-20s %9.2f ", name, *result.summary.find("trolley.distance_m"));
    if (passiveness)
      std::printf("%12.3f", *passiveness);
    else
      std::printf("%12s", "-");  // a regulator is never shut, nor open
    std::printf("%18.3f\n", 1e3 * *result.summary.find("air_used_per_step_kg"));
  }
}

void empty_a_tank(const std::string& file) {
  const analysis::Summary found = tune::run_once(file, {}).summary;
  std::printf("\nhalf a litre: %.0f steps, %.1f m in %.0f s\n", *found.find("supply.full_steps"),
              *found.find("supply.full_distance_m"), *found.find("supply.full_time_s"));
}

// Many runs in parallel on two cores give a table with a row for each.
void try_leaks(const std::string& file) {
  const tune::Sweep leaks =
      tune::sweep_of({.experiment = file,
                      .vary = {"muscle.knee_flexor.leak.area=0,0.01,0.1 mm2"},
                      .report = {"trolley.distance_m [in]", "air_used_per_step_kg [g]"}});
  std::printf("\nleak [mm2]  way [in]  air per step [g]\n");
  for (const tune::Row& row : tune::sweep(leaks, {.threads = 2}))
    std::printf("%10s %9.1f %17.3f  %s\n", row.cells[0].c_str(), std::stod(row.cells[1]),
                std::stod(row.cells[2]), row.cells[3].c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  const std::string experiments = share + "/experiments/";
  try {
    compare_plumbing(experiments);
    empty_a_tank(experiments + "endurance.toml");
    try_leaks(experiments + "walk-test-1.toml");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
