// Values by --set, one per line, over a shipped walk. A refusal has an error message; an accepted
// value is written to a resolved.toml that is accepted too and is written again unchanged.
#include "sinew/config/compose.h"
#include "sinew/experiment/experiment.h"
#include "tests/fuzz/law.h"
#include "tests/places.h"

namespace sinew::fuzz {
namespace {

const std::string& file() {
  static const std::string path = sinew::test::source_dir() + "/experiments/walk-test-1.toml";
  return path;
}

void apply_lines(config::Node& root, std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    config::apply_set(root, lines.substr(0, end));
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
}

}  // namespace

void set(std::string_view input) {
  static const config::Node walk = config::compose(file());
  config::Node root = walk;
  std::string text;
  try {
    apply_lines(root, input);
    text = experiment::resolved(experiment::load(root, file()), "0");
  } catch (const config::Error& error) {
    law(!error.problems().empty(), "a refusal says what is wrong");
    for (const config::Problem& p : error.problems())
      law(!p.expected.empty() && config::to_text(p).find('\n') == std::string::npos,
          "one line a problem: " + config::to_text(p));
    return;
  }
  try {
    const config::Node again = config::parse_text(text, file());
    law(experiment::resolved(experiment::load(again, file()), "0") == text,
        "resolved.toml resolves to itself:\n" + text);
  } catch (const config::Error& error) {
    law(false, std::string("resolved.toml is taken: ") + error.what());
  }
}

}  // namespace sinew::fuzz
