// SPDX-License-Identifier: MIT
// Counting by the address sanitizer's hooks, or by standing in front of the C library's malloc;
// zlib's functions are wrapped by the linker (--wrap).
#include "counted_memory.hpp"

#include <malloc.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__)
#define SUNDER_HOOKS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SUNDER_HOOKS 1
#endif
#endif

namespace sunder::test {
namespace {

struct Counter {
  MemoryCount count;
  std::size_t bound = 0;
  std::size_t times = 0;
  bool is_on = false;
};
constinit thread_local Counter counter;

void add(std::size_t bytes) {
  if (!counter.is_on) return;
  MemoryCount& c = counter.count;
  c.live += static_cast<std::ptrdiff_t>(bytes);
  c.peak = std::max(c.peak, c.live);
  if (counter.bound == 0) return;
  if (c.live > static_cast<std::ptrdiff_t>(counter.bound + counter.times * c.unfolded)) {
    counter.is_on = false;  // allocations for the report are not counted
    std::abort();
  }
}

void subtract(std::size_t bytes) {
  if (counter.is_on) counter.count.live -= static_cast<std::ptrdiff_t>(bytes);
}

}  // namespace

void begin_counting(std::size_t bound, std::size_t times) {
  counter = {};
  counter.bound = bound;
  counter.times = times;
  counter.is_on = true;
}

MemoryCount end_counting() {
  counter.is_on = false;
  return counter.count;
}

}  // namespace sunder::test

// Shared libraries have to find these functions too.
#pragma GCC visibility push(default)
extern "C" {

int __real_inflate(z_streamp stream, int flush);
int __wrap_inflate(z_streamp stream, int flush) {
  const uInt before = stream->avail_out;
  const int status = __real_inflate(stream, flush);
  sunder::test::counter.count.unfolded += before - stream->avail_out;
  return status;
}

#ifdef SUNDER_HOOKS

int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                              void (*on_free)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void* block);

}  // extern "C"

namespace {
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t bytes) { sunder::test::add(bytes); },
    [](const volatile void* block) {
      if (block != nullptr) sunder::test::subtract(__sanitizer_get_allocated_size(block));
    });
}  // namespace

#else

void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t items, std::size_t bytes);
void* __libc_realloc(void* block, std::size_t bytes);
void __libc_free(void* block);

void* malloc(std::size_t bytes) {
  void* const block = __libc_malloc(bytes);
  sunder::test::add(malloc_usable_size(block));
  return block;
}

void* calloc(std::size_t items, std::size_t bytes) {
  void* const block = __libc_calloc(items, bytes);
  sunder::test::add(malloc_usable_size(block));
  return block;
}

void* realloc(void* block, std::size_t bytes) {
  const std::size_t before = malloc_usable_size(block);
  void* const moved = __libc_realloc(block, bytes);
  if (moved == nullptr && bytes != 0) return nullptr;
  sunder::test::add(malloc_usable_size(moved));
  sunder::test::subtract(before);
  return moved;
}

void free(void* block) {
  sunder::test::subtract(malloc_usable_size(block));
  __libc_free(block);
}

}  // extern "C"

#endif

#pragma GCC visibility pop
