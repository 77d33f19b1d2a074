// The formulas that a system's struct writes: which, how they are called, and how many numbers they read and
// write.
//
// The answers are made of the rows in core/facets/formula_rows.hpp: `names<S, F>` is true where S
// has a member function or template of the formula's name, `writes<S, F, T>` where this can be called as the
// row says with the scalar T.
//
// A template whose signature does not fit would be passed over in silence, and the system would offer less
// than its author wrote. Therefore every name is also looked up whatever its signature. This is done in a
// class that derives from S and from another class with a member of that name: there the name is ambiguous
// exactly where S has one too. A data member of such a name, such as a parameter `field`, is no formula.
#pragma once

#include <concepts>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/formula_rules.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/registry/member_names.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff::detail {

/// What the sizes of formulas are made of: the numbers that a system's struct and its descriptor give.
struct Sizes {
  int n = 0;           // dimension
  int invariants = 0;  // of the descriptor
  int casimirs = 0;    // of the bracket
#define PFAFF_COUNT(name, ...) int name = 0;
#include <pfaff/core/facets/formula_rows.hpp>
};

// What is recorded of a bracket object: its matrix, column by column, or its Casimirs where it has any.
struct BracketMatrix {
  template <class B>
  static constexpr bool offered = true;
  template <class B, class T>
  static void write(const B& bracket, const T& t, In<T> z, Out<T> matrix) {
    const std::size_t size = z.size();
    std::vector<T> covector(size), column(size);
    for (std::size_t j = 0; j < size; ++j) {
      covector.assign(size, T(0));
      covector[j] = T(1);
      bracket.sharp(t, z, In<T>(covector), Out<T>(column));
      for (std::size_t i = 0; i < size; ++i) matrix[i * size + j] = column[i];
    }
  }
};
struct BracketCasimirs {
  template <class B>
  static constexpr bool offered = requires(const B& b) {
    b.casimir_count();
  };
  template <class B, class T>
  static void write(const B& bracket, const T& t, In<T> z, Out<T> values) {
    bracket.casimirs(t, z, values);
  }
};

struct NamedDamping {
  PFAFF_LOOK_UP(damping)
};
struct NamedConstraintEvaluator {
  PFAFF_LOOK_UP(constraint_evaluator)
};
struct NamedPartFlow {
  PFAFF_LOOK_UP(part_flow)
};
struct NamedInitial {
  PFAFF_LOOK_UP(initial)
};

// A row as C++: the author's member whatever its signature, the signature expected over T, a call, and the
// sizes of one In and of one Out. (Without a common base: GCC 12 does not find the alias of a function type
// in a requires-expression, so each says by `origin` which of them it has.)
template <Formula F>
struct Written {
  static constexpr Origin origin = Origin::none;
};
#define PFAFF_FORMULA(name, result, signature, call_text, each_in, each_out, ...)                 \
  template <>                                                                                     \
  struct Written<Formula::name> {                                                                 \
    PFAFF_LOOK_UP(name)                                                                           \
    static constexpr Origin origin = Origin::member;                                              \
    template <class T>                                                                            \
    using Signature = result signature;                                                           \
    template <class S, class... A>                                                                \
    static constexpr auto call(const S& s, A&&... a) -> decltype(s.name(std::forward<A>(a)...)) { \
      return s.name(std::forward<A>(a)...);                                                       \
    }                                                                                             \
    struct Size : Sizes {                                                                         \
      [[nodiscard]] constexpr int reads() const { return each_in; }                               \
      [[nodiscard]] constexpr int writes() const { return each_out; }                             \
    };                                                                                            \
  };
#define PFAFF_BRACKET(name, member, part, each_out, ...)              \
  template <>                                                         \
  struct Written<Formula::name> {                                     \
    PFAFF_LOOK_UP(member)                                             \
    static constexpr Origin origin = Origin::bracket;                 \
    using Part = part;                                                \
    template <class S>                                                \
    static constexpr auto call(const S& s) -> decltype(s.member()) {  \
      return s.member();                                              \
    }                                                                 \
    struct Size : Sizes {                                             \
      [[nodiscard]] constexpr int writes() const { return each_out; } \
    };                                                                \
  };
