# sinew_module(NAME SOURCE LIBRARY)   adds lib/sinew/NAME.so, a part of the program that links an external
# library. The program loads it only when it is needed.
#
# sinew_mpi    MPI, for processes started by mpirun
# sinew_pagmo  methods of `sinew tune`
# sinew_comedi data acquisition cards, `sinew run --port comedi:…`
# sinew_matlab .mat files, `sinew import`
#
# If a library is missing, the program is built without the module and reports this when it is needed.

function(sinew_module name source library)
  add_library(${name} MODULE ${PROJECT_SOURCE_DIR}/sinew/${source})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${library})
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY
                                           ${PROJECT_BINARY_DIR}/${sinew_modules})
endfunction()

if(SINEW_MPI AND NOT SINEW_FUZZ)
  set(MPI_CXX_SKIP_MPICXX ON)
  find_package(MPI COMPONENTS CXX QUIET)
  if(MPI_CXX_FOUND)
    sinew_module(sinew_mpi tune/mpi/module/module.cpp MPI::MPI_CXX)
  else()
    message(STATUS "MPI: built without sweeps over mpirun; libopenmpi-dev brings them")
  endif()
endif()

if(SINEW_PAGMO AND NOT SINEW_FUZZ)
  find_package(Pagmo QUIET)
  if(Pagmo_FOUND)
    sinew_module(sinew_pagmo tune/optimizer/module/module.cpp Pagmo::pagmo)
    # Vectors that pagmo allocates are freed in the module. Under the address sanitizer Eigen would free them
    # differently from pagmo, which is compiled without the sanitizer.
    if(SINEW_SANITIZE MATCHES "address")
      target_compile_definitions(sinew_pagmo PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
    endif()
  else()
    message(STATUS "pagmo: built without `sinew tune`; libpagmo-dev brings it")
  endif()
endif()

if(SINEW_COMEDI AND NOT SINEW_FUZZ)
  find_path(SINEW_COMEDI_HEADERS comedilib.h)
  find_library(SINEW_COMEDI_LIBRARY comedi)
  if(SINEW_COMEDI_HEADERS AND SINEW_COMEDI_LIBRARY)
    sinew_module(sinew_comedi port/comedi/module/module.cpp ${SINEW_COMEDI_LIBRARY})
    target_include_directories(sinew_comedi SYSTEM PRIVATE ${SINEW_COMEDI_HEADERS})
  else()
    message(STATUS "comedi: built without machines at a card; libcomedi-dev brings them")
  endif()
endif()

if(SINEW_MATLAB AND NOT SINEW_FUZZ)
  find_path(SINEW_MATIO_HEADERS matio.h)
  find_library(SINEW_MATIO_LIBRARY matio)
  if(SINEW_MATIO_HEADERS AND SINEW_MATIO_LIBRARY)
    sinew_module(sinew_matlab recording/module/module.cpp ${SINEW_MATIO_LIBRARY})
    target_include_directories(sinew_matlab SYSTEM PRIVATE ${SINEW_MATIO_HEADERS})
  else()
    message(STATUS "matio: built without recordings in MATLAB's files; libmatio-dev brings them")
  endif()
endif()
