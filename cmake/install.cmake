# cmake --install provides find_package(sinew) with one target for everything, sinew::sinew, and one for each
# folder of sinew/: sinew::air, sinew::control_joint, …
#
# Components correspond to the packages of cpack (package.cmake): program, mpi, comedi, matlab, development,
# python. A plain installation has all of them.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(folders GLOBAL PROPERTY SINEW_FOLDERS)

# The target `sinew` is the program.
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

# The API is unstable until 1.0: a project that requires 0.1 does not accept 0.2.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)

# Installs the static libraries and the CMake package into the folder `libraries` of the prefix. Further
# arguments are passed to install().
function(sinew_install_libraries export libraries)
  set(package ${libraries}/cmake/sinew)
  set(config ${PROJECT_BINARY_DIR}/${export}/sinewConfig.cmake)
  install(TARGETS sinew_all ${folders} EXPORT ${export}
          ARCHIVE DESTINATION ${libraries} ${ARGN}
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ${export} NAMESPACE sinew:: FILE sinewTargets.cmake DESTINATION ${package} ${ARGN})
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/sinewConfig.cmake.in ${config}
                                INSTALL_DESTINATION ${package})
  install(FILES ${config} ${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake DESTINATION ${package} ${ARGN})
endfunction()
sinew_install_libraries(sinew ${CMAKE_INSTALL_LIBDIR} COMPONENT development)

set(headers_only FILES_MATCHING PATTERN "*.h"
    PATTERN "*_test.h" EXCLUDE PATTERN "test_*.h" EXCLUDE PATTERN "testing.h" EXCLUDE)
if(SINEW_ONLY)
  foreach(folder units signals gas actuator air mechanism/driven world/kernel world/driven)
    cmake_path(GET folder PARENT_PATH above)
    install(DIRECTORY sinew/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sinew/${above}
            COMPONENT development ${headers_only})
  endforeach()
  install(FILES sinew/muscle.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sinew COMPONENT development)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
  return()
endif()
install(DIRECTORY sinew thesis fmu DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        ${headers_only})

# The program, and the robots and experiments that are shipped with it.
if(TARGET sinew)
  install(TARGETS sinew RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(TARGETS sinew_thesis_program RUNTIME DESTINATION ${sinew_modules} COMPONENT program)
endif()
foreach(module pagmo mpi comedi matlab)
  set(component ${module})
  if(module STREQUAL "pagmo")
    set(component program)
  endif()
  if(TARGET sinew_${module})
    install(TARGETS sinew_${module} LIBRARY DESTINATION ${sinew_modules} COMPONENT ${component})
  endif()
endforeach()
# Parts of exported FMUs.
install(TARGETS sinew_fmu_muscle_module sinew_fmu_machine_module LIBRARY DESTINATION ${sinew_modules}
        COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/${sinew_modules}/fmu_sources DESTINATION ${sinew_modules}
        COMPONENT program)
install(DIRECTORY robots experiments studies DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew COMPONENT program)
# `sinew list examples` finds them there. Files that running an example leaves in its folder are excluded.
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew COMPONENT program
        PATTERN "__pycache__" EXCLUDE PATTERN "build" EXCLUDE PATTERN "runs" EXCLUDE)
install(FILES python/sinew/_film.py DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew/python/sinew COMPONENT program)
install(DIRECTORY data/templates DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew/data COMPONENT program)
install(FILES data/valves.toml DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew/data COMPONENT program)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT texts)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)  # headers name its pages
