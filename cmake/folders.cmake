# sinew_folder(PATH DEPS...)   adds the library of sinew/PATH; thesis/… and fmu/… are next to sinew/. Its
# tests (*_test.cpp in the same folder) belong to a program of tests/CMakeLists.txt. A folder with only
# headers becomes an interface library.

function(sinew_target path out)
  string(REPLACE "/" "_" name "${path}")
  set(${out} "sinew_${name}" PARENT_SCOPE)
endfunction()

# Compiles a target with -O3 instead of -O1, for folders that compute (listed in CMakeLists.txt). Results are
# the same to the last bit.
function(sinew_optimize_much target)
  if(NOT SINEW_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  endif()
endfunction()

# Compiles a target without optimization, for tests, which are built more often than they run, and for
# headers of external libraries under a sanitizer, where the optimizer takes half of the time.
function(sinew_optimize_nothing target)
  target_compile_options(${target} PRIVATE -O0)
endfunction()

# Unity build: compiles several sources of a target at once, so that their headers are read and instantiated
# once. -DSINEW_TOGETHER=OFF compiles each separately, which is faster after an edit of one of them. Sources
# that are compiled together must not define a name twice at namespace scope.
option(SINEW_TOGETHER "compile the sources of a target several at a time" ON)
function(sinew_together target at_a_time)
  if(SINEW_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${at_a_time})
    # In a unity build GCC treats each source as a header and warns of types with internal linkage.
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
    sinew_together(${target} 16)
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

  if(tests)
    set_property(GLOBAL APPEND PROPERTY SINEW_TESTED ${path})
    set_property(GLOBAL PROPERTY SINEW_TESTS_OF_${path} ${tests})
    set_property(GLOBAL PROPERTY SINEW_TEST_LIBRARIES_OF_${path} ${target})
  endif()
endfunction()

# Links an external library to the only folder that uses it; PRIVATE hides its headers from all others.
function(sinew_uses path scope)
  sinew_target(${path} target)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    target_link_libraries(${target} ${scope} ${ARGN})
  endif()
  sinew_test_uses(${path} ${ARGN})
endfunction()

# Links libraries that only the tests of a folder need.
function(sinew_test_uses path)
  set_property(GLOBAL APPEND PROPERTY SINEW_TEST_LIBRARIES_OF_${path} ${ARGN})
endfunction()
