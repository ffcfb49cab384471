// run/card/kernel.cu - walk.h for NVIDIA cards, compiled by clang without the maker's toolkit
// (cmake/card.cmake). All code is that of the processor: the sources of the library that it calls are
// included here.
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))

#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#pragma clang force_cuda_host_device begin
#include "sinew/air/exact_root.cpp"
#include "sinew/control/joint/config.cpp"
#include "sinew/control/joint/joint_controller.cpp"
#include "sinew/control/supervise/supervisor.cpp"
#include "sinew/robot/sensing.cpp"
#include "sinew/run/card/kernel.h"
#include "sinew/run/controllers/board.cpp"
#pragma clang force_cuda_host_device end

// Each thread runs one walk. The threads of a block wait for each other at each node.
extern "C" __global__ void __attribute__((launch_bounds(sinew::run::kernel_threads, sinew::run::kernel_blocks)))
walk(sinew::run::Walk* walks, sinew::run::Launch launch) {
  const std::int64_t i =
      static_cast<std::int64_t>(__nvvm_read_ptx_sreg_ctaid_x()) * __nvvm_read_ptx_sreg_ntid_x() +
      __nvvm_read_ptx_sreg_tid_x();
  sinew::run::run_thread(walks, launch, i, [](bool x) { return __nvvm_bar0_or(x) != 0; });
}
