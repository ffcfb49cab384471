// Gains that are read are numbers, and are read back unchanged.
#include <fmt/format.h>

#include <cmath>

#include "sinew/config/gains.h"
#include "tests/fuzz/law.h"

namespace sinew::fuzz {

void gain(std::string_view input) {
  std::vector<config::GainRow> rows;
  try {
    rows = config::parse_gains(input, "gain.dat");
  } catch (const config::Error& error) {
    return law_of_refusal(error, "gain.dat");
  }
  std::string text;
  for (const config::GainRow& row : rows) {
    law(std::isfinite(row.angle) && std::isfinite(row.stiffness) && std::isfinite(row.velocity),
        "gains are numbers");
    text += fmt::format("{}, {}, {}\n", row.angle, row.stiffness, row.velocity);
  }
  const std::vector<config::GainRow> again = config::parse_gains(text, "written.dat");
  law(again.size() == rows.size(), "rows are kept:\n" + text);
  for (std::size_t i = 0; i < rows.size(); ++i)
    law(again[i].angle == rows[i].angle && again[i].stiffness == rows[i].stiffness &&
            again[i].velocity == rows[i].velocity,
        "gains are kept:\n" + text);
}

}  // namespace sinew::fuzz
