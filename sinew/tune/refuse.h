// tune/refuse.h - errors about the settings of a study.
#pragma once

#include <string>
#include <string_view>

#include "sinew/config/diagnostics.h"

namespace sinew::tune {

// Throws config::Error about `text`, the value of `setting`, with what is expected and an example.
[[noreturn]] inline void refuse(std::string_view setting, std::string_view text,
                                std::string expected, std::string try_this = "") {
  config::fail({std::string(setting), 0, 0}, "", config::in_quotes(text), std::move(expected),
               std::move(try_this));
}

}  // namespace sinew::tune
