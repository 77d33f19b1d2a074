// The forms of collocation that registered methods step by.
#include <tuple>

#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>

namespace pfaff::detail {

template <class T>
std::unique_ptr<CollocationForm<Problem<T>>> registered_form(const GaussCoefficients& tableau,
                                                             const Problem<T>& p) {
  return chosen_form<dynamic>(tableau, p);
}

// Emits them for every scalar of the list.
template <class List>
struct FormInstances;
template <class... T>
struct FormInstances<Scalars<T...>> {
  static constexpr std::tuple all{&registered_form<T>...};
};
template struct FormInstances<ScalarsHere<StepScalars>>;

}  // namespace pfaff::detail
