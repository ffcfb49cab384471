# sinew_folder(PATH DEPS...)   the library of sinew/PATH, its tests beside its sources (*_test.cpp);
# thesis/… and fmu/… stand beside sinew/. A folder with headers only becomes an interface library.

function(sinew_target path out)
  string(REPLACE "/" "_" name "${path}")
  set(${out} "sinew_${name}" PARENT_SCOPE)
endfunction()

# The program's words and the tests take twice as long to build as they could ever save: headers
# such as CLI11's and nlohmann's are code in every file. What computes stands in the folders.
function(sinew_optimize_little target)
  if(SINEW_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    # Where -O1 inlines half of a string's text, GCC 12 sees writes beyond it that are none.
    set(wrong -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
    target_compile_options(${target} PRIVATE -O1 "$<$<CXX_COMPILER_ID:GNU>:${wrong}>")
  endif()
endfunction()

# Tests are built more often than they run, and what they try is in the folders: unoptimised they
# take a quarter less to build.
function(sinew_optimize_nothing target)
  target_compile_options(${target} PRIVATE -O0)
endfunction()

# A build that is made once compiles the sources of a target some at a time (presets release, asan,
# tsan): their headers are read and instantiated once. One that is edited compiles each alone.
# Sources that are compiled together must not use one name for two things at namespace scope.
option(SINEW_TOGETHER "compile the sources of a target some at a time" OFF)
function(sinew_together target at_a_time)
  if(SINEW_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${at_a_time})
    # It takes a source that is compiled with others for a header, which may not have types of its own.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

function(sinew_folder path)
  sinew_target(${path} target)
  set(dir ${PROJECT_SOURCE_DIR}/sinew/${path})
  if(path MATCHES "^(thesis|fmu)/")
    set(dir ${PROJECT_SOURCE_DIR}/${path})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${dir}/*.h)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")

  if(sources)
    add_library(${target} STATIC ${sources} ${headers})
    set(scope PUBLIC)
    sinew_together(${target} 6)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(sinew::${target} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY SINEW_FOLDERS ${target})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                $<INSTALL_INTERFACE:include>)
  foreach(dep ${ARGN})
    sinew_target(${dep} dep_target)
    target_link_libraries(${target} ${scope} ${dep_target})
  endforeach()

  if(SINEW_TESTS AND tests)
    add_executable(${target}_test ${tests})
    sinew_optimize_nothing(${target}_test)
    sinew_precompiled(${target}_test test)
    sinew_together(${target}_test 6)
    target_link_libraries(${target}_test PRIVATE ${target} GTest::gtest_main)
    target_compile_definitions(${target}_test PRIVATE SINEW_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(${target}_test TEST_PREFIX "${path}: " DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

# An outside library stands behind one folder; PRIVATE keeps its headers out of everyone else's.
function(sinew_uses path scope)
  sinew_target(${path} target)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    target_link_libraries(${target} ${scope} ${ARGN})
  endif()
  if(TARGET ${target}_test)
    target_link_libraries(${target}_test PRIVATE ${ARGN})
  endif()
endfunction()

# What only the tests of a folder need.
function(sinew_test_uses path)
  sinew_target(${path} target)
  if(TARGET ${target}_test)
    target_link_libraries(${target}_test PRIVATE ${ARGN})
  endif()
endfunction()
