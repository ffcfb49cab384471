# Debian packages. `cpack --preset release`, or `cpack -G DEB` in a build folder, makes
#
#   sinew          the program, its module for tuning, robots, experiments, documentation
#   sinew-mpi      module for sweeps over the processes of mpirun
#   sinew-comedi   module for machines at a data acquisition card
#   sinew-matlab   module for recordings in MATLAB files
#   libsinew-dev   headers, static libraries, find_package(sinew)
#   python3-sinew  `import sinew`
#
# if the build has them. dpkg-shlibdeps determines their dependencies. Packages always install into /usr,
# whatever the prefix of the build is. Static libraries and Python files, whose folders depend on the prefix,
# therefore have a second installation rule, with components *_deb, for the packages.

find_program(SINEW_DPKG dpkg)
if(NOT SINEW_DPKG OR NOT TARGET sinew)
  return()
endif()

set(arch ${CMAKE_LIBRARY_ARCHITECTURE})
sinew_install_libraries(sinew_deb lib/${arch} COMPONENT development_deb EXCLUDE_FROM_ALL)
install(DIRECTORY sinew thesis fmu DESTINATION include COMPONENT development_deb EXCLUDE_FROM_ALL
        ${headers_only})
if(TARGET sinew_python)
  sinew_install_python(lib/python3/dist-packages COMPONENT python_deb EXCLUDE_FROM_ALL)
endif()

# --- which packages, of which components ---

set(CPACK_PACKAGE_NAME sinew)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/package_date.cmake)
set(CPACK_PACKAGE_CONTACT "The Sinew authors <authors@sinew.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL "")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Licence and changelogs, as in every Debian package: the changelog of Sinew, and that of its packaging,
# whose revision follows Sinew's version.
set(changes "")
foreach(pair "changelog CHANGELOG.md" "changelog.Debian cmake/debian/changelog")
  separate_arguments(pair)
  list(GET pair 0 name)
  list(GET pair 1 source)
  set(packed ${PROJECT_BINARY_DIR}/${name}.gz)
  add_custom_command(OUTPUT ${packed} COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/${source} > ${packed}
                     DEPENDS ${source} VERBATIM)
  list(APPEND changes ${packed})
endforeach()
add_custom_target(sinew_changes ALL DEPENDS ${changes})

# sinew_package(NAME COMPONENT SECTION DEPENDS SUMMARY DESCRIPTION)
macro(sinew_package name component section depends summary description)
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${description}")
  install(FILES LICENSE DESTINATION share/doc/${name} RENAME copyright COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${changes} DESTINATION share/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

set(same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

sinew_package(sinew program science ""
  "robots driven by braided pneumatic actuators"
  "Simulates, identifies, tunes and controls robots that are pulled by braided
pneumatic actuators (McKibben muscles): actuator, air, valves, sensors,
controller and body in one loop. Comes with the walking leg of Colbrunn (2000).")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3 (>= 3.10), python3-sinew, libsinew-dev, sinew-mpi, sinew-comedi, sinew-matlab, www-browser, chromium | chromium-headless-shell, ffmpeg")

if(TARGET sinew_mpi)
  sinew_package(sinew-mpi mpi science "sinew ${same}, openmpi-bin"
    "sweeps of sinew over the processes of mpirun"
    "A module that sinew loads where mpirun started it.")
endif()

if(TARGET sinew_comedi)
  sinew_package(sinew-comedi comedi science "sinew ${same}"
    "machines at a data acquisition card, for sinew"
    "A module that sinew loads for machines at a card that comedi drives.")
endif()

if(TARGET sinew_matlab)
  sinew_package(sinew-matlab matlab science "sinew ${same}"
    "recordings in MATLAB's files, for sinew"
    "A module that sinew loads to import recordings from MAT files.")
endif()

sinew_package(libsinew-dev development_deb libdevel
  "libfmt-dev, nlohmann-json3-dev, zlib1g-dev, libsqlite3-dev, libceres-dev, libeigen3-dev, libminizip-dev"
  "robots driven by braided pneumatic actuators: library"
  "Headers, static libraries and the CMake package of sinew: a muscle with its
air, whole robots, controllers, simulations, identification, tuning. C++20.")
set(CPACK_DEBIAN_DEVELOPMENT_DEB_PACKAGE_SUGGESTS "sinew, cmake, g++")
# It has no shared library; CPack would start two processes for each of its 700 files to search for one.
set(CPACK_DEBIAN_DEVELOPMENT_DEB_PACKAGE_SHLIBDEPS OFF)

if(TARGET sinew_python)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  sinew_package(python3-sinew python_deb python
    "sinew ${same}, python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next}), python3-numpy"
    "robots driven by braided pneumatic actuators: Python"
    "Runs as arrays, simulations that are held, sweeps, tuning, laws of actuators
and environments in the shape of Gymnasium.")
  set(CPACK_DEBIAN_PYTHON_DEB_PACKAGE_RECOMMENDS "python3-pandas")
  set(scripts ${PROJECT_SOURCE_DIR}/cmake/debian)
  set(CPACK_DEBIAN_PYTHON_DEB_PACKAGE_CONTROL_EXTRA "${scripts}/postinst;${scripts}/prerm")
endif()

include(CPack)