#include <pfaff/core/facets/formula_rows.hpp>

// Where the parameters of a signature R(A...) over T, which are times, then In, then Out, stand on a tape.
// The first time is the tape's time; the tape's arguments are every In in turn and, last, a second time where
// there is one; its results are every Out in turn.
template <Formula F, class T, class Signature = typename Written<F>::template Signature<T>>
struct Shape;
template <Formula F, class T, class R, class... A>
struct Shape<F, T, R(A...)> {
  static constexpr std::size_t times = (std::size_t{std::is_same_v<A, const T&>} + ...),
                               ins = (std::size_t{std::is_same_v<A, In<T>>} + ...),
                               outs = (std::size_t{std::is_same_v<A, Out<T>>} + ...);

  template <class S>
  static constexpr bool fits = requires(const S& s, std::remove_reference_t<A>&... a) {
    Written<F>::call(s, a...);
    requires std::is_void_v<R> || std::convertible_to<decltype(Written<F>::call(s, a...)), R>;
  };

  template <class S>
  static void write(const S& s, const T& t, In<T> x, Out<T> out) {
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      if constexpr (std::is_void_v<R>) {
        Written<F>::call(s, argument<K, A>(t, x, out)...);
      } else {
        out[0] = Written<F>::call(s, argument<K, A>(t, x, out)...);
      }
    }
    (std::index_sequence_for<A...>());
  }

 private:
  // How many parameters of type B stand before the K-th.
  template <std::size_t K, class B>
  static constexpr std::size_t before() {
    constexpr std::array<bool, sizeof...(A)> same{std::is_same_v<A, B>...};
    std::size_t count = 0;
    for (std::size_t k = 0; k < K; ++k) count += same[k] ? 1 : 0;
    return count;
  }
  template <std::size_t K, class B>
  static B argument(const T& t, In<T> x, Out<T> out) {
    constexpr std::size_t k = before<K, B>();
    if constexpr (std::is_same_v<B, const T&>) {
      if constexpr (k == 0)
        return t;
      else
        return x[x.size() - 1];
    } else if constexpr (std::is_same_v<B, In<T>>) {
      const std::size_t each = (x.size() - (times - 1)) / ins;
      return x.subspan(k * each, each);
    } else {
      const std::size_t each = out.size() / outs;
      return out.subspan(k * each, each);
    }
  }
};

// True where S has a member of the formula's name or, for a formula recorded from a bracket, the member that
// returns this bracket.
template <class S, Formula F>
constexpr bool names = Written<F>::template named<S>;
template <class S, Formula F>
concept ReturnsBracket = requires(const S& s) {
  Written<F>::call(s);
};

template <class S, Formula F, class T>
constexpr bool is_written() {
  if constexpr (Written<F>::origin == Origin::member) {
    return Shape<F, T>::template fits<S>;
  } else if constexpr (Written<F>::origin == Origin::bracket) {
    if constexpr (ReturnsBracket<S, F>)
      return Written<F>::Part::template offered<decltype(Written<F>::call(std::declval<const S&>()))>;
    return false;
  } else {
    return false;
  }
}
/// True where S writes the formula and it can be called with the scalar T.
template <class S, Formula F, class T = Recorded>
constexpr bool writes = is_written<S, F, T>();

/// Calls the formula that S writes with the arguments x and the results `out` of a tape.
template <Formula F, class S, class T>
void write(const S& s, const T& t, In<T> x, Out<T> out) {
  if constexpr (Written<F>::origin == Origin::member) {
    Shape<F, T>::write(s, t, x, out);
  } else {
    Written<F>::Part::write(Written<F>::call(s), t, x, out);
  }
}

