#include "kernel/engine/gpu/open_cl_library.h"

#include <dlfcn.h>

#include <optional>

namespace voxmelt::gpu {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

// The library stays loaded, since drivers end threads of their own when the program does.
std::optional<OpenClLibrary> loaded() {
  void* const library = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return {};
  OpenClLibrary all;
  bool whole = true;
#define VOXMELT_FIND(name) whole = find(library, #name, all.name) && whole;
  VOXMELT_OPEN_CL_FUNCTIONS(VOXMELT_FIND)
#undef VOXMELT_FIND
  if (!whole) return {};
  return all;
}

}  // namespace

const OpenClLibrary* open_cl_library() {
  static const std::optional<OpenClLibrary> library = loaded();
  return library ? &*library : nullptr;
}

}  // namespace voxmelt::gpu
