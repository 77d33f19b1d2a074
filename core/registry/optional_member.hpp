// An optional member of a plug-in kind, said in one place: its name, how it is called, and the words with
// which the compiler refuses one of its name that cannot be called so.
#pragma once

#include <pfaff/core/registry/member_names.hpp>

/// For the namespace of a kind, with a requirement on a struct S, such as
///   PFAFF_OPTIONAL_MEMBER(count, "int count() const", (const S& s) { { s.count() } -> std::same_as<int>; })
/// has_NAME<S> and names_NAME<S> as of PFAFF_MEMBER_NAME, writes_NAME<S> where S has the member as required,
/// and check_NAME<S>(), which refuses another one.
#define PFAFF_OPTIONAL_MEMBER(name, expected, ...)                                   \
  PFAFF_MEMBER_NAME(name)                                                            \
  template <class S>                                                                 \
  constexpr bool writes_##name = requires __VA_ARGS__;                               \
  template <class S>                                                                 \
  constexpr void check_##name() {                                                    \
    static_assert(writes_##name<S> || !has_##name<S>, #name ": expected " expected); \
  }
