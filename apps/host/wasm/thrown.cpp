// SPDX-License-Identifier: MIT
// Exceptions where nothing unwinds: what is thrown goes to the page as text, which drops the
// instance. Thrown are refusals of files (ReadFailure) and lack of memory.
#include <cstdlib>
#include <string>
#include <typeinfo>

#include "topology/io/text/scan.hpp"

extern "C" {

/// Ends the call into the instance with an error of JavaScript; never comes back.
[[noreturn, clang::import_module("sunder"), clang::import_name("thrown")]] void sunder_thrown(
    const char* text, std::size_t size);

void* __cxa_allocate_exception(std::size_t size) noexcept { return std::malloc(size); }

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, void (*)(void*)) {
  if (*type == typeid(sunder::io::ReadFailure)) {
    const sunder::Finding& finding = static_cast<sunder::io::ReadFailure*>(object)->finding;
    const std::string text = finding.text + "; " + finding.remedy;
    sunder_thrown(text.data(), text.size());
  }
  const std::string name = type->name();
  sunder_thrown(name.data(), name.size());
}

/// The one thread of an instance ends with it: nothing is to be destroyed.
int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }

}  // extern "C"
