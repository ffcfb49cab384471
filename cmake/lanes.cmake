# Files of sinew/world that are compiled separately for processors with wide registers. Every external symbol
# of such a file has its width in its name (sinew/world/lane_nodes.h), so that the linker cannot use its code
# on another processor. A test checks this. Tests compile the same functions for every processor; at the low
# optimisation of sanitizers these are not inlined, and return packs in other registers. So sanitizers compile
# these files for every processor too.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  if(NOT SINEW_SANITIZE)
    set(sinew_lanes_4 -mavx2)
    set(sinew_lanes_8 -mavx2 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mprefer-vector-width=512)
  endif()
  foreach(width 4 8)
    set_source_files_properties(sinew/world/lanes_${width}.cpp PROPERTIES
      COMPILE_OPTIONS "${sinew_lanes_${width}}"
      SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
    if(SINEW_TESTS AND NOT SINEW_SANITIZE)
      add_test(NAME "world: ${width} lanes have their names"
               COMMAND ${PROJECT_SOURCE_DIR}/tools/own-symbols.sh $<TARGET_FILE:sinew_world> ${width})
      set_tests_properties("world: ${width} lanes have their names" PROPERTIES LABELS tests)
    endif()
  endforeach()
endif()
