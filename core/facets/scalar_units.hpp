// Compilation units by scalars: for which scalars one compilation of a source makes code.
//
// Methods and programs step in doubles and in quads, each with and without derivatives (StepScalars), and
// formulas are put on tapes by one more scalar. Code in doubles has to be fast. Quads spend their time in
// their arithmetic, which is compiled elsewhere, and descriptions and recordings are used once: optimising
// what calls them takes a build longer than all the rest and gains little. The build therefore compiles the
// source of a plug-in twice: the unit `InDouble` is optimised and makes code in doubles alone, the unit
// `InOthers` is not, makes all the rest and registers the plug-in. The author of the plug-in notices nothing
// of it, and a source that is compiled once makes code for every scalar.
//
// Types in unnamed namespaces have no names by which a linker could join the two units. Each unit therefore
// leaves the addresses of its code under the names of the types, which are the same in both, while the
// library is loaded, and whoever needs code of the other unit asks for it. These names must differ within a
// library, as names of structs of plug-ins do.
#pragma once

#include <type_traits>
#include <typeinfo>
#include <utility>

#include <pfaff/core/facets/scalars.hpp>

namespace pfaff::detail {

/// Compiled once, for every scalar.
struct InAll {
  template <class T>
  static constexpr bool makes = true;
};
/// Scalars of doubles, with and without derivatives.
template <class T>
constexpr bool of_doubles = std::is_same_v<Value<T>, double>;

/// The optimised one of two compilations: code in doubles.
struct InDouble {
  template <class T>
  static constexpr bool makes = of_doubles<T>;
};
/// The other: code in the other scalars, and registrations.
struct InOthers {
  template <class T>
  static constexpr bool makes = !of_doubles<T>;
};

#if defined(PFAFF_IN_OTHER_SCALARS)
using ThisUnit = InOthers;
#elif defined(PFAFF_IN_DOUBLE)
using ThisUnit = InDouble;
#else
using ThisUnit = InAll;
#endif

/// The scalars of a list that this unit makes code for.
template <class List, class Unit = ThisUnit, class Kept = Scalars<>>
struct ScalarsOfUnit;
template <class Unit, class Kept>
struct ScalarsOfUnit<Scalars<>, Unit, Kept> {
  using type = Kept;
};
template <class T, class... Rest, class Unit, class Kept>
struct ScalarsOfUnit<Scalars<T, Rest...>, Unit, Kept> {
  using type =
      typename ScalarsOfUnit<Scalars<Rest...>, Unit,
                             typename std::conditional_t<Unit::template makes<T>, WithScalar<Kept, T>,
                                                         std::type_identity<Kept>>::type>::type;
};
template <class List>
using ScalarsHere = typename ScalarsOfUnit<List>::type;

/// In place of a registration in the unit that registers nothing.
struct NotRegistered {
  template <class... Arguments>
  explicit NotRegistered(const Arguments&... /*arguments*/) {}
};
/// A registration where a unit makes them.
template <class Registration>
using RegisteredHere = std::conditional_t<std::is_same_v<ThisUnit, InDouble>, NotRegistered, Registration>;

/// The address of a function of any type.
using AnyFunction = void (*)();
/// Leaves the code by which objects of the type `made_by` make something for `scalar`.
void leave_code(const std::type_info& made_by, const std::type_info& scalar, AnyFunction code);
/// The code that was left; std::logic_error, naming the type, where none was.
AnyFunction code_left(const std::type_info& made_by, const std::type_info& scalar);

/// An Interface, derived from a Maker, whose make_for calls Self's template made<T>(args...) for every T that
/// this unit makes code for; what it has for the others comes from the other unit.
template <class Self, class Interface, class Unit = ThisUnit, class Makes = typename Interface::Makes>
class MakerInUnits;
template <class Self, class Interface, class Unit, template <class> class Made, class... Args>
class MakerInUnits<Self, Interface, Unit, Maker<Made, Scalars<>, Args...>> : public Interface {};
template <class Self, class Interface, class Unit, template <class> class Made, class T, class... Rest,
          class... Args>
class MakerInUnits<Self, Interface, Unit, Maker<Made, Scalars<T, Rest...>, Args...>>
    : public MakerInUnits<Self, Interface, Unit, Maker<Made, Scalars<Rest...>, Args...>> {
 public:
  using MakerInUnits<Self, Interface, Unit, Maker<Made, Scalars<Rest...>, Args...>>::make_for;
  [[nodiscard]] Made<T> make_for(std::type_identity<T> /*scalar*/, Args... args) const final {
    const Self& self = static_cast<const Self&>(*this);
    if constexpr (Unit::template makes<T>) {
      return self.template made<T>(std::move(args)...);
    } else {
      using Code = Made<T> (*)(const Self&, Args...);
      return reinterpret_cast<Code>(code_left(typeid(Self), typeid(T)))(self, std::move(args)...);  // NOLINT
    }
  }
};

/// Leaves a function for others to find, where this unit makes code for T.
template <class Self, class T, class Function>
void leave(Function code) {
  leave_code(typeid(Self), typeid(T), reinterpret_cast<AnyFunction>(code));  // NOLINT
}
template <class Self, template <class> class Made, class... T, class... Args>
void leave_code_for(std::type_identity<Maker<Made, Scalars<T...>, Args...>> /*makes*/) {
  const auto one = []<class U>(std::type_identity<U> /*scalar*/) {
    if constexpr (ThisUnit::makes<U>)
      leave<Self, U>(+[](const Self& self, Args... args) -> Made<U> {
        return self.template made<U>(std::move(args)...);
      });
  };
  (one(std::type_identity<T>()), ...);
}
/// Leaves the code by which a Self makes what its interface asks for; in a unit that makes all, nothing.
template <class Self>
void leave_code_of() {
  if constexpr (!std::is_same_v<ThisUnit, InAll>)
    leave_code_for<Self>(std::type_identity<typename Self::Makes>());
}

/// Leaves the code of several types, as a static object.
template <class... Self>
struct CodeOf {
  CodeOf() { (leave_code_of<Self>(), ...); }
};

}  // namespace pfaff::detail

namespace pfaff {
/// The same for a Self that is compiled once, for every scalar.
template <class Self, class Interface>
using MakerOf = detail::MakerInUnits<Self, Interface, detail::InAll>;
}  // namespace pfaff
