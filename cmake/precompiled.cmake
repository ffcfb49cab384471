# sinew_precompile(KIND HEADERS ... [LIBRARY] [MUCH|NOTHING] [USES ...])   precompiles headers for all targets
# of a kind. Every source still includes the headers that it needs and compiles without precompiled ones, as
# with -DSINEW_PCH=OFF.
#
# A precompiled header can only be used with the same flags and definitions. A kind is therefore
# library or program, degree of optimization, with or without fmt.

option(SINEW_PCH "precompile the headers that most sources include" ON)

# Adds the target sinew_pch_<kind>, whose headers sinew_precompiled() uses.
function(sinew_precompile kind)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LIBRARY;MUCH;NOTHING" "" "USES;HEADERS")
  if(NOT SINEW_PCH)
    return()
  endif()
  set(target sinew_pch_${kind})
  set(empty ${PROJECT_BINARY_DIR}/precompiled/${kind}.cpp)
  if(NOT EXISTS ${empty})
    file(WRITE ${empty} "int main() {}\n")
  endif()
  if(arg_LIBRARY)
    add_library(${target} STATIC EXCLUDE_FROM_ALL ${empty})
  else()
    add_executable(${target} EXCLUDE_FROM_ALL ${empty})
  endif()
  if(arg_MUCH)
    sinew_optimize_much(${target})
  elseif(arg_NOTHING)
    sinew_optimize_nothing(${target})
  endif()
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PRIVATE ${arg_USES})
  target_precompile_headers(${target} PRIVATE ${arg_HEADERS})
  # Without this option ccache does not detect changes of the headers.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# Uses the precompiled headers of the kind, if they exist, in a target.
function(sinew_precompiled target kind)
  if(TARGET sinew_pch_${kind})
    target_precompile_headers(${target} REUSE_FROM sinew_pch_${kind})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()
