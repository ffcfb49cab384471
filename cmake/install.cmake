# cmake --install gives find_package(sinew) and one target for everything, sinew::sinew; each folder
# of sinew/ is a component and a target too: sinew::muscle, sinew::control_joint, …

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(folders GLOBAL PROPERTY SINEW_FOLDERS)

# The target `sinew` is the program, in the build as in the shell.
add_library(sinew_all INTERFACE)
add_library(sinew::sinew ALIAS sinew_all)
target_link_libraries(sinew_all INTERFACE ${folders})
set_target_properties(sinew_all PROPERTIES EXPORT_NAME sinew)

foreach(folder ${folders})
  string(REGEX REPLACE "^sinew_" "" name ${folder})
  set_target_properties(${folder} PROPERTIES EXPORT_NAME ${name})
endforeach()

# The outside packages that a component is linked with, by itself and by what stands below it.
function(sinew_packages target out)
  set(packages)
  get_target_property(below ${target} INTERFACE_LINK_LIBRARIES)
  foreach(item ${below})
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" item "${item}")
    if(item IN_LIST folders)
      sinew_packages(${item} more)
      list(APPEND packages ${more})
    elseif(item MATCHES "^([A-Za-z0-9_]+)::")
      list(APPEND packages ${CMAKE_MATCH_1})
    endif()
  endforeach()
  if(packages)
    list(REMOVE_DUPLICATES packages)
  endif()
  set(${out} ${packages} PARENT_SCOPE)
endfunction()

set(sinew_components)
foreach(folder ${folders})
  string(REGEX REPLACE "^sinew_" "" name ${folder})
  sinew_packages(${folder} packages)
  string(APPEND sinew_components "set(_sinew_packages_of_${name} ${packages})\n")
endforeach()

sinew_packages(sinew_all sinew_all_packages)

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
install(DIRECTORY ${PROJECT_SOURCE_DIR}/robots ${PROJECT_SOURCE_DIR}/experiments
        DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
              ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Headers point to pages of docs/.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
