# Toolchain for the embedded core: bare Cortex-M4F, no operating system, no C library.
#   cmake --preset firmware && cmake --build --preset firmware
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm-cortex-m4f)

set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # nothing to link a program against

# The core's rules as flags: single precision in the FPU, no fused operations, none of the
# language's machinery that needs a run-time library.
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16
  -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics
  -ffp-contract=off -fno-math-errno
  -fno-unwind-tables -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
