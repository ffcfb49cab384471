// A substitute for libcuda.so.1 that runs kernels on the processor. Memory of its cards is memory
// of the process. A launch has ended when it returns; its failure is reported by the next wait, as
// the real driver does.
//
// It has the kernels `walk`, if the build has it, and `add`. As the real driver, it finds a kernel
// only if the program's text has its entry.
//
// SINEW_FAKE_CARD in the environment has words with spaces between them:
//
//   none         no card
//   broken       the driver does not start
//   old-driver   the driver is for CUDA 10.2
//   old-card     the first card has compute capability 7.5
//   cards=2      number of cards; default: 1
//   memory=1000  memory of a card [byte]; default: 1 GB
//   multiprocessors=4   of a card; default: 1
//   load         the compiler refuses every program, with a message
//   launch       no kernel can be launched
//   wait         a launched kernel fails
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// The kernel for one thread, compiled for the processor.
extern "C" void sinew_walk_on_processor(void** parameters, long thread);

namespace {

using Kernel = void (*)(void** parameters, long thread);

struct Module {
  std::string text;
};
struct Context {
  int card = 0;
  bool failed = false;  // by a kernel
  std::set<Module*> modules;
  std::map<void*, std::size_t> buffers;
};

std::mutex mutex;  // guards what follows
std::set<Context*> contexts;
std::map<const void*, Kernel> kernels;
thread_local std::vector<Context*> current;

// Returns whether the environment has a word, or the number of a word "cards=2".
long setting(const std::string& name, long otherwise = 0) {
  const char* text = std::getenv("SINEW_FAKE_CARD");
  std::istringstream words(text ? text : "");
  for (std::string word; words >> word;) {
    if (word == name) return 1;
    if (word.starts_with(name + "=")) return std::atol(word.c_str() + name.size() + 1);
  }
  return otherwise;
}

std::size_t memory() { return static_cast<std::size_t>(setting("memory", 1'000'000'000)); }

std::size_t used(int card) {
  std::size_t out = 0;
  for (const Context* c : contexts)
    for (const auto& [address, size] : c->buffers)
      if (c->card == card) out += size;
  return out;
}

// Returns the context of this thread's calls; null without one.
Context* here() { return current.empty() ? nullptr : current.back(); }

// Returns whether the memory is part of a buffer of this thread's context.
bool is_within(unsigned long long address, std::size_t size) {
  const auto& buffers = here()->buffers;
  for (const auto& [begin, length] : buffers) {
    const auto first = reinterpret_cast<unsigned long long>(begin);
    if (address >= first && address + size <= first + length) return true;
  }
  return false;
}

void add(void** parameters, long thread) {
  const double* a = *static_cast<double**>(parameters[0]);
  const double* b = *static_cast<double**>(parameters[1]);
  double* sum = *static_cast<double**>(parameters[2]);
  if (thread < *static_cast<int*>(parameters[3])) sum[thread] = a[thread] + b[thread];
}

constexpr int invalid_value = 1, invalid_context = 201;

}  // namespace

extern "C" {

// Returns how many contexts, modules and buffers have not been released.
long fake_card_holds() {
  const std::lock_guard lock(mutex);
  std::size_t out = contexts.size();
  for (const Context* c : contexts) out += c->modules.size() + c->buffers.size();
  return static_cast<long>(out);
}

int cuInit(unsigned) { return setting("none") ? 100 : setting("broken") ? 999 : 0; }

int cuDriverGetVersion(int* version) {
  *version = setting("old-driver") ? 10'020 : 12'040;
  return 0;
}

int cuGetErrorName(int status, const char** name) {
  static const std::map<int, const char*> names = {
      {1, "CUDA_ERROR_INVALID_VALUE"},     {2, "CUDA_ERROR_OUT_OF_MEMORY"},
      {100, "CUDA_ERROR_NO_DEVICE"},       {101, "CUDA_ERROR_INVALID_DEVICE"},
      {201, "CUDA_ERROR_INVALID_CONTEXT"}, {218, "CUDA_ERROR_INVALID_PTX"},
      {500, "CUDA_ERROR_NOT_FOUND"},       {701, "CUDA_ERROR_LAUNCH_OUT_OF_RESOURCES"},
      {719, "CUDA_ERROR_LAUNCH_FAILED"},   {999, "CUDA_ERROR_UNKNOWN"}};
  const auto found = names.find(status);
  if (found == names.end()) return invalid_value;
  *name = found->second;
  return 0;
}

int cuDeviceGetCount(int* count) {
  *count = static_cast<int>(setting("cards", 1));
  return 0;
}

int cuDeviceGet(int* device, int number) {
  if (number < 0 || number >= setting("cards", 1)) return 101;
  *device = number;
  return 0;
}

int cuDeviceGetName(char* name, int size, int device) {
  const std::string text = "fake card " + std::to_string(device);
  std::strncpy(name, text.c_str(), static_cast<std::size_t>(size));
  return 0;
}

int cuDeviceGetAttribute(int* value, int attribute, int device) {
  const bool old = device == 0 && setting("old-card");
  if (attribute == 16) *value = static_cast<int>(setting("multiprocessors", 1));
  if (attribute == 75) *value = old ? 7 : 9;
  if (attribute == 76) *value = old ? 5 : 0;
  return attribute == 16 || attribute == 75 || attribute == 76 ? 0 : invalid_value;
}

int cuDeviceTotalMem_v2(std::size_t* size, int) {
  *size = memory();
  return 0;
}

int cuCtxCreate_v2(void** context, unsigned, int device) {
  const std::lock_guard lock(mutex);
  auto* made = new Context{.card = device};
  contexts.insert(made);
  current.push_back(made);
  *context = made;
  return 0;
}

int cuCtxDestroy_v2(void* context) {
  const std::lock_guard lock(mutex);
  auto* c = static_cast<Context*>(context);
  if (contexts.erase(c) == 0) return invalid_context;
  for (Module* m : c->modules) {
    std::erase_if(kernels, [&](const auto& k) { return k.first == m; });
    delete m;
  }
  for (const auto& [address, size] : c->buffers) std::free(address);
  delete c;
  return 0;
}

int cuCtxPushCurrent_v2(void* context) {
  const std::lock_guard lock(mutex);
  auto* c = static_cast<Context*>(context);
  if (!contexts.contains(c)) return invalid_context;
  current.push_back(c);
  return 0;
}

int cuCtxPopCurrent_v2(void** context) {
  if (current.empty()) return invalid_context;
  *context = current.back();
  current.pop_back();
  return 0;
}

int cuCtxSynchronize() {
  const std::lock_guard lock(mutex);
  return !here() ? invalid_context : here()->failed ? 719 : 0;
}

int cuModuleLoadDataEx(void** module, const void* text, unsigned count, int* options,
                       void** values) {
  const std::lock_guard lock(mutex);
  if (!here()) return invalid_context;
  if (setting("load")) {
    for (unsigned i = 0; i < count; ++i)
      if (options[i] == 5)
        std::strcpy(static_cast<char*>(values[i]), "ptxas application ptx input, line 7; error");
    return 218;
  }
  auto* made = new Module{static_cast<const char*>(text)};
  here()->modules.insert(made);
  *module = made;
  return 0;
}

int cuModuleGetFunction(void** function, void* module, const char* name) {
  const std::lock_guard lock(mutex);
  const Kernel kernel = std::strcmp(name, "walk") == 0  ? sinew_walk_on_processor
                        : std::strcmp(name, "add") == 0 ? add
                                                        : nullptr;
  const std::string& text = static_cast<Module*>(module)->text;
  if (!kernel || text.find(".entry " + std::string(name) + "(") == text.npos) return 500;
  kernels[module] = kernel;
  *function = module;  // a module has one kernel
  return 0;
}

int cuMemGetInfo_v2(std::size_t* free, std::size_t* total) {
  const std::lock_guard lock(mutex);
  if (!here()) return invalid_context;
  *total = memory();
  *free = *total - used(here()->card);
  return 0;
}

int cuMemAlloc_v2(unsigned long long* address, std::size_t size) {
  const std::lock_guard lock(mutex);
  if (!here()) return invalid_context;
  if (size > memory() - used(here()->card)) return 2;
  void* made = std::malloc(size);
  here()->buffers[made] = size;
  *address = reinterpret_cast<unsigned long long>(made);
  return 0;
}

int cuMemFree_v2(unsigned long long address) {
  const std::lock_guard lock(mutex);
  void* made = reinterpret_cast<void*>(address);
  if (!here() || here()->buffers.erase(made) == 0) return invalid_value;
  std::free(made);
  return 0;
}

int cuMemcpyHtoD_v2(unsigned long long to, const void* from, std::size_t size) {
  const std::lock_guard lock(mutex);
  if (!here() || !is_within(to, size)) return invalid_value;
  std::memcpy(reinterpret_cast<void*>(to), from, size);
  return 0;
}

int cuMemcpyDtoH_v2(void* to, unsigned long long from, std::size_t size) {
  const std::lock_guard lock(mutex);
  if (!here() || !is_within(from, size)) return invalid_value;
  if (here()->failed) return 719;
  std::memcpy(to, reinterpret_cast<const void*>(from), size);
  return 0;
}

int cuLaunchKernel(void* function, unsigned blocks, unsigned, unsigned, unsigned threads, unsigned,
                   unsigned, unsigned, void*, void** parameters, void**) {
  Kernel kernel = nullptr;
  {
    const std::lock_guard lock(mutex);
    if (!here()) return invalid_context;
    if (setting("launch")) return 701;
    here()->failed = here()->failed || setting("wait");
    if (here()->failed) return 0;
    kernel = kernels.at(function);
  }
  for (long thread = 0; thread < static_cast<long>(blocks) * threads; ++thread)
    kernel(parameters, thread);
  return 0;
}

}  // extern "C"
