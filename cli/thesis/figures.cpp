// cli/thesis/figures.cpp - the program that `sinew figures --thesis` becomes
// (cli/figures_thesis.cpp). It is one of its own, so that sinew is built and walks without the
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
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/figure_files.h"
#include "thesis/figures/thesis.h"

namespace sinew::cli {
namespace {

using Is = report::Is;

std::string shown(int n) { return n > 0 ? std::to_string(n) : std::string(); }

// A row per figure with the number of statements of each verdict.
void print_figures(const report::Gallery& gallery) {
  using enum report::TextTable::Align;
  std::vector<std::string> titles{"figure", ""};
  for (const Is v : report::all_verdicts) titles.emplace_back(to_text(v));
  report::TextTable table(titles, {left, left, right, right, right, right, right});
  const auto row = [&](const std::string& name, const std::string& title, const report::Tally& t) {
    std::vector<std::string> cells{name, title};
    for (const Is v : report::all_verdicts) cells.push_back(shown(t.of(v)));
    table.add(std::move(cells));
  };
  for (const report::Exhibit& e : gallery.exhibits) {
    report::Tally t;
    count(t, e.claims);
    row(e.figure.name, e.figure.title, t);
  }
  row("", fmt::format("{} figures", gallery.exhibits.size()), tally(gallery));
  fmt::print("{}", table.text());
}

// A row per class.
void print_classes(const report::Gallery& gallery) {
  using enum report::TextTable::Align;
  const report::Tally all = tally(gallery);
  std::vector<std::string> titles{"class"};
  for (const Is v : report::all_verdicts) titles.emplace_back(to_text(v));
  report::TextTable table(titles, {left, right, right, right, right, right});
  for (const report::StatementClass c : report::all_classes) {
    if (all.of(c) == 0) continue;
    std::vector<std::string> cells{
        std::string(c == report::StatementClass::none ? "not compared" : to_text(c))};
    for (const Is v : report::all_verdicts) cells.push_back(shown(all.of(c, v)));
    table.add(std::move(cells));
  }
  fmt::print("\n{}", table.text());
}

void print(const report::Gallery& gallery) {
  print_figures(gallery);
  print_classes(gallery);
}

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
    print(gallery);
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
