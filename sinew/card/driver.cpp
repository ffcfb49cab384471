#include "sinew/card/driver.h"

#include <dlfcn.h>

#include <array>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace sinew::card {

namespace {

// --- the driver's library ---

using Status = int;  // 0: success
using Device = int;
using Address = unsigned long long;

// Numbers of the driver's interface.
constexpr int out_of_memory = 2, no_device = 100;
constexpr int multiprocessor_count = 16, capability_major = 75, capability_minor = 76;
constexpr int error_log = 5, error_log_size = 6;  // options of its compiler
constexpr unsigned sleeps_while_waiting = 4;      // a flag of a context

// Oldest driver and card for our programs: PTX 7.0 for compute capability 8.0 (cmake/card.cmake).
constexpr int oldest_driver = 11'000;
constexpr int oldest_capability = 80;

// Functions of the library. Names with _v2 take sizes and addresses of 64 bits.
struct Library {
  std::string problem;  // empty: all functions were found

  Status (*cuInit)(unsigned);
  Status (*cuDriverGetVersion)(int*);
  Status (*cuGetErrorName)(Status, const char**);
  Status (*cuDeviceGetCount)(int*);
  Status (*cuDeviceGet)(Device*, int);
  Status (*cuDeviceGetName)(char*, int, Device);
  Status (*cuDeviceGetAttribute)(int*, int, Device);
  Status (*cuDeviceTotalMem_v2)(std::size_t*, Device);
  Status (*cuCtxCreate_v2)(void**, unsigned, Device);
  Status (*cuCtxDestroy_v2)(void*);
  Status (*cuCtxPushCurrent_v2)(void*);
  Status (*cuCtxPopCurrent_v2)(void**);
  Status (*cuCtxSynchronize)();
  Status (*cuModuleLoadDataEx)(void**, const void*, unsigned, int*, void**);
  Status (*cuModuleGetFunction)(void**, void*, const char*);
  Status (*cuMemGetInfo_v2)(std::size_t*, std::size_t*);
  Status (*cuMemAlloc_v2)(Address*, std::size_t);
  Status (*cuMemFree_v2)(Address);
  Status (*cuMemcpyHtoD_v2)(Address, const void*, std::size_t);
  Status (*cuMemcpyDtoH_v2)(void*, Address, std::size_t);
  Status (*cuLaunchKernel)(void*, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned,
                           unsigned, void*, void**, void**);
};

Library open_library() {
  Library out{};
  void* file = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!file) {
    const char* reason = dlerror();
    out.problem = fmt::format("no driver of NVIDIA ({})", reason ? reason : "libcuda.so.1");
    return out;
  }
  const auto find = [&](const char* name, auto& function) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(file, name));
    if (!function && out.problem.empty())
      out.problem = fmt::format("libcuda.so.1 lacks {}; install a newer driver", name);
  };
  find("cuInit", out.cuInit);
  find("cuDriverGetVersion", out.cuDriverGetVersion);
  find("cuGetErrorName", out.cuGetErrorName);
  find("cuDeviceGetCount", out.cuDeviceGetCount);
  find("cuDeviceGet", out.cuDeviceGet);
  find("cuDeviceGetName", out.cuDeviceGetName);
  find("cuDeviceGetAttribute", out.cuDeviceGetAttribute);
  find("cuDeviceTotalMem_v2", out.cuDeviceTotalMem_v2);
  find("cuCtxCreate_v2", out.cuCtxCreate_v2);
  find("cuCtxDestroy_v2", out.cuCtxDestroy_v2);
  find("cuCtxPushCurrent_v2", out.cuCtxPushCurrent_v2);
  find("cuCtxPopCurrent_v2", out.cuCtxPopCurrent_v2);
  find("cuCtxSynchronize", out.cuCtxSynchronize);
  find("cuModuleLoadDataEx", out.cuModuleLoadDataEx);
  find("cuModuleGetFunction", out.cuModuleGetFunction);
  find("cuMemGetInfo_v2", out.cuMemGetInfo_v2);
  find("cuMemAlloc_v2", out.cuMemAlloc_v2);
  find("cuMemFree_v2", out.cuMemFree_v2);
  find("cuMemcpyHtoD_v2", out.cuMemcpyHtoD_v2);
  find("cuMemcpyDtoH_v2", out.cuMemcpyDtoH_v2);
  find("cuLaunchKernel", out.cuLaunchKernel);
  return out;
}

