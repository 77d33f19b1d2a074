#include <pfaff/app/heap.hpp>

#include <cstddef>
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
  constexpr std::ptrdiff_t large_page = 2 << 20;
  mallopt(M_MMAP_THRESHOLD, largest_from_the_heap);
  mallopt(M_TRIM_THRESHOLD, 2 * reserve);
  mallopt(M_TOP_PAD, reserve);
  // More than is left of the heap, so that it is extended; it keeps the addresses when this is given back.
  auto* extended = static_cast<char*>(std::malloc(large_page));
  if (extended == nullptr) return;
  char* begin =
      extended +
      (large_page - static_cast<std::ptrdiff_t>(reinterpret_cast<std::uintptr_t>(extended) % large_page));
  const std::ptrdiff_t size = static_cast<char*>(sbrk(0)) - begin;
  if (size > 0 && size <= 2 * std::ptrdiff_t{reserve})
    (void)madvise(begin, static_cast<std::size_t>(size), MADV_HUGEPAGE);
  std::free(extended);
#endif
}

}  // namespace pfaff::app
