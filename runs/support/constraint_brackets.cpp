#include <pfaff/runs/support/constraint_brackets.hpp>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

template <class T>
ConstraintBrackets<T> constraint_brackets(const Model& model, const T& t, const std::vector<T>& z) {
  const auto values_of = [&](const std::shared_ptr<const Tape>& tape) {
    std::vector<T> out(tape->outputs.size());
    Replay<T> replay(tape);
    replay(t, z.data(), out.data());
    return out;
  };
  const std::size_t n = z.size();
  const auto phi = model.tape(Formula::constraints);
  const std::size_t count = phi->outputs.size();
  const auto rates = std::make_shared<const Tape>(
      record(phi->inputs, static_cast<int>(count),
             [&](const Recorded& s, std::span<const Recorded> x, std::span<Recorded> out) {
               const auto slopes = time_derivative(*phi, s, x);
               std::copy(slopes.begin(), slopes.end(), out.begin());
             }));
  ConstraintBrackets<T> result{values_of(phi),
                               values_of(rates),
                               Matrix<T>(count, values_of(model.tape(Formula::constraint_gradients))),
                               Matrix<T>(n, values_of(model.tape(Formula::poisson_tensor))),
                               Matrix<T>(count, count),
                               true,
                               {}};
  Matrix<T> sizes(count, count);  // for each W_ij the sum of |terms|, which bounds its rounding error
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const T left = result.gradients(i, a) * result.tensor(a, b);
        if (left == T(0)) continue;
        for (std::size_t j = 0; j < count; ++j) {
          const T term = left * result.gradients(j, b);
          result.brackets(i, j) = result.brackets(i, j) + term;
          sizes(i, j) = sizes(i, j) + abs(term);
        }
      }
  const std::initializer_list<const std::vector<T>*> all{
      &result.values, &result.rates, &result.gradients.entries(), &result.tensor.entries(),
      &result.brackets.entries()};
  for (const auto* numbers : all)
    for (const T& x : *numbers) result.finite = result.finite && isfinite(x);
  if (result.finite) result.classes = classify(result.brackets, Symmetry::skew, result.gradients, sizes);
  return result;
}

template ConstraintBrackets<double> constraint_brackets(const Model&, const double&,
                                                        const std::vector<double>&);
template ConstraintBrackets<Quad> constraint_brackets(const Model&, const Quad&, const std::vector<Quad>&);

}  // namespace pfaff