// Opened once and never closed. A driver that was not found may be there at the next call.
const Library& library() {
  static std::mutex mutex;
  static std::optional<const Library> opened;
  thread_local Library missing;
  const std::lock_guard lock(mutex);
  if (opened) return *opened;
  missing = open_library();
  if (!missing.problem.empty()) return missing;
  return opened.emplace(missing);
}

// --- errors ---

// Returns "CUDA_ERROR_NO_DEVICE, 100".
std::string name_of(Status status) {
  const char* name = nullptr;
  if (library().cuGetErrorName(status, &name) != 0 || !name) name = "unknown error";
  return fmt::format("{}, {}", name, status);
}

// Returns what may remedy an error, as the beginning of "use the processor"; "" if nothing is
// known.
std::string_view remedy(Status status) {
  switch (status) {
    case out_of_memory:
      return "end other programs that use the card, or ";
    case 101:
      return "take a card that `sinew doctor` lists, or ";
    case 200:
    case 209:
    case 218:
    case 221:
    case 222:
      return "install a newer driver, or ";
    case 702:
      return "take a card that drives no screen, since long programs on one that does are ended, "
             "or ";
    case 802:
    case 803:
    case 804:
      return "restart the computer if its driver was updated, or ";
    default:
      return "";
  }
}

[[noreturn]] void fail(Status status, const char* call, const std::string& details = "") {
  throw std::runtime_error(
      fmt::format("the graphics card failed: {}: {}{}; {}use the processor, "
                  "device=cpu",
                  call, name_of(status), details, remedy(status)));
}

void must(Status status, const char* call) {
  if (status != 0) fail(status, call);
}

// --- cards ---

// Returns why the driver as a whole cannot be used; empty if it can.
std::string problem_of_driver(int& version) {
  const Library& driver = library();
  if (!driver.problem.empty()) return driver.problem;
  const Status status = driver.cuInit(0);
  if (status == no_device) return fmt::format("the driver found none ({})", name_of(status));
  if (status != 0) return fmt::format("the driver does not start ({})", name_of(status));
  if (driver.cuDriverGetVersion(&version) != 0) version = 0;
  if (version < oldest_driver)
    return fmt::format(
        "its driver supports CUDA {}.{}; expected {}.{} or newer: install a newer "
        "driver",
        version / 1000, version % 1000 / 10, oldest_driver / 1000, oldest_driver % 1000 / 10);
  return "";
}

int attribute(int which, Device device) {
  int out = 0;
  must(library().cuDeviceGetAttribute(&out, which, device), "cuDeviceGetAttribute");
  return out;
}

Properties properties_of(int number) {
  const Library& driver = library();
  Device device = 0;
  must(driver.cuDeviceGet(&device, number), "cuDeviceGet");
  std::array<char, 256> name{};
  must(driver.cuDeviceGetName(name.data(), static_cast<int>(name.size()) - 1, device),
       "cuDeviceGetName");
  std::size_t memory = 0;
  must(driver.cuDeviceTotalMem_v2(&memory, device), "cuDeviceTotalMem");
  return {.number = number,
          .name = name.data(),
          .multiprocessors = attribute(multiprocessor_count, device),
          .memory = static_cast<std::int64_t>(memory),
          .major = attribute(capability_major, device),
          .minor = attribute(capability_minor, device)};
}

}  // namespace

std::vector<Properties> list(std::string& problem) {
  std::vector<Properties> out;
  try {
    int version = 0, count = 0;
    problem = problem_of_driver(version);
    if (!problem.empty()) return out;
    must(library().cuDeviceGetCount(&count), "cuDeviceGetCount");
    for (int i = 0; i < count; ++i) {
      Properties card = properties_of(i);
      card.driver = fmt::format("{}.{}", version / 1000, version % 1000 / 10);
      if (10 * card.major + card.minor >= oldest_capability)
        out.push_back(std::move(card));
      else
        problem =
            fmt::format("{} has compute capability {}.{}; expected {}.{} or newer", card.name,
                        card.major, card.minor, oldest_capability / 10, oldest_capability % 10);
    }
    if (!out.empty())
      problem.clear();
    else if (problem.empty())
      problem = "the driver found none";
  } catch (const std::exception& e) {
    out.clear();
    problem = e.what();
  }
  return out;
}

// --- programs ---

