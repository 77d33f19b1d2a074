// Whether an invariant that is called quadratic is a polynomial of degree two in the state.
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

std::shared_ptr<const Tape> third_difference(const Tape& values, std::size_t k) {
  return expression(values.inputs, 1, [&](const Recorded& t, Arguments z, Results out) {
    const auto at = [&](int steps) {
      std::vector<Recorded> moved(z.begin(), z.end());
      for (std::size_t i = 0; i < moved.size(); ++i)
        moved[i] = moved[i] +
                   Recorded(Real::fraction(std::int64_t{steps} * static_cast<std::int64_t>(5 + i % 7), 64));
      return evaluate(values, t, moved)[k];
    };
    out[0] = at(3) - 3 * at(2) + 3 * at(1) - at(0);
  });
}

bool is_quadratic(const Model& model, std::size_t invariant) {
  const auto difference = third_difference(*model.tape(Formula::invariants), invariant);
  return largest<Quad>(difference, model.initial()) <= residual_tolerance<Quad>();
}

}  // namespace pfaff
