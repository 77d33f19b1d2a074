// The ABI stamp: an ELF note in every plug-in's file, read before the file is loaded.
//
// Loading a shared object already runs its registrars, so compatibility is decided from the file: Pfaff's
// number, the compiler, the language standard, the vector alignment (what Eigen's alignment follows), the
// standard library's strings and containers, and what would change the numbers of the whole process:
// fast-math (whose start-up code flushes subnormals to zero) and sanitizers. Every translation unit of a
// plug-in leaves its own note and all of them must agree, so that one old object file in a new plug-in is
// found. Libraries that a plug-in depends on are not looked at: link what registers anything into the plug-in
// itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pfaff/core/version.hpp>

#define PFAFF_ABI_TEXT_(x) #x
#define PFAFF_ABI_TEXT(x) PFAFF_ABI_TEXT_(x)
#ifdef __clang__
#define PFAFF_ABI_COMPILER "clang-" PFAFF_ABI_TEXT(__clang_major__)
#else
#define PFAFF_ABI_COMPILER "gcc-" PFAFF_ABI_TEXT(__GNUC__)
#endif
#if defined(_GLIBCXX_DEBUG)
#define PFAFF_ABI_CONTAINERS "debug"
#else
#define PFAFF_ABI_CONTAINERS "plain"
#endif
#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__
#define PFAFF_ABI_ARITHMETIC "fast"
#else
#define PFAFF_ABI_ARITHMETIC "strict"
#endif
#if defined(__SANITIZE_ADDRESS__)
#define PFAFF_ABI_SANITIZER "address"
#elif defined(__SANITIZE_THREAD__)
#define PFAFF_ABI_SANITIZER "thread"
#else
#define PFAFF_ABI_SANITIZER "none"
#endif

/// "key=value" words; two files fit together when all of them are equal.
#define PFAFF_ABI_STAMP \
  "pfaff=" PFAFF_VERSION_TEXT " compiler=" PFAFF_ABI_COMPILER " standard=" PFAFF_ABI_TEXT(__cplusplus) \
  " alignment=" PFAFF_ABI_TEXT(__BIGGEST_ALIGNMENT__) " strings=" PFAFF_ABI_TEXT(_GLIBCXX_USE_CXX11_ABI) \
  " containers=" PFAFF_ABI_CONTAINERS " arithmetic=" PFAFF_ABI_ARITHMETIC " sanitizer=" PFAFF_ABI_SANITIZER

namespace pfaff {

/// The layout of an ELF note: sizes of owner and text, type, then both, each padded to four bytes.
template <std::size_t size>
struct AbiNote {
  std::uint32_t owner_size, text_size, type;
  char owner[8];
  char text[(size + 3) / 4 * 4];
};

/// One in every translation unit that includes a plug-in header; kept although nothing refers to it.
[[gnu::used, gnu::section(".note.pfaff"), gnu::aligned(4)]] static constexpr AbiNote<sizeof(PFAFF_ABI_STAMP)>
    abi_note{sizeof("Pfaff"), sizeof(PFAFF_ABI_STAMP), 1, "Pfaff", PFAFF_ABI_STAMP};

/// The stamps in a shared object, one from each of its translation units, without loading it. InputError for
/// files that cannot be read or are none.
std::vector<std::string> abi_stamps(const std::string& path);

/// InputError unless the file has a stamp and every stamp in it is this library's; names what differs.
void require_same_abi(const std::string& path);

}  // namespace pfaff
