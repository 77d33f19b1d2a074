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

  const auto linear = [&](const Recorded& t, const Numbers& z, const Numbers& slopes_of_hidden,
                          Numbers& out) {
    record_linear(jacobian(phi, t, positions(z)), slopes_of_hidden, tapes, out);
  };
  tapes.linear = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    linear(t, z, jacobian(hidden, t, z), out);
  });
  tapes.friction = model.given(Formula::friction);
  tapes.place = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers slopes_of_hidden = jacobian(hidden, t, z);
    linear(t, z, slopes_of_hidden, out);
    const Numbers flow = flow_of(gradient, t, z);
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
