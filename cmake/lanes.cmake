# sinew_lanes(PATH SOURCE WIDTH FLAGS...)   SOURCE as a part of the library of sinew/PATH, compiled
# with FLAGS for processors that have WIDTH lanes, and with SINEW_LANES as WIDTH.
#
# An inline or template function that another file has too is one function to the linker, which
# takes any of them: the one with FLAGS would run on processors that lack them. So all that the file
# defines is made its own, but the one function that hands out the rest (tools/own-symbols.sh looks).

function(sinew_lanes path source width)
  sinew_target(${path} target)
  set(lib ${target}_${width})
  add_library(${lib} OBJECT ${PROJECT_SOURCE_DIR}/sinew/${source})
  sinew_optimize_much(${lib})
  target_compile_options(${lib} PRIVATE ${ARGN})
  target_compile_definitions(${lib} PRIVATE SINEW_LANES=${width})
  target_include_directories(${lib} PRIVATE ${PROJECT_SOURCE_DIR})
  set(entry _ZN5sinew5plant11batch_callsILi${width}EEERKNS0_10BatchCallsEv)
  set(whole ${CMAKE_CURRENT_BINARY_DIR}/${lib}_whole.o)
  set(own ${CMAKE_CURRENT_BINARY_DIR}/${lib}.o)
  add_custom_command(
    OUTPUT ${own}
    COMMAND ${SINEW_LD_BFD} -r --force-group-allocation -o ${whole} $<TARGET_OBJECTS:${lib}>
    COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${entry} ${whole} ${own}
    DEPENDS ${lib} $<TARGET_OBJECTS:${lib}>
    COMMAND_EXPAND_LISTS VERBATIM)
  set_source_files_properties(${own} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  target_sources(${target} PRIVATE ${own})
  target_compile_definitions(${target} PRIVATE SINEW_WIDE)

  if(SINEW_TESTS)
    set(check ${PROJECT_SOURCE_DIR}/tools/own-symbols.sh)
    add_test(NAME "${path}: ${width} lanes keep their symbols" COMMAND ${check} ${own} ${entry})
    # As the compiler leaves it, it does not: the check can fail.
    add_test(NAME "${path}: ${width} lanes would share their symbols"
             COMMAND ${check} ${whole} ${entry})
    set_tests_properties("${path}: ${width} lanes would share their symbols"
                         PROPERTIES WILL_FAIL TRUE)
  endif()
endfunction()

# Of the linkers only binutils' own resolves groups in an object. A sanitizer's objects are not to be
# taken apart; its builds have the two lanes of every processor.
find_program(SINEW_LD_BFD ld.bfd)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND CMAKE_OBJCOPY AND SINEW_LD_BFD AND NOT SINEW_SANITIZE)
  sinew_lanes(world/packs world/packs/wide/batch_wide.cpp 4 -mavx2)
  sinew_lanes(world/packs world/packs/wide/batch_wide.cpp 8 -mavx2 -mavx512f -mavx512dq -mavx512vl
              -mavx512bw -mprefer-vector-width=512)
endif()
