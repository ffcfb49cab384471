// An out.dat that is read has ascending times; written as such a log it is read back unchanged.
#include <algorithm>

#include "tests/fuzz/law.h"
#include "tests/places.h"
#include "thesis/out_dat/out_dat.h"

namespace sinew::fuzz {
namespace {

const experiment::Experiment& walk() {
  static const experiment::Experiment e =
      experiment::load(sinew::test::source_dir() + "/experiments/walk-test-1.toml");
  return e;
}

}  // namespace

void out(std::string_view input) {
  std::string text;
  try {
    const signals::Table table = thesis::parse_out_dat(input, "out.dat", walk());
    law(!table.series.empty(), "a log that is taken has samples");
    for (const signals::Series& s : table.series) {
      law(s.time_ns.front() >= 0 && std::ranges::is_sorted(s.time_ns, std::less_equal<>{}),
          "times ascend: " + s.topic.name);
      law(s.columns[0].size() == s.time_ns.size(), "a value for each time: " + s.topic.name);
    }
    text = thesis::write_out_dat(table, walk());
  } catch (const config::Error& error) {
    return law(!error.problems().empty(), "a refusal says what is wrong");
  }
  try {
    const signals::Table again = thesis::parse_out_dat(text, "written.dat", walk());
    law(thesis::write_out_dat(again, walk()) == text, "it is written the same again:\n" + text);
  } catch (const config::Error& error) {
    law(false, std::string("what is written can be read: ") + error.what() + "\n" + text);
  }
}

}  // namespace sinew::fuzz
