# Uses ccache if it is installed and no other launcher is set, so that a clone in another folder of the same
# computer compiles nothing again. Paths of sources are relative, in messages of failed tests and in the
# cache; precompiled headers are compared by content. -DSINEW_CCACHE=OFF disables it.
option(SINEW_CCACHE "compile through ccache, where it is installed" ON)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
endif()
find_program(SINEW_CCACHE_PROGRAM ccache)
if(SINEW_CCACHE AND SINEW_CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${SINEW_CCACHE_PROGRAM})
endif()
