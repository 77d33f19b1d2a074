#include <pfaff/core/facets/taped_constraints.hpp>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;
}  // namespace

HolonomicTapes record_holonomic(const Model& model) {
  HolonomicTapes tapes;
  tapes.values = model.tape(Formula::holonomic);
  const Tape& phi = *tapes.values;
  const std::size_t n = tapes.degrees = static_cast<std::size_t>(phi.inputs);
  const std::size_t count = tapes.count = phi.outputs.size();
  const int inputs = static_cast<int>(2 * n);
  tapes.gradient = model.tape(Formula::hamiltonian_gradient);
  const Tape& gradient = *tapes.gradient;
  const auto positions = [&](const Numbers& z) { return std::span<const Recorded>(z).first(n); };

  tapes.hidden = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers slopes = evaluate(gradient, t, z);
    append(out, directional_derivative(phi, t, Recorded(1), positions(z),
                                       std::span<const Recorded>(slopes).subspan(n)));
  });
  const Tape& hidden = *tapes.hidden;

  // The entries of B, P and S. The tape of a whole placement begins with the same.
  const auto linear = [&](const Recorded& t, const Numbers& z, const Numbers& slopes_of_hidden,
                          Numbers& out) {
    const Numbers b = jacobian(phi, t, positions(z));
    const RecordedMatrix by_position{b, count, n, n, 0}, by_momentum{slopes_of_hidden, count, n, 2 * n, n};
    tapes.by_position = record_sparse(by_position, out);
    tapes.by_momentum = record_sparse(by_momentum, out);
    tapes.pattern = record_gram(by_position, by_momentum, {}, out);
  };
  tapes.linear = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    linear(t, z, jacobian(hidden, t, z), out);
  });
  tapes.friction = model.given(Formula::friction);
  tapes.place = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers slopes_of_hidden = jacobian(hidden, t, z);
    linear(t, z, slopes_of_hidden, out);
    const Numbers slopes = evaluate(gradient, t, z);
    Numbers flow(slopes.begin() + static_cast<std::ptrdiff_t>(n), slopes.end());
    for (std::size_t k = 0; k < n; ++k) flow.push_back(-slopes[k]);
    append(out, flow);
    append(out, evaluate(phi, t, positions(z)));
    append(out, evaluate(hidden, t, z));
    append(out, directional_derivative(hidden, t, Recorded(1), z, flow));
    tapes.hidden_by_position = record_sparse({slopes_of_hidden, count, n, 2 * n, 0}, out);
    const Numbers lambda = tapes.friction ? evaluate(*model.tape(Formula::friction), t, z) : Numbers(n);
    append(out, lambda);
    const RecordedMatrix by_momentum{slopes_of_hidden, count, n, 2 * n, n};
    tapes.friction_pattern = record_gram(by_momentum, by_momentum, lambda, out);
  });
  return tapes;
}

}  // namespace pfaff
