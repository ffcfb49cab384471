// A table of valve instants that is accepted can be followed by a PWM, and is read back unchanged.
#include <fmt/format.h>

#include "sinew/config/valve_timing.h"
#include "tests/fuzz/law.h"

namespace sinew::fuzz {

void predict(std::string_view input) {
  using config::ValveTiming;
  ValveTiming timing;
  try {
    timing = config::parse_valve_timing(input, "predict.dat");
  } catch (const config::Error& error) {
    return law_of_refusal(error, "predict.dat");
  }
  std::string text;
  for (std::size_t duty = 0; duty < ValveTiming::rows; ++duty) {
    const int closing = timing.closing[duty], opening = timing.opening[duty];
    law(closing <= ValveTiming::never && opening <= ValveTiming::never, "instants of the period");
    law(duty == 0 || (closing >= timing.closing[duty - 1] && opening <= timing.opening[duty - 1]),
        "a larger duty never gives less");
    text += fmt::format("{},{},{}\n", duty, closing, opening);
  }
  const ValveTiming again = config::parse_valve_timing(text, "written.dat");
  law(again.closing == timing.closing && again.opening == timing.opening,
      "it reads the same again");
}

}  // namespace sinew::fuzz
