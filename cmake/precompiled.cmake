# sinew_precompile(KIND HEADERS ... [LIBRARY] [MUCH|NOTHING] [USES ...])   headers that the compiler reads
# once for all targets of a kind, instead of once for each of their sources. Every source still includes
# what it needs and compiles without; -DSINEW_PCH=OFF does so.
#
# A compiler takes a precompiled header only where flags and definitions are those it was made with, so
# a kind is: library or program, how much it is optimized, with or without fmt.

option(SINEW_PCH "precompile the headers that most sources include" ON)

# Makes the target sinew_pch_<kind>, whose headers sinew_precompiled() uses.
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
  # Without it ccache does not see what such a header is made of.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# The target's sources begin with the headers of the kind, if it exists.
function(sinew_precompiled target kind)
  if(TARGET sinew_pch_${kind})
    target_precompile_headers(${target} REUSE_FROM sinew_pch_${kind})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()
