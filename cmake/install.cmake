# cmake --install gives find_package(sinew) and one target for everything, sinew::sinew; each folder
# of sinew/ is a target too: sinew::air, sinew::control_joint, …

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(folders GLOBAL PROPERTY SINEW_FOLDERS)

# The target `sinew` is the program, in the build as in the shell.
add_library(sinew_all INTERFACE)
add_library(sinew::sinew ALIAS sinew_all)
target_link_libraries(sinew_all INTERFACE ${folders})
set_target_properties(sinew_all PROPERTIES EXPORT_NAME sinew)

set(SINEW_COMPONENTS "")
foreach(folder ${folders})
  string(REGEX REPLACE "^sinew_" "" name ${folder})
  set_target_properties(${folder} PROPERTIES EXPORT_NAME ${name})
  string(APPEND SINEW_COMPONENTS " ${name}")
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/sinew)
install(TARGETS sinew_all ${folders} EXPORT sinew
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT sinew NAMESPACE sinew:: FILE sinewTargets.cmake DESTINATION ${package})

install(DIRECTORY ${PROJECT_SOURCE_DIR}/sinew ${PROJECT_SOURCE_DIR}/thesis DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h"
        PATTERN "*_test.h" EXCLUDE PATTERN "test_*.h" EXCLUDE PATTERN "testing.h" EXCLUDE)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/sinewConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/sinewConfig.cmake
                              INSTALL_DESTINATION ${package})
# Unstable until 1.0: a program built for 0.1 asks for 0.1.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sinewConfig.cmake ${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake
        DESTINATION ${package})

# The program, and the robots and experiments it comes with.
if(TARGET sinew)
  install(TARGETS sinew RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
foreach(module sinew_mpi sinew_pagmo sinew_comedi)
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION ${sinew_modules})
  endif()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/robots ${PROJECT_SOURCE_DIR}/experiments
        DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
              ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR})  # headers name its pages
