// identify/sensor/transducer_text.h - what a force transducer does, for people and for programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sinew/identify/sensor/transducer.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

// What ways to wire the gages are called.
struct Arrangement {
  std::string_view name;
  Bridge::Arms arms;
};
inline constexpr Arrangement arrangements[] = {{"quarter", Bridge::Arms::quarter},
                                               {"half", Bridge::Arms::half},
                                               {"poisson", Bridge::Arms::poisson},
                                               {"bending", Bridge::Arms::bending}};

// Returns lines of text: strain, stress, safety, output, in SI and in the thesis's units; or in
// `shown` alone, where somebody asked for some.
std::string text_of(const Transducer& transducer, const units::ShownUnits* shown = nullptr);

// Returns a line for each arrangement: how far from the load the gages have to be for the wanted
// sensitivity [V/N].
std::string text_of_places(const Transducer& transducer, double wanted,
                           const units::ShownUnits* shown = nullptr);

// Returns both as JSON, in SI.
std::string json_of(const Transducer& transducer, std::optional<double> wanted);

}  // namespace sinew::identify
