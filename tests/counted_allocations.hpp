// Counts the allocations of a test program and their bytes: its global operator new counts while counting is
// switched on.
//
// Include it in one source of a program only, since it defines the global operators.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace pfaff::testing {
inline std::atomic<bool> counting = false;
inline std::atomic<long> allocations = 0, bytes = 0;

inline void* allocate_or_null(std::size_t size, std::size_t alignment) noexcept {
  if (counting) {
    ++allocations;
    bytes += static_cast<long>(size);
  }
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  return alignment <= alignof(std::max_align_t) ? std::malloc(size == 0 ? 1 : size)
                                                : std::aligned_alloc(alignment, whole);
}
inline void* allocate(std::size_t size, std::size_t alignment) {
  void* memory = allocate_or_null(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// The number of allocations that work() makes.
template <class Work>
long allocations_of(Work&& work) {
  allocations = 0;
  counting = true;
  work();
  counting = false;
  return allocations;
}
/// The bytes that work() asks for, those that it gives back included.
template <class Work>
long bytes_of(Work&& work) {
  bytes = 0;
  allocations_of(work);
  return bytes;
}
}  // namespace pfaff::testing

// The array forms call these. Not inlined, so that the compiler does not see malloc and free in place of new
// and delete where only one of them is.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return pfaff::testing::allocate(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return pfaff::testing::allocate(size, static_cast<std::size_t>(alignment));
}
// The standard library asks with these for room it can do without (std::stable_sort), and gives it back to
// the delete below: the address sanitizer must not see its own new there.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return pfaff::testing::allocate_or_null(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment,
                                     const std::nothrow_t& /*tag*/) noexcept {
  return pfaff::testing::allocate_or_null(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/,
                                       std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
