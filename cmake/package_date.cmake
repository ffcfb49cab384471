# Read by cpack before it makes a package: all files in it have the date of the sources' last commit,
# or the one that SOURCE_DATE_EPOCH says, so that who makes it again gets the same bytes.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${CMAKE_CURRENT_LIST_DIR} log -1 --format=%ct
                  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT date)
    set(date 0)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${date})
endif()
