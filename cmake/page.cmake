# Pages of web/, each bundled into one text by esbuild and compiled into sinew_report_page. If the npm packages
# are missing, the program is built without pages and reports this when a report is requested. The glob is
# evaluated in every build, so that the next build after tools/npm-ci.sh has the pages.

set(web ${PROJECT_SOURCE_DIR}/web)
file(GLOB web_packages CONFIGURE_DEPENDS ${web}/node_modules/.package-lock.json)
file(GLOB web_sources CONFIGURE_DEPENDS ${web}/src/*)
find_program(SINEW_NODE NAMES node nodejs)

if(SINEW_NODE AND web_packages)
  set(sinew_has_page ON)
  set(page_template ${CMAKE_CURRENT_BINARY_DIR}/page_template.cpp)
  add_custom_command(
    OUTPUT ${page_template}
    COMMAND ${SINEW_NODE} ${web}/build.mjs ${page_template}
    DEPENDS ${web_sources} ${web_packages} ${web}/build.mjs
    COMMENT "Bundling the page of web/"
    VERBATIM)
  # Each page is one string literal, longer than the 65536 characters that the standard guarantees. GCC and
  # Clang accept it, but Clang warns.
  set_source_files_properties(${page_template} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
else()
  set(sinew_has_page OFF)
  set(page_template ${CMAKE_CURRENT_BINARY_DIR}/no_page_template.cpp)
  file(CONFIGURE OUTPUT ${page_template} CONTENT
"#include \"sinew/report/page/page.h\"
std::string_view sinew::report::page_template() { return {}; }
std::string_view sinew::report::comparison_template() { return {}; }
std::string_view sinew::report::fit_template() { return {}; }
std::string_view sinew::report::design_template() { return {}; }
std::string_view sinew::report::study_template() { return {}; }
std::string_view sinew::report::run_list_template() { return {}; }
")
  message(STATUS "web/: built without reports; tools/npm-ci.sh web brings them")
endif()
target_sources(sinew_report_page PRIVATE ${page_template})
