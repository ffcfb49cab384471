# Read by cpack before it makes a package. All files in a package have the date of the last commit, or that
# of SOURCE_DATE_EPOCH, so that packages are reproducible.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${CMAKE_CURRENT_LIST_DIR} log -1 --format=%ct
                  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT date)
    set(date 0)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${date})
endif()
