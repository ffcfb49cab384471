#include "sinew/host/module.h"

#include <dlfcn.h>

#include <filesystem>

namespace sinew::host {

namespace fs = std::filesystem;

void* open_module(const char* file) {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& path : {program / SINEW_MODULES / file, fs::path(file)})
    if (void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
  return nullptr;
}

void* function_of(void* module, const char* name) { return dlsym(module, name); }

}  // namespace sinew::host
