// A formula of a problem at several stages side by side: divisions and roots of all of them cost little more
// than those of one, and a call through a pointer is paid once for all. Each lane has the bits that its stage
// would have alone.
//
// A static problem has the formula as a member for packs, which is inlined. Any other problem is asked for an
// evaluator (Problem::in_lanes); it may have none for this model. Evaluations are not counted here.
#pragma once

#include <cstddef>
#include <type_traits>

#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

namespace detail {
/// The lanes of a pack; 0 for other types.
template <class L>
inline constexpr int lanes_of = 0;
template <int W>
inline constexpr int lanes_of<Pack<W>> = W;

// Has P a member for the formula F with the scalar L?
template <Formula F, class P, class L>
constexpr bool written_in_lanes() {
  if constexpr (lanes_of<L> == 0)
    return false;
  else if constexpr (F == Formula::force)
    return requires(const P& p, const L& t, In<L> x, Out<L> out) { p.force(t, x, out); };
  else if constexpr (F == Formula::velocity)
    return requires(const P& p, const L& t, In<L> x, Out<L> out) { p.velocity(t, x, out); };
  else
    return requires(const P& p, const L& t, In<L> x, Out<L> out) { p.field(t, x, out); };
}
// Can P be asked for an evaluator with the scalar L?
template <class P, class L>
constexpr bool asked_in_lanes() {
  if constexpr (lanes_of<L> == 0)
    return false;
  else
    return requires(const P& p) { p.template in_lanes<lanes_of<L>>(Formula::field); };
}
}  // namespace detail

/// Formula F, one of field, force and velocity, of a problem of type P with the scalar L.
template <Formula F, class P, class L>
class FormulaInLanes {
 public:
  /// Is it a member of the problem, whose code is inlined?
  static constexpr bool inlined = detail::written_in_lanes<F, P, L>();
  /// Can a problem of this type offer it?
  static constexpr bool possible = inlined || detail::asked_in_lanes<P, L>();

  FormulaInLanes(const P& p, std::size_t stages) : several_(stages > 1) {
    if constexpr (!inlined && possible)
      if (several_) found_ = p.template in_lanes<detail::lanes_of<L>>(F);
  }
  /// Does the problem offer it, and are there several stages?
  [[nodiscard]] bool offered() const {
    if constexpr (inlined)
      return several_;
    else if constexpr (possible)
      return found_.call != nullptr;
    else
      return false;
  }
  [[gnu::always_inline]] void operator()(const P& p, const L& t, In<L> x,
                                         Out<L> out) const requires possible {
    if constexpr (!inlined) {
      found_.call(found_.context, t, x.data(), out.data());
    } else if constexpr (F == Formula::force) {
      p.force(t, x, out);
    } else if constexpr (F == Formula::velocity) {
      p.velocity(t, x, out);
    } else {
      p.field(t, x, out);
    }
  }

 private:
  struct Nothing {};
  bool several_;
  std::conditional_t<!inlined && possible, Evaluator<L>, Nothing> found_;
};

}  // namespace pfaff
