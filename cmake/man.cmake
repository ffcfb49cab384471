# Manual page sinew(1), generated from the help of the program.
find_program(SINEW_GZIP gzip)
if(NOT TARGET sinew OR NOT SINEW_GZIP OR SINEW_SANITIZE)
  return()
endif()
set(page ${PROJECT_BINARY_DIR}/sinew.1)
add_custom_command(
  OUTPUT ${page}.gz
  COMMAND ${PROJECT_SOURCE_DIR}/tools/man.sh $<TARGET_FILE:sinew> ${PROJECT_VERSION} > ${page}
  COMMAND ${SINEW_GZIP} -9nf ${page}
  DEPENDS sinew tools/man.sh
  VERBATIM)
add_custom_target(sinew_man ALL DEPENDS ${page}.gz)
install(FILES ${page}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/man/man1 COMPONENT program)
