// Your own robot, described only in TOML: its values with their sources, its best gain, and how a
// wrong key is refused.
//
//   own_robot [SHARE]     SHARE is the folder that has experiments/: the sources, or
//                         <prefix>/share/sinew
#include <cstdio>
#include <exception>
#include <string>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/tune/sweep.h"

namespace {

using namespace sinew;

void show(const experiment::Experiment& lever, const char* key) {
  const config::Origin* origin = config::find_origin(lever.origins, key);
  std::printf("%s = %.6g %s, written %s\n  of %s, line %d: %s\n", key,
              config::quantity(origin->text, origin->unit), origin->unit.c_str(),
              origin->text.c_str(),
              origin->where.file.substr(origin->where.file.rfind('/') + 1).c_str(),
              origin->where.line, origin->source.c_str());
}

void try_gains(const std::string& file) {
  std::printf("\ngain [%%/count]  tracking [deg]  passiveness  air [g]\n");
  for (const char* gain : {"0.03", "0.06", "0.12", "0.24", "0.48"}) {
    const tune::RunResult result =
        tune::run_once(file, {std::string("joint.lever.angle_gain=") + gain + " %/count"});
    std::printf("%14s %15.2f %12.3f %8.3f\n", gain,
                *result.summary.find("joints.lever.tracking_rms_rad") * 57.29577951308232,
                *result.summary.find("passiveness"), 1e3 * *result.summary.find("air_used_kg"));
  }
}

// An error is reported before anything runs, with parts that a program can use.
void refuse(const std::string& file) {
  try {
    run::buildable(file, {"joint.lever.angle_gian=0.3 %/count"});
  } catch (const config::Error& error) {
    const config::Problem& problem = error.problems().front();
    std::printf("\nrefused: %s\n  found %s\n  try %s\n", problem.key.c_str(), problem.found.c_str(),
                problem.try_this.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  const std::string file = share + "/experiments/one-joint.toml";
  try {
    const experiment::Experiment lever = run::buildable(file);
    show(lever, "joint.lever.angle_gain");
    show(lever, "muscle.flexor.mount_length");
    try_gains(file);
    refuse(file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