/// The numbers that a formula reads and writes.
struct FormulaSize {
  int inputs, outputs;
};
template <Formula F>
constexpr FormulaSize size_of(const Sizes& sizes) {
  using W = Written<F>;
  const typename W::Size size{sizes};
  if constexpr (W::origin == Origin::member) {
    using L = Shape<F, double>;
    return {static_cast<int>(L::ins) * size.reads() + static_cast<int>(L::times) - 1,
            L::outs == 0 ? 1 : static_cast<int>(L::outs) * size.writes()};
  } else {
    return {sizes.n, size.writes()};
  }
}

template <class S>
concept WritesDamping = requires(const S& s) {
  { s.damping() } -> std::convertible_to<Real>;
};
template <class S>
concept WritesConstraintEvaluator = requires(const S& s) {
  s.template constraint_evaluator<Recorded>();
};
template <class S>
concept WritesPartFlow = requires(const S& s, std::size_t part, const double& h, In<double> z,
                                  Out<double> change) {
  { s.part_flow(part, h, z, change) } -> std::same_as<Status>;
};
template <class S>
concept WritesSmallPart = requires {
  { S::small_part } -> std::convertible_to<std::size_t>;
};
template <class S>
concept WritesInitial = requires(const S& s, Out<Recorded> o) {
  s.template initial<Recorded>(o);
};

// For every count X: counts_X<S> is true where S says, by a constant or a member function, how many X there
// are; count_of_X is that number; names_of_X are their names, the author's or the row's letter and a number.
#define PFAFF_COUNT(name, member, names_member, letter)                                             \
  template <class S>                                                                                \
  constexpr bool counts_##name = requires(const S& s) {                                             \
    { s.member() } -> std::convertible_to<int>;                                                     \
  }                                                                                                 \
  || requires {                                                                                     \
    { S::member } -> std::convertible_to<int>;                                                      \
  };                                                                                                \
  template <class S>                                                                                \
  int count_of_##name(const S& s) {                                                                 \
    if constexpr (requires { s.member(); })                                                         \
      return s.member();                                                                            \
    else                                                                                            \
      return S::member;                                                                             \
  }                                                                                                 \
  template <class S>                                                                                \
  std::vector<std::string> names_of_##name(const S& s) {                                            \
    std::vector<std::string> result;                                                                \
    if constexpr (requires { s.names_member(); })                                                   \
      result = s.names_member();                                                                    \
    else                                                                                            \
      for (int k = 1; k <= count_of_##name(s); ++k) result.push_back((letter) + std::to_string(k)); \
    return result;                                                                                  \
  }
#include <pfaff/core/facets/formula_rows.hpp>

/// The members of S by their names, whatever their signatures.
template <class S>
constexpr FormulaMembers named_members() {
  FormulaMembers has;
#define PFAFF_FORMULA(name, ...) has.name = names<S, Formula::name>;
#define PFAFF_COUNT(name, member, ...) has.member = counts_##name<S>;
#include <pfaff/core/facets/formula_rows.hpp>
  has.bracket = names<S, Formula::poisson_tensor>;
  has.symmetric_bracket = names<S, Formula::symmetric_tensor>;
  has.damping = NamedDamping::named<S>;
  has.constraint_evaluator = NamedConstraintEvaluator::named<S>;
  has.part_flow = NamedPartFlow::named<S>;
  has.small_part = WritesSmallPart<S>;
  return has;
}
/// The members of S that a motion of its energy is made of, as far as they can be called with the scalar T.
template <class S, class T = Recorded>
constexpr FormulaMembers energy_members() {
  using enum Formula;
  FormulaMembers has;
  has.kinetic = writes<S, kinetic, T>;
  has.potential = writes<S, potential, T>;
  has.hamiltonian = writes<S, hamiltonian, T>;
  has.bracket = writes<S, poisson_tensor>;
  has.damping = WritesDamping<S>;
  return has;
}

}  // namespace pfaff::detail
