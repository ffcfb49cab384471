# The program for graphics cards, sinew/run/card/kernel.cu, compiled by clang without a toolkit of the cards'
# maker into PTX, a text that the driver of a card compiles when it is needed. sinew_card contains the text
# (sinew/card/walk.h). Without such a clang everything is built except this program, and `sinew doctor` reports
# that.
#
# A card then computes the same bits as a processor: no fused operations, no approximations, no functions of a
# library. A test checks the text for that (tools/card-ptx.sh).

set(walk_text ${PROJECT_BINARY_DIR}/walk_ptx.cpp)
if(SINEW_CARD)
  find_program(SINEW_CARD_COMPILER NAMES clang++-19)
endif()
if(SINEW_CARD AND SINEW_CARD_COMPILER)
  set(kernel ${PROJECT_SOURCE_DIR}/sinew/run/card/kernel.cu)
  set(ptx ${PROJECT_BINARY_DIR}/walk.ptx)
  add_custom_command(
    OUTPUT ${ptx}
    COMMAND ${SINEW_CARD_COMPILER}
      -x cuda --cuda-device-only -nocudainc -nocudalib --cuda-path=/nonexistent
      -Wno-unknown-cuda-version -Wno-deprecated-declarations
      # Oldest driver and card: constants of sinew/card/driver.cpp.
      --cuda-feature=+ptx70 --cuda-gpu-arch=sm_80
      -Xclang -fcuda-allow-variadic-functions
      -std=c++20 -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math -I${PROJECT_SOURCE_DIR}
      -MD -MT ${ptx} -MF ${ptx}.d -S -o ${ptx} ${kernel}
    DEPENDS ${kernel}
    DEPFILE ${ptx}.d
    COMMENT "Compiling sinew/run/card/kernel.cu for graphics cards"
    VERBATIM)
  add_custom_command(
    OUTPUT ${walk_text}
    COMMAND ${CMAKE_COMMAND} -DPTX=${ptx} -DOUT=${walk_text} -P ${CMAKE_CURRENT_LIST_DIR}/card_text.cmake
    DEPENDS ${ptx} ${CMAKE_CURRENT_LIST_DIR}/card_text.cmake
    VERBATIM)
  if(SINEW_TESTS)
    add_test(NAME "card: the program has the operations of a processor"
             COMMAND ${PROJECT_SOURCE_DIR}/tools/card-ptx.sh ${ptx})
    set_tests_properties("card: the program has the operations of a processor" PROPERTIES LABELS tests)
  endif()
else()
  set(PTX "")
  set(OUT ${walk_text})
  include(${CMAKE_CURRENT_LIST_DIR}/card_text.cmake)
  message(STATUS "graphics cards: built without a program for them; clang-19 brings it")
endif()
target_sources(sinew_card PRIVATE ${walk_text})
# The text is one string literal, longer than the 65536 characters that the standard guarantees.
set_source_files_properties(${walk_text} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings
                                                    SKIP_UNITY_BUILD_INCLUSION ON)
