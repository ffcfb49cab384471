// Law: a request of a page is only executed within its bounds, and is read back unchanged.
#include <fmt/format.h>

#include <stdexcept>

#include "sinew/experiment/experiment.h"
#include "sinew/live/request.h"
#include "sinew/run/controllers/steering.h"
#include "tests/fuzz/law.h"
#include "tests/places.h"

namespace sinew::fuzz {
namespace {

using Kind = live::Request::Kind;

const std::vector<gait::Setting>& settings() {
  static const std::vector<gait::Setting> all = gait::settings(
      experiment::load(sinew::test::source_dir() + "/experiments/walk-test-1.toml").plan);
  return all;
}

std::string written(const live::Request& r) {
  constexpr std::string_view kinds[] = {"pause", "resume",  "pace",       "stop",
                                        "set",   "release", "release all"};
  std::string text = fmt::format("{{\"do\":\"{}\"", kinds[static_cast<std::size_t>(r.kind)]);
  if (r.kind == Kind::set || r.kind == Kind::release)
    text += fmt::format(",\"key\":\"{}\"", settings()[r.setting].key);
  if (r.kind == Kind::set || r.kind == Kind::pace) text += fmt::format(",\"value\":{}", r.value);
  return text + "}";
}

}  // namespace

void live(std::string_view input) {
  live::Request r;
  try {
    r = live::read_request(input, settings());
  } catch (const std::invalid_argument& refusal) {
    const std::string_view words = refusal.what();
    return law(words.starts_with("found ") && words.find("; expected ") != words.npos,
               "a refusal says what was found and expected");
  }
  using run::Steering;
  law(r.setting < settings().size(), "a setting that there is");
  if (r.kind == Kind::set) law(r.value >= 0 && r.value <= gait::Setting::most, "a value in bounds");
  if (r.kind == Kind::pace)
    law(r.value == 0 || (r.value >= Steering::slowest && r.value <= Steering::fastest),
        "a pace in bounds");
  const live::Request again = live::read_request(written(r), settings());
  law(again.kind == r.kind && again.setting == r.setting && again.value == r.value,
      "it reads the same again: " + written(r));
}

}  // namespace sinew::fuzz
