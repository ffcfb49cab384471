// From a CSV of measured forces to a robot with such muscles: their law, its best gain, and the
// heaviest forearm that it moves.
//
//   from_csv_to_robot [SHARE]     SHARE is the folder that has robots/: the sources, or
//                                 <prefix>/share/sinew; run it in this lesson's folder
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "sinew/identify/task/methods.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/tune/study.h"

namespace {

using namespace sinew;
namespace fs = std::filesystem;

const std::string csv = "../../data/martens_boblan_2017/DMSP-10-250_force_map.csv";

// The columns of the file have other names, and a force map does not contain the rest length.
std::string actuator_file() {
  const identify::Source map{
      .path = csv,
      .names = {{"pressure", "P_gauge_Pa"}, {"length", "L_m"}, {"force", "F_N"}},
      .units = {{"P_gauge_Pa", "Pa gauge"}, {"L_m", "m"}, {"F_N", "N"}}};
  const identify::StaticFound found =
      identify::find({map}, identify::StaticSettings{.rest_length = "250 mm"});

  const identify::Fit& law = found.result.report.best();
  std::printf("%zu points: %s, to %.2f %% of the largest force, %.2f %% of what it did not see\n",
              found.result.report.rows.size(), law.model.c_str(), law.fit.rmse_percent,
              law.cross_validated->rmse_percent);
  for (const identify::Estimate& p : law.parameters)
    std::printf("  %-20s %10.4g%s\n", p.name.c_str(), p.value,
                p.unit == "1" ? "" : (" " + p.unit).c_str());
  return found.file();
}

// Returns the gain with the smallest tracking error, as text of the table.
std::string best_gain(const std::string& experiment) {
  const std::string tracking = "joints.elbow.tracking_rms_rad [deg]";
  const tune::Sweep gains =
      tune::sweep_of({.experiment = experiment,
                      .vary = {"joint.elbow.angle_gain=0.04:0.16:7 %/count"},
                      .report = {tracking, "passiveness", "air_used_kg [g]"}});
  const std::vector<tune::Row> rows = tune::sweep(gains, {.threads = 2});
  std::printf("\ngain [%%/count]  tracking [deg]  passiveness  air [g]\n");
  for (const tune::Row& row : rows)
    std::printf("%14s %15.2f %12.3f %8.3f\n", row.cells[0].c_str(), std::stod(row.cells[1]),
                std::stod(row.cells[2]), std::stod(row.cells[3]));
  return std::ranges::min(rows, {}, [](const auto& row) { return std::stod(row.cells[1]); })
      .cells[0];
}

// Finds the heaviest forearm that it moves with a tracking error below five degrees.
double heaviest(const std::string& experiment, const std::string& gain) {
  tune::Study question{.experiment = experiment};
  question.set = {"joint.elbow.angle_gain=" + gain + " %/count"};
  question.largest = "link.forearm.mass=0.5:4:8 kg";
  question.where = {"joints.elbow.tracking_rms_rad < 5 deg"};
  question.report = {"passiveness"};
  const std::vector<tune::Row> rows = tune::sweep(tune::sweep_of(question), {.threads = 2});
  return std::stod(rows.front().cells[0]);
}

void build(const std::string& share, const fs::path& folder) {
  for (const char* file : {"robot.toml", "experiment.toml"}) fs::copy(file, folder / file);
  fs::copy(share + "/robots/leg/valves.toml", folder / "valves.toml");
  std::ofstream(folder / "muscle.toml") << actuator_file();

  const std::string experiment = folder / "experiment.toml";
  const std::string gain = best_gain(experiment);
  std::printf("\nwith %s %%/count it moves a forearm of up to %.2f kg within 5 deg\n", gain.c_str(),
              heaviest(experiment, gain));

  // Stored, so that its page can be opened.
  const auto kept = run::run_and_store({.experiment = experiment,
                                        .folder = folder / "run",
                                        .sets = {"joint.elbow.angle_gain=" + gain + " %/count"}});
  std::printf("a run of %.1f s: the elbow moves by %.1f deg, peak tension %.0f N\n", kept.duration,
              *kept.summary.find("joints.elbow.excursion_rad") * 57.29577951308232,
              *kept.summary.find("muscles.flexor.peak_tension_N"));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  std::string folder = (fs::temp_directory_path() / "from-csv-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 1;
  int code = 0;
  try {
    build(share, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  fs::remove_all(folder);
  return code;
}
