#include "hwmodel/fabric/process.h"

// libsystemc's own main needs this symbol. Ours never calls it.
int sc_main(int, char**) { return 1; }

// SystemC never frees its pools, which is no leak of ours. (Only the address sanitizer calls this.)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libsystemc"; }

namespace voxmelt::hwmodel {

Context::Context() : own_(new sc_core::sc_simcontext) { enter(); }
Context::~Context() {
  delete own_;
  leave();
}
void Context::enter() { sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = own_; }
void Context::leave() {
  sc_core::sc_curr_simcontext = outer_;
  sc_core::sc_default_global_context = outer_default_;
}

}  // namespace voxmelt::hwmodel
