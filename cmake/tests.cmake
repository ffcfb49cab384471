# sinew_test_program(NAME [FOLDERS ...] [SOURCES ...] [USES ...] [LABEL label]
#                    [CLOCK pattern...] [PARALLEL pattern...] [COVERAGE pattern...])
#
# Adds the test program sinew_<NAME>_test with the tests of these folders of sinew/, of all folders below
# them, and of these sources. Its tests are discovered when ctest runs, not at build time. Their names begin
# with "<NAME>: ", and each has one label, by which ./check selects:
#
#   tests      ./check          in parallel
#   clock      ./check faces    CLOCK: in real time, or waiting for another process; run one at a time;
#                               PARALLEL: slow tests that may run in parallel with others
#   coverage   ./check faces    COVERAGE: how often an interval contains the true value, in many trials
#   guard      ./check faces    a few tries each; ./check long NAME runs many
#   long       ./check long
#   device     ./check device   skipped without a graphics card
#
# The target sinew_tests builds all programs that have tests of the first label.

function(sinew_test_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LABEL" "FOLDERS;SOURCES;USES;CLOCK;PARALLEL;COVERAGE")
  set(target sinew_${name}_test)
  set(libraries "")
  get_property(tested GLOBAL PROPERTY SINEW_TESTED)
  foreach(path ${tested})
    foreach(folder ${arg_FOLDERS})
      if("${path}/" MATCHES "^${folder}/")
        get_property(tests GLOBAL PROPERTY SINEW_TESTS_OF_${path})
        get_property(uses GLOBAL PROPERTY SINEW_TEST_LIBRARIES_OF_${path})
        list(APPEND arg_SOURCES ${tests})
        list(APPEND libraries ${uses})
        set_property(GLOBAL APPEND PROPERTY SINEW_IN_A_PROGRAM ${path})
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES libraries)

  add_executable(${target} EXCLUDE_FROM_ALL ${arg_SOURCES})
  sinew_optimize_nothing(${target})
  sinew_precompiled(${target} test)
  sinew_together(${target} 12)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PRIVATE ${arg_USES} ${libraries} sinew_test_places sinew_test_heap GTest::gmock GTest::gtest_main)
  sinew_test_labels(${target} "${name}: " "${arg_LABEL}" "${arg_CLOCK}" "${arg_PARALLEL}" "${arg_COVERAGE}")
endfunction()

function(sinew_test_labels target prefix label clock parallel coverage)
  if(NOT label)
    set(label tests)
    add_dependencies(sinew_tests ${target})
  endif()
  list(JOIN clock ":" clock_filter)
  list(JOIN parallel ":" parallel_filter)
  list(JOIN coverage ":" coverage_filter)
  set(rest ${clock} ${parallel} ${coverage} Worlds/*)  # its laws: tests/CMakeLists.txt
  list(JOIN rest ":" rest)
  set(discover DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 TEST_PREFIX ${prefix})
  set(serial FALSE)
  if(label STREQUAL "clock")
    set(serial TRUE)
  endif()
  gtest_discover_tests(${target} ${discover} TEST_FILTER -${rest}
                       PROPERTIES LABELS ${label} TIMEOUT 600 RUN_SERIAL ${serial})
  if(clock)
    gtest_discover_tests(${target} ${discover} TEST_FILTER ${clock_filter}
                         PROPERTIES LABELS clock TIMEOUT 300 RUN_SERIAL TRUE)
  endif()
  if(parallel)
    gtest_discover_tests(${target} ${discover} TEST_FILTER ${parallel_filter} PROPERTIES LABELS clock TIMEOUT 300)
  endif()
  if(coverage)
    gtest_discover_tests(${target} ${discover} TEST_FILTER ${coverage_filter} PROPERTIES LABELS coverage TIMEOUT 600)
  endif()
endfunction()
