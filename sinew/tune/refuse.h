// tune/refuse.h - how a setting of a study is refused.
#pragma once

#include <string>
#include <string_view>

#include "sinew/config/diagnostics.h"

namespace sinew::tune {

// Throws config's error about `text`, which was given for `setting`: what is expected in its place,
// and an example to try.
[[noreturn]] inline void refuse(std::string_view setting, std::string_view text,
                                std::string expected, std::string try_this = "") {
  config::fail({std::string(setting), 0, 0}, "", config::in_quotes(text), std::move(expected),
               std::move(try_this));
}

}  // namespace sinew::tune
