// Four steps of the thesis's leg: runs them, stores the run in a folder, and reads its numbers.
//
//   first_walk [SHARE]     SHARE is the folder that has experiments/: the sources, or
//                          <prefix>/share/sinew
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "sinew/analysis/summary.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/compose.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/run_storage.h"

namespace {

using namespace sinew;

void print(const analysis::Summary& summary, const char* key) {
  const double* value = summary.find(key);
  std::printf("  %-36s %.4g\n", key, value ? *value : 0);
}

// All figures can be computed again from the log.
bool same_from_the_log(const std::filesystem::path& folder, const analysis::Summary& first) {
  const run::RunFiles kept = run::run_files(folder);
  const analysis::Machine machine = analysis::read_machine(config::compose(kept.resolved.string()));
  const analysis::Summary again = analysis::summarize(log::read(kept.log), machine);
  return analysis::to_json(again) == analysis::to_json(first);
}

void walk(const std::string& experiment, const std::filesystem::path& folder) {
  const auto kept = run::run_and_store({.experiment = experiment, .folder = folder / "walk"});
  std::printf("%s\n", kept.machine.title.c_str());
  for (const char* key : {"trolley.distance_m", "trolley.mean_speed_m_per_s",
                          "joints.hip.passiveness", "joints.knee.passiveness", "air_used_kg"})
    print(kept.summary, key);

  std::printf("\nreported beside ours\n");
  for (const analysis::Verdict& verdict : analysis::compare(kept.summary, kept.machine.reported))
    std::printf("  %s: %s, ours %s: %s\n", verdict.key.c_str(), verdict.reported.c_str(),
                verdict.computed.c_str(),
                std::string(analysis::to_text(verdict.agreement)).c_str());

  const bool same = same_from_the_log(kept.folder, kept.summary);
  std::printf("\nfrom the log: %s\n", same ? "the same numbers" : "other numbers");

  // Overrides one value of a file.
  const auto easy = run::run_and_store(
      {.experiment = experiment, .folder = folder / "easy", .sets = {"trolley.drag=0 lbf"}});
  std::printf("\nwithout drag\n");
  print(easy.summary, "trolley.distance_m");
  print(easy.summary, "trolley.mean_speed_m_per_s");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  std::string folder = (std::filesystem::temp_directory_path() / "first-walk-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 1;
  int code = 0;
  try {
    walk(share + "/experiments/walk-test-1.toml", folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  std::filesystem::remove_all(folder);
  return code;
}
