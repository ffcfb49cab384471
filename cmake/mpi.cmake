# The module with the MPI library in it, lib/sinew/sinew_mpi.so. The program opens it when mpirun
# started it, and else does not know of MPI. Where libopenmpi-dev is missing the program is built
# without, and says so when mpirun starts it.

set(sinew_mpi_module lib/sinew)
target_compile_definitions(sinew_tune_mpi PRIVATE SINEW_MPI_MODULE="../${sinew_mpi_module}/sinew_mpi.so")

set(sinew_has_mpi OFF)
if(SINEW_MPI AND NOT SINEW_FUZZ)
  set(MPI_CXX_SKIP_MPICXX ON)
  find_package(MPI COMPONENTS CXX QUIET)
  if(MPI_CXX_FOUND)
    set(sinew_has_mpi ON)
  else()
    message(STATUS "MPI: built without sweeps over mpirun; libopenmpi-dev brings them")
  endif()
endif()

if(sinew_has_mpi)
  add_library(sinew_mpi MODULE ${PROJECT_SOURCE_DIR}/sinew/tune/mpi/module/module.cpp)
  target_include_directories(sinew_mpi PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(sinew_mpi PRIVATE MPI::MPI_CXX)
  set_target_properties(sinew_mpi PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY
                                             ${PROJECT_BINARY_DIR}/${sinew_mpi_module})
endif()
