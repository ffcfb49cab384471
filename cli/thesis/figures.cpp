// cli/thesis/figures.cpp - the program that `sinew figures --thesis` becomes
// (cli/figures.cpp). It is a program of its own, so that sinew is built and walks without the
// figures of the thesis.
//
//   thesis-figures ROOT OUT FORCE MUST_DRAW JSON QUIET [PICTURE…]   words that sinew has checked
#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string_view>

#include "cli/terminal.h"
#include "sinew/run/folder/figure_files.h"
#include "thesis/figures/thesis.h"

namespace sinew::cli {
namespace {

report::Gallery made(const std::string& root, bool quiet) {
  const thesis::Sources sources = thesis::sources(root);
  std::atomic<std::int64_t> done{0};
  const ProgressBar bar(done, thesis::steps(), {.each = 1, .unit = "steps"}, quiet);
  return thesis::gallery(sources, done);
}

void draw(std::span<char*> words) {
  const auto is = [&](std::size_t i) { return std::string_view(words[i]) == "yes"; };
  const bool json = is(4), quiet = is(5);
  run::FigureFiles files{.pictures = {}, .must_draw = is(3), .force = is(2)};
  for (const std::string_view word : words.subspan(6))
    files.pictures.push_back(report::picture_of(word).value());

  const report::Gallery gallery = made(words[0], quiet);
  const std::string index = run::write_figures(words[1], gallery, files, Messages(quiet).notices());
  if (json)
    fmt::print("{}", index);
  else
    fmt::print("{}", thesis::text_of(gallery));
}

}  // namespace
}  // namespace sinew::cli

int main(int argc, char** argv) {
  using namespace sinew;
  try {
    if (argc < 7) throw std::runtime_error("thesis-figures: a part of sinew figures --thesis");
    cli::draw(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return 0;
    cli::error("stdout: cannot write the result; make room or choose another place");
  } catch (const std::exception& e) {
    std::fflush(stdout);
    cli::error(e.what());
  }
  return 1;
}
