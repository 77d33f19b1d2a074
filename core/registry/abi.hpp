// The ABI stamp: an ELF note in every plug-in's file, read before the file is loaded.
//
// Loading a shared object already runs its registrars, so compatibility is decided from the file: Pfaff's
// number, the compiler, the language standard, the vector alignment (which Eigen's alignment follows), the
// standard library's strings and containers, the sign of char, the sizes of enumerations and the packing of
// structs, and what would change the numbers of the whole process: fast-math (whose start-up code flushes
// subnormals to zero) and sanitizers. Every translation unit of a plug-in leaves its own note and all of them
// must agree, so that one old object file in a new plug-in is found. Libraries that a plug-in depends on are
// not looked at: link what registers anything into the plug-in itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pfaff/core/registry/version.hpp>

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

#ifdef __CHAR_UNSIGNED__
#define PFAFF_ABI_CHAR "unsigned"
#else
#define PFAFF_ABI_CHAR "signed"
#endif

/// "key=value" words; two files fit together when all of them are equal. What only the compiler knows, not
/// its preprocessor, is a '?' here, which make_abi_note replaces.
#define PFAFF_ABI_WORDS \
  "pfaff=" PFAFF_VERSION_TEXT " compiler=" PFAFF_ABI_COMPILER " standard=" PFAFF_ABI_TEXT(__cplusplus) \
  " alignment=" PFAFF_ABI_TEXT(__BIGGEST_ALIGNMENT__) " strings=" PFAFF_ABI_TEXT(_GLIBCXX_USE_CXX11_ABI) \
  " containers=" PFAFF_ABI_CONTAINERS " char=" PFAFF_ABI_CHAR " enum=? packing=?" \
  " arithmetic=" PFAFF_ABI_ARITHMETIC " sanitizer=" PFAFF_ABI_SANITIZER

namespace pfaff {

/// The layout of an ELF note: the sizes of owner and text and a type, then owner and text themselves, each
/// padded to four bytes.
template <std::size_t size>
struct AbiNote {
  std::uint32_t owner_size, text_size, type;
  char owner[8];
  char text[(size + 3) / 4 * 4];
};

/// The note with these words, whose question marks are replaced, in order, by the sizes, below ten.
template <std::size_t size, std::size_t count>
constexpr AbiNote<size> make_abi_note(const char (&words)[size], const std::size_t (&sizes)[count]) {
  AbiNote<size> note{sizeof("Pfaff"), size, 1, "Pfaff", {}};
  std::size_t next = 0;
  for (std::size_t k = 0; k < size; ++k)
    note.text[k] = words[k] == '?' ? static_cast<char>('0' + sizes[next++]) : words[k];
  return note;
}

// What -fshort-enums and -fpack-struct change: the size of an enumeration that names no type, and where a
// number stands behind a character.
enum AbiEnumeration { abi_enumerator };
struct AbiPacking {
  char character;
  double number;
};

/// One in every translation unit that includes a plug-in header; kept although nothing refers to it.
[[gnu::used, gnu::section(".note.pfaff"), gnu::aligned(4)]] static constexpr AbiNote<sizeof(PFAFF_ABI_WORDS)>
    abi_note = make_abi_note(PFAFF_ABI_WORDS, {sizeof(AbiEnumeration), sizeof(AbiPacking) - sizeof(double)});

/// The stamp of this library.
std::string own_abi_stamp();

/// The stamps in a shared object, one from each of its translation units, without loading it. InputError for
/// files that cannot be read, are no shared objects or are not whole.
std::vector<std::string> abi_stamps(const std::string& path);

/// InputError unless the file has a stamp and every stamp in it is this library's; names what differs.
void require_same_abi(const std::string& path);

}  // namespace pfaff
