#include "cli/figures_thesis.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "cli/figures_runs.h"
#include "sinew/host/module.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

ExitCode draw_thesis(const ThesisFiguresRequest& request) {
  const run::FigureFiles files = files_of(request.formats, request.force);
  run::refuse_to_overwrite(std::filesystem::path(request.out) / "index.json", request.force);
  const std::string program = host::find_module("thesis-figures").string();
  if (program.empty())
    throw std::runtime_error(
        "sinew figures --thesis: found no program thesis-figures beside this one; expected it in "
        "lib/sinew; try: cmake --preset release && cmake --build --preset all");

  const auto flag = [](bool set) { return set ? "yes" : "no"; };
  std::vector<std::string> words{program,
                                 request.root,
                                 request.out,
                                 flag(request.force),
                                 flag(files.must_draw),
                                 flag(request.json),
                                 flag(request.quiet)};
  for (const report::Picture picture : files.pictures) words.emplace_back(report::ending(picture));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(stdout);
  execv(program.c_str(), arguments.data());
  throw std::runtime_error(program + ": " + std::strerror(errno));
}

}  // namespace sinew::cli