// Context of a program, with its module.
struct Context {
  explicit Context(int card) {
    int version = 0;
    const std::string problem = problem_of_driver(version);
    if (!problem.empty()) throw std::runtime_error("found no graphics card: " + problem);
    Device device = 0;
    must(library().cuDeviceGet(&device, card), "cuDeviceGet");
    must(library().cuCtxCreate_v2(&handle, sleeps_while_waiting, device), "cuCtxCreate");
    // The new context is this thread's current one. Each call makes it current for itself.
    void* popped = nullptr;
    library().cuCtxPopCurrent_v2(&popped);
  }
  // Releases the module and what is left of the memory too.
  ~Context() { library().cuCtxDestroy_v2(handle); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void* handle = nullptr;
};

namespace {

// Makes a context current in this thread, until the end of the scope.
class Current {
 public:
  explicit Current(const Context& context)
      : status_(library().cuCtxPushCurrent_v2(context.handle)) {}
  ~Current() {
    void* popped = nullptr;
    if (status_ == 0) library().cuCtxPopCurrent_v2(&popped);
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

  // Returns the status of a call within the context.
  template <class Function, class... Arguments>
  Status call(Function function, Arguments... arguments) const {
    return status_ != 0 ? status_ : function(arguments...);
  }

 private:
  Status status_;
};

// Returns the module of a text that ends with a zero.
void* compile(const Current& current, const std::string& ptx) {
  std::array<char, 8192> log{};
  std::array<int, 2> options{error_log, error_log_size};
  // The driver takes a size in the place of a pointer.
  std::array<void*, 2> values{log.data(), reinterpret_cast<void*>(log.size() - 1)};
  void* module = nullptr;
  const Status status = current.call(library().cuModuleLoadDataEx, &module, ptx.c_str(), 2u,
                                     options.data(), values.data());
  if (status != 0)
    fail(status, "cuModuleLoadDataEx", log[0] ? fmt::format(": {}", log.data()) : "");
  return module;
}

// Returns a number of bytes as "1.5 MB".
std::string megabytes(std::size_t bytes) {
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

}  // namespace

Program::Program(int card, std::string_view ptx, const char* kernel)
    : context_(std::make_shared<const Context>(card)) {
  const Current current(*context_);
  void* module = compile(current, std::string(ptx));
  must(current.call(library().cuModuleGetFunction, &kernel_, module, kernel),
       "cuModuleGetFunction");
}

Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

std::size_t Program::free_memory() const {
  std::size_t free = 0, total = 0;
  must(Current(*context_).call(library().cuMemGetInfo_v2, &free, &total), "cuMemGetInfo");
  return free;
}

void Program::launch(unsigned blocks, unsigned threads, std::span<void*> parameters) {
  must(Current(*context_).call(library().cuLaunchKernel, kernel_, blocks, 1u, 1u, threads, 1u, 1u,
                               0u, static_cast<void*>(nullptr), parameters.data(),
                               static_cast<void**>(nullptr)),
       "cuLaunchKernel");
}

void Program::wait() {
  must(Current(*context_).call(library().cuCtxSynchronize), "cuCtxSynchronize");
}

// --- memory ---

Buffer::Buffer(const Program& program, std::size_t bytes)
    : context_(program.context_), size_(bytes) {
  if (bytes == 0) return;
  const Status status = Current(*context_).call(library().cuMemAlloc_v2, &address_, bytes);
  if (status == out_of_memory)
    fail(status, "cuMemAlloc",
         fmt::format(": {} were requested, {} are free", megabytes(bytes),
                     megabytes(program.free_memory())));
  must(status, "cuMemAlloc");
}

Buffer::~Buffer() {
  if (address_ != 0) Current(*context_).call(library().cuMemFree_v2, address_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : context_(std::move(other.context_)),
      address_(std::exchange(other.address_, 0)),
      size_(std::exchange(other.size_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(address_, other.address_);
  std::swap(size_, other.size_);
  return *this;
}

namespace {

void check_size(std::size_t data, std::size_t buffer) {
  if (data > buffer)
    throw std::invalid_argument(
        fmt::format("found {} bytes; expected at most {}, the buffer's", data, buffer));
}

}  // namespace

void Buffer::write(std::span<const std::byte> data) {
  check_size(data.size(), size_);
  if (data.empty()) return;
  must(Current(*context_).call(library().cuMemcpyHtoD_v2, address_,
                               static_cast<const void*>(data.data()), data.size()),
       "cuMemcpyHtoD");
}

void Buffer::read(std::span<std::byte> data) const {
  check_size(data.size(), size_);
  if (data.empty()) return;
  must(Current(*context_).call(library().cuMemcpyDtoH_v2, static_cast<void*>(data.data()), address_,
                               data.size()),
       "cuMemcpyDtoH");
}

}  // namespace sinew::card
