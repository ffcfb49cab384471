# What bash, zsh and fish need to complete a line of sinew, from what the program says of itself. The
# places are those in which Debian's shells look.
if(NOT TARGET sinew OR SINEW_SANITIZE)
  return()
endif()
set(places bash bash-completion/completions sinew
           zsh  zsh/vendor-completions      _sinew
           fish fish/vendor_completions.d   sinew.fish)
set(scripts "")
while(places)
  list(POP_FRONT places shell place name)
  set(script ${PROJECT_BINARY_DIR}/completion/${name})
  add_custom_command(
    OUTPUT ${script}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/completion
    COMMAND $<TARGET_FILE:sinew> completion ${shell} > ${script}
    DEPENDS sinew
    VERBATIM)
  list(APPEND scripts ${script})
  install(FILES ${script} DESTINATION ${CMAKE_INSTALL_DATADIR}/${place} COMPONENT program)
endwhile()
add_custom_target(sinew_completion ALL DEPENDS ${scripts})
