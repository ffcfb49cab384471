// report/page/page_template.h - the pages that web/ is bundled into, by the build.
#pragma once

#include <string_view>

namespace sinew::report {

// All are empty where the program was built without npm.
std::string_view page_template();        // of one run
std::string_view comparison_template();  // of several
std::string_view fit_template();         // of an identification
std::string_view study_template();       // of a sweep or a tuning, or of two
std::string_view run_list_template();    // of the runs in a folder

// Returns what makes a film of a run's page, to be run in it; empty as above.
std::string_view film_script();

}  // namespace sinew::report
