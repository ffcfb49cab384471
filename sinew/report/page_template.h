// report/page_template.h - the page that web/ is bundled into, by the build.
#pragma once

#include <string_view>

namespace sinew::report {

// Empty where the program was built without npm.
std::string_view page_template();

}  // namespace sinew::report
