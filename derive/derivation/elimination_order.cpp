#include <pfaff/derive/derivation/elimination_order.hpp>

#include <algorithm>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/derive/derivation/engines.hpp>
#include <pfaff/derive/derivation/witness.hpp>

namespace pfaff {

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

// The canonical brackets of all constraints at a generic point.
Matrix<double> brackets_at_a_point(const std::shared_ptr<const HolonomicTapes>& tapes,
                                   const SymbolicFormulas& source) {
  std::vector<double> parameters, z;
  for (const Real& x : source.values) parameters.push_back(x.value());
  TapedConstraints<double> constraints(tapes, parameters);
  const std::size_t n = constraints.degrees();
  for (const Real& x : generic_numbers(2 * n)) z.push_back(x.value());
  BracketRates<RecursiveVectorsDirac, double> bracket(constraints);
  (void)bracket.place(0, In<double>(z).first(n), In<double>(z).subspan(n));
  const std::vector<double>& gradients = bracket.gradients();
  const std::size_t width = 2 * n, count = width > 0 ? gradients.size() / width : 0;
  Matrix<double> w(count, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const double *a = gradients.data() + i * width, *b = gradients.data() + j * width;
      for (std::size_t k = 0; k < n; ++k) w(i, j) += a[k] * b[n + k] - a[n + k] * b[k];
    }
  return w;
}

}  // namespace

std::vector<std::size_t> elimination_order(const std::shared_ptr<const HolonomicTapes>& tapes,
                                           const SymbolicFormulas& source, const Model& model,
                                           const std::vector<std::string>& names) {
  std::vector<std::size_t> order;
  if (names.empty()) return order;
  const std::vector<std::string> known = model.constraint_names();
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw InputError("elimination: " + unknown_name("constraint", name, known));
    const auto place = static_cast<std::size_t>(found - known.begin());
    if (std::find(order.begin(), order.end(), place) != order.end())
      throw InputError("elimination: constraint " + name + " stands there twice");
    order.push_back(place);
  }
  if (order.size() != known.size())
    throw InputError("elimination: expected all " + std::to_string(known.size()) + " constraints, got " +
                     std::to_string(order.size()));
  const PlainRecursion<double> recursion =
      plain_recursion(brackets_at_a_point(tapes, source), Symmetry::skew, order);
  if (!recursion.works)
    throw InputError("system " + model.name() +
                     ": elimination: " + describe(recursion, Symmetry::skew, order, known) +
                     "; an order that works: " + joined(known));
  return order;
}

}  // namespace pfaff
