// The ABI stamp: one line of text in every plug-in's file, read before the file is loaded.
//
// Loading a shared object already runs its registrars, so compatibility is decided from the bytes of the file:
// Pfaff's number, the compiler, the language standard and the vector alignment (what Eigen's alignment follows).
#pragma once

#include <pfaff/core/version.hpp>

#define PFAFF_ABI_TEXT_(x) #x
#define PFAFF_ABI_TEXT(x) PFAFF_ABI_TEXT_(x)
#ifdef __clang__
#define PFAFF_ABI_COMPILER "clang-" PFAFF_ABI_TEXT(__clang_major__)
#else
#define PFAFF_ABI_COMPILER "gcc-" PFAFF_ABI_TEXT(__GNUC__)
#endif

/// What precedes the stamp in the file.
#define PFAFF_ABI_MARK "pfaff-abi-stamp: "
#define PFAFF_ABI_STAMP                                                                               \
  "pfaff=" PFAFF_VERSION_TEXT " compiler=" PFAFF_ABI_COMPILER " standard=" PFAFF_ABI_TEXT(__cplusplus) \
  " alignment=" PFAFF_ABI_TEXT(__BIGGEST_ALIGNMENT__)

namespace pfaff {
/// One copy in every file that includes a plug-in header; kept although nothing refers to it.
[[gnu::used]] static constexpr char abi_stamp[] = PFAFF_ABI_MARK PFAFF_ABI_STAMP;
}  // namespace pfaff
