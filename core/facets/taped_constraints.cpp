#include <pfaff/core/facets/taped_constraints.hpp>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/sparse_gradients.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;

// The columns first .. first + columns - 1 of sparse rows.
SparseRecorded columns_of(const std::vector<SparseGradient>& rows, std::size_t first, std::size_t columns) {
  SparseRecorded part;
  for (const SparseGradient& row : rows) {
    for (const auto& entry : row)
      if (entry.first >= first && entry.first < first + columns)
        part.push_back(entry.first - first, entry.second);
    part.end_row();
  }
  return part;
}
}  // namespace

HolonomicTapes record_holonomic(const Model& model) {
  HolonomicFormulas formulas;
  formulas.values = model.tape(Formula::holonomic);
  formulas.degrees = static_cast<std::size_t>(formulas.values->inputs);
  formulas.gradient = slopes_of_motion(model);
  if (model.given(Formula::friction)) formulas.friction = model.tape(Formula::friction);
  return record_holonomic(formulas);
}

HolonomicTapes record_holonomic(const HolonomicFormulas& formulas) {
  HolonomicTapes tapes;
  tapes.values = formulas.values;
  const Tape& phi = *tapes.values;
  const std::size_t n = tapes.degrees = formulas.degrees;
  tapes.count = phi.outputs.size();
  tapes.parameters = formulas.parameters;
  const int inputs = static_cast<int>(2 * n + tapes.parameters);
  tapes.gradient = formulas.gradient;
  const Tape& gradient = *tapes.gradient;
  // What phi is evaluated at: q and the parameters.
  const auto position = [&](const Numbers& z) {
    Numbers at(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
    at.insert(at.end(), z.begin() + static_cast<std::ptrdiff_t>(2 * n), z.end());
    return at;
  };

  tapes.hidden = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers slopes = evaluate(gradient, t, z);
    Numbers velocity(slopes.begin() + static_cast<std::ptrdiff_t>(n), slopes.end());
    velocity.resize(n + tapes.parameters);
    append(out, directional_derivative(phi, t, Recorded(1), position(z), velocity));
  });
  const Tape& hidden = *tapes.hidden;

  tapes.friction = formulas.friction != nullptr;

  // The tape of a whole placement begins with the entries of B, P and S, and is recorded on from there.
  Recorder recorder(inputs);
  const Recorded t = recorder.time();
  const Numbers z = recorder.inputs();
  Numbers out;
  const std::vector<SparseGradient> slopes_of_hidden = sparse_gradients(hidden, t, z, 2 * n);
  const SparseRecorded by_momentum = columns_of(slopes_of_hidden, n, n);
  record_linear(columns_of(sparse_gradients(phi, t, position(z), n), 0, n), by_momentum, tapes, out);
  tapes.linear = std::make_shared<const Tape>(recorder.finish(out));

  Numbers flow = flow_of(gradient, t, z);
  append(out, flow);
  append(out, evaluate(phi, t, position(z)));
  append(out, evaluate(hidden, t, z));
  flow.resize(2 * n + tapes.parameters);
  append(out, directional_derivative(hidden, t, Recorded(1), z, flow));
  tapes.hidden_by_position = record_sparse(columns_of(slopes_of_hidden, 0, n), out);
  const Numbers lambda = tapes.friction ? evaluate(*formulas.friction, t, z) : Numbers(n);
  append(out, lambda);
  tapes.friction_pattern = record_gram(by_momentum, by_momentum, lambda, out);
  tapes.place = std::make_shared<const Tape>(recorder.finish(out));
  return tapes;
}

}  // namespace pfaff
