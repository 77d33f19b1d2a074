#include <pfaff/core/facets/taped_constraints.hpp>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;

// The entries of a K x n matrix that are not zero by construction, appended to `out`.
SparseRows sparse(const Numbers& matrix, std::size_t rows, std::size_t stride, std::size_t first,
                  std::size_t columns, Numbers& out) {
  SparseRows result;
  for (std::size_t i = 0; i < rows; ++i) {
    result.begin.push_back(result.columns.size());
    for (std::size_t j = 0; j < columns; ++j) {
      const Recorded& x = matrix[i * stride + first + j];
      if (structurally_zero(x)) continue;
      result.columns.push_back(j);
      out.push_back(x);
    }
  }
  result.begin.push_back(result.columns.size());
  return result;
}

// Puts the entries sum_a x_ia weight_a y_ja with j >= i on the tape, the diagonal first and the couplings,
// those that are not zero by construction, after it. Returns where the couplings are.
std::shared_ptr<const SymmetricPattern> gram(const Numbers& x, std::size_t x_stride, std::size_t x_first,
                                             const Numbers& y, std::size_t y_stride, std::size_t y_first,
                                             const Numbers& weight, std::size_t rows, std::size_t columns,
                                             Numbers& out) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  Numbers diagonal, couplings;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = i; j < rows; ++j) {
      Recorded sum(0);
      for (std::size_t a = 0; a < columns; ++a) {
        const Recorded& left = x[i * x_stride + x_first + a];
        const Recorded& right = y[j * y_stride + y_first + a];
        if (structurally_zero(left) || structurally_zero(right)) continue;
        sum = sum + (weight.empty() ? left * right : left * weight[a] * right);
      }
      if (i == j) {
        diagonal.push_back(sum);
      } else if (!structurally_zero(sum)) {
        places.emplace_back(i, j);
        couplings.push_back(sum);
      }
    }
  out.insert(out.end(), diagonal.begin(), diagonal.end());
  out.insert(out.end(), couplings.begin(), couplings.end());
  return std::make_shared<const SymmetricPattern>(rows, std::move(places));
}

// A tape whose number of outputs is found while it is recorded.
template <class F>
std::shared_ptr<const Tape> record_list(int inputs, F&& formula) {
  Recorder recorder(inputs);
  const Numbers x = recorder.inputs();
  Numbers out;
  formula(recorder.time(), x, out);
  return std::make_shared<const Tape>(recorder.finish(out));
}

void append(Numbers& out, const Numbers& more) { out.insert(out.end(), more.begin(), more.end()); }
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
    tapes.by_position = sparse(b, count, n, 0, n, out);
    tapes.by_momentum = sparse(slopes_of_hidden, count, 2 * n, n, n, out);
    tapes.pattern = gram(b, n, 0, slopes_of_hidden, 2 * n, n, {}, count, n, out);
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
    tapes.hidden_by_position = sparse(slopes_of_hidden, count, 2 * n, 0, n, out);
    const Numbers lambda = tapes.friction ? evaluate(*model.tape(Formula::friction), t, z) : Numbers(n);
    append(out, lambda);
    tapes.friction_pattern =
        gram(slopes_of_hidden, 2 * n, n, slopes_of_hidden, 2 * n, n, lambda, count, n, out);
  });
  return tapes;
}

}  // namespace pfaff
