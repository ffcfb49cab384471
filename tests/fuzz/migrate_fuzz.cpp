// An older TOML file that is migrated, by a history of the harness's own, is current: it can be
// read, and a second migration changes nothing. A refusal has an error message.
#include "sinew/config/migrate.h"

#include "tests/fuzz/law.h"

namespace sinew::fuzz {
namespace {

const config::Changes& history() {
  static const config::Changes all{
      .kinds = {{"robot", 3}, {"valves", 1}},
      .keys = {{.kind = "robot", .format = 2, .from = "muscle.*.delay", .to = "opening_delay"},
               {.kind = "robot", .format = 2, .from = "a", .to = "b"},
               {.kind = "robot", .format = 3, .from = "*.opening", .to = "opening.delay"},
               {.kind = "robot", .format = 3, .from = "b", .to = "a"},
               {.kind = "robot", .format = 3, .from = "gone", .why = "nothing"}}};
  return all;
}

void law_of_places(std::string_view text) {
  std::size_t before = 0;
  for (const config::KeyPlace& place : config::key_places(text)) {
    law(before <= place.begin && place.begin <= place.end && place.end <= text.size(),
        "places of keys rise, and are in the text");
    before = place.end;
  }
}

}  // namespace

void migrate(std::string_view input) {
  config::Migrated done;
  try {
    done = config::migrated(input, "a.toml", history());
  } catch (const config::Error& error) {
    for (const config::Problem& p : error.problems())
      law(!p.found.empty() && !p.expected.empty() &&
              config::to_text(p).find('\n') == std::string::npos,
          "one line a problem: " + config::to_text(p));
    return law(!error.problems().empty(), "a refusal says what is wrong");
  }
  law_of_places(input);
  law_of_places(done.text);
  law(done.edits.empty() == (done.text == input), "every change is told:\n" + done.text);
  try {
    const config::Migrated again = config::migrated(done.text, "a.toml", history());
    law(again.edits.empty() && again.kind == done.kind && again.from == done.to,
        "what was migrated is of today:\n" + done.text);
  } catch (const config::Error& error) {
    law(false, std::string("what was migrated can be read: ") + error.what() + "\n" + done.text);
  }
}

}  // namespace sinew::fuzz
