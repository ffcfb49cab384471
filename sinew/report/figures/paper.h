// report/figures/paper.h - what a figure is printed on, as people say it: "84 mm", "9 pt".
#pragma once

#include <string>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// An empty text leaves what is usual. Throws config::Error that begins with width, height or font,
// for what is no length or no paper has.
Paper read_paper(const std::string& width, const std::string& height, const std::string& font);

}  // namespace sinew::report
