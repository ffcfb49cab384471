// Your own muscle, from forces on a stand to a parameter file. The stand is simulated, and its
// muscle is known, so that the result can be checked.
//
//   characterise [SHARE]     SHARE is the folder that has robots/: the sources, or
//                            <prefix>/share/sinew; run it in this lesson's folder
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "sinew/actuator/operating_point.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/run/folder/run_storage.h"

namespace {

using namespace sinew;
namespace fs = std::filesystem;

// Returns length, force and pressure as recorded by hand at a stand; each row is an independent
// point, without a time.
identify::Measured measured_at(int psi, const fs::path& folder) {
  const auto kept =
      run::run_and_store({.experiment = "pressures.toml",
                          .folder = folder / std::to_string(psi),
                          .sets = {"charge.pressure=" + std::to_string(psi) + " psi gauge"},
                          .report = false});
  std::vector<identify::ColumnSpec> columns;
  for (const identify::ColumnSpec& column : identify::static_columns())
    if (column.name != "time") columns.push_back(column);
  return identify::read_measured({.path = kept.folder / "measured.csv"}, columns);
}

identify::Measured measure(const fs::path& folder) {
  identify::Measured all = measured_at(10, folder);
  for (int psi = 20; psi <= 100; psi += 10) {
    const identify::Measured more = measured_at(psi, folder);
    for (identify::Column& column : all.columns)
      column.values.insert(column.values.end(), more[column.name].begin(), more[column.name].end());
    all.lines.insert(all.lines.end(), more.lines.begin(), more.lines.end());
  }
  return all;
}

void show_models(const identify::Report& report) {
  std::printf("model                     fit [%%]  not seen [%%]\n");
  for (const identify::Fit& fit : report.fits)
    if (fit.refused.empty())
      std::printf("%-24s %8.2f %13.2f%s\n", fit.model.c_str(), fit.fit.rmse_percent,
                  fit.cross_validated->rmse_percent,
                  fit.model == report.best().model ? "  <- chosen" : "");
}

void compare(const std::string& found, const std::string& true_one) {
  const auto mine = experiment::load_machine_file(found).experiment;
  const auto stand = experiment::load_machine_file(true_one).experiment;
  std::printf("\nat 80 mm  found [N]  true [N]\n");
  for (int kPa = 100; kPa <= 600; kPa += 100) {
    const auto pull = [&](const experiment::Experiment& e) {
      return actuator::operating_point(e.actuators.front(), 0.08, 1e3 * kPa,
                                       {e.air.atmosphere, e.air.polytropic_exponent})
          .tension;
    };
    std::printf("%4d kPa %10.2f %9.2f\n", kPa, pull(mine), pull(stand));
  }
}

void characterise(const std::string& share, const fs::path& folder) {
  identify::StaticData data;
  identify::add_points(measure(folder), {}, data);
  const identify::StaticResult found = identify::identify_static(data, {});
  std::printf("%zu points; rest length %.1f mm, the longest\n", data.points.size(),
              1e3 * found.muscles.front().rest_length);
  show_models(found.report);

  const fs::path file = folder / "my-actuator.toml";
  std::ofstream(file) << identify::static_file(found, found.muscles[0], "bpa", "a stand of ours",
                                               "");
  compare(file, share + "/robots/stand/equations.toml");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  std::string folder = (fs::temp_directory_path() / "characterise-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 1;
  int code = 0;
  try {
    characterise(share, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  fs::remove_all(folder);
  return code;
}
