#include <pfaff/app/heap.hpp>

#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace pfaff::app {

void use_large_pages() {
#ifdef __GLIBC__
  constexpr int reserve = 64 << 20, largest_from_the_heap = 32 << 20;  // the most that malloc accepts
  constexpr std::uintptr_t large_page = 2 << 20;
  mallopt(M_MMAP_THRESHOLD, largest_from_the_heap);
  mallopt(M_TRIM_THRESHOLD, 2 * reserve);
  mallopt(M_TOP_PAD, reserve);
  // More than is left of the heap, so that it is extended; it keeps the addresses when this is given back.
  void* extended = std::malloc(large_page);
  const auto begin = reinterpret_cast<std::uintptr_t>(extended) / large_page * large_page + large_page;
  std::free(extended);
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
  if (begin < end && end - begin <= 2 * std::uintptr_t{reserve})
    (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace pfaff::app
