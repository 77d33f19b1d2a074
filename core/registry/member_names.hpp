// Members looked up by name, whatever their signature.
//
// An optional member of a plug-in is used where it can be called as expected. One whose signature does not
// fit would be passed over in silence, and the plug-in would do less than its author wrote. So each name is
// looked up by itself: in a class derived from S and from another class with a member of that name, the name
// is ambiguous exactly where S has one too. A struct that is looked at this way must not be final.
#pragma once

#include <type_traits>

namespace pfaff::members {

template <class Pointer>
concept PointsToData = std::is_member_object_pointer_v<Pointer> ||
    (std::is_pointer_v<Pointer>&& std::is_object_v<std::remove_pointer_t<Pointer>>);

template <class S, class Named>
struct Joined : S, Named {};

}  // namespace pfaff::members

/// For use inside a struct: two constants for the name of a member, has<S>, true where S has one of any kind
/// (function, template, data, type), and named<S>, true where it has one that is no data.
#define PFAFF_LOOK_UP(member)                                      \
  struct Named {                                                   \
    int member;                                                    \
  };                                                               \
  template <class S>                                               \
  static constexpr bool has = !requires {                          \
    &::pfaff::members::Joined<S, Named>::member;                   \
  };                                                               \
  template <class S>                                               \
  static constexpr bool named = has<S> && !requires {              \
    requires ::pfaff::members::PointsToData<decltype(&S::member)>; \
  };

/// The same for the namespace where it stands: has_NAME<S> and names_NAME<S>.
#define PFAFF_MEMBER_NAME(name)                              \
  struct Named_##name {                                      \
    PFAFF_LOOK_UP(name)                                      \
  };                                                         \
  template <class S>                                         \
  constexpr bool has_##name = Named_##name::template has<S>; \
  template <class S>                                         \
  constexpr bool names_##name = Named_##name::template named<S>;
