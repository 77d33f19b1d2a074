#include <pfaff/core/facets/joined_velocity_constraints.hpp>

#include <algorithm>
#include <initializer_list>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;

// The pattern of S: that of S_h, the entries of C, and all of S_v.
std::shared_ptr<const SymmetricPattern> pattern_of(const Model& model, const JoinedTapes& tapes) {
  const auto constraints = model.holonomic_constraints<double>();
  const std::size_t n = tapes.degrees;
  // A point that no symmetry leaves where it is: an entry that is zero there is zero everywhere.
  std::vector<double> z(2 * n), placed(tapes.place->outputs.size()), row(n), column(tapes.holonomic);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double turn = 0.6180339887498949 * static_cast<double>(k + 1);
    const std::size_t point = k / 2;
    z[k] = static_cast<double>(point) + turn - static_cast<double>(static_cast<std::size_t>(turn));
  }
  Replay<double> place(tapes.place);
  place(0.5, z.data(), placed.data());
  (void)constraints->linearise(0.5, In<double>(z).first(n), In<double>(z).subspan(n));
  std::vector<SymmetricPattern::Coupling> couplings = constraints->pattern().couplings();
  for (std::size_t i = 0; i < tapes.count; ++i) {
    std::fill(row.begin(), row.end(), 0.0);
    for (std::size_t e = tapes.rows.begin[i]; e < tapes.rows.begin[i + 1]; ++e)
      row[tapes.rows.columns[e]] = placed[e];
    constraints->hidden_by_momentum(row, column);
    for (std::size_t k = 0; k < tapes.holonomic; ++k)
      if (column[k] != 0) couplings.emplace_back(k, tapes.holonomic + i);
    for (std::size_t j = 0; j < i; ++j) couplings.emplace_back(tapes.holonomic + j, tapes.holonomic + i);
  }
  return std::make_shared<const SymmetricPattern>(tapes.holonomic + tapes.count, std::move(couplings));
}

// The inputs that tapes read, in ascending order.
std::vector<std::size_t> inputs_of(std::initializer_list<const Tape*> tapes) {
  std::vector<std::size_t> read;
  for (const Tape* tape : tapes)
    for (const Instruction& i : tape->code)
      if (i.operation == Operation::input) read.push_back(static_cast<std::size_t>(i.a));
  std::sort(read.begin(), read.end());
  read.erase(std::unique(read.begin(), read.end()), read.end());
  return read;
}
}  // namespace

JoinedTapes record_joined(const Model& model) {
  const auto a = model.tape(Formula::velocity_constraints), b = model.tape(Formula::velocity_offsets),
             gradient = model.tape(Formula::hamiltonian_gradient);
  JoinedTapes tapes;
  const std::size_t n = tapes.degrees = static_cast<std::size_t>(a->inputs),
                    m = tapes.count = b->outputs.size();
  tapes.holonomic = model.tape(Formula::holonomic)->outputs.size();
  const int inputs = static_cast<int>(2 * n);
  const auto positions = [&](const Numbers& z) { return std::span<const Recorded>(z).first(n); };
  tapes.values = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers slopes = evaluate(*gradient, t, z), rows = evaluate(*a, t, positions(z)),
                  offsets = evaluate(*b, t, positions(z));
    for (std::size_t i = 0; i < m; ++i) {
      Recorded sum = offsets[i];
      for (std::size_t k = 0; k < n; ++k) sum = sum + rows[i * n + k] * slopes[n + k];
      out.push_back(sum);
    }
  });
  const Tape& psi = *tapes.values;
  tapes.place = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers rows = evaluate(*a, t, positions(z)), slopes = jacobian(psi, t, z);
    tapes.rows = record_sparse({rows, m, n, n, 0}, out);
    tapes.by_momentum = record_sparse({slopes, m, n, 2 * n, n}, out);
    tapes.by_position = record_sparse({slopes, m, n, 2 * n, 0}, out);
    append(out, evaluate(psi, t, z));
    append(out, directional_derivative(psi, t, Recorded(1), z, Numbers(2 * n)));
  });
  std::vector<SymmetricPattern::Coupling> all;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j) all.emplace_back(i, j);
  tapes.dense = std::make_shared<const SymmetricPattern>(m, std::move(all));
  tapes.read = inputs_of({tapes.values.get(), tapes.place.get()});
  tapes.pattern = pattern_of(model, tapes);
  return tapes;
}

}  // namespace pfaff
