#include <pfaff/tests/generating/generating_evolution.hpp>

#include <algorithm>

#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {

using EvolutionArguments = std::span<const Recorded>;
using EvolutionResults = std::span<Recorded>;
using Formulas = std::vector<Recorded>;

// J x = (x_p, -x_q), the inverse of K_c.
Formulas canonical(const Formulas& x) {
  const std::size_t half = x.size() / 2;
  Formulas result(x.size());
  for (std::size_t i = 0; i < half; ++i) {
    result[i] = x[half + i];
    result[half + i] = -x[i];
  }
  return result;
}

}  // namespace

AlphaTapes chart_alpha(const Model& model) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  const auto chart = model.tape(Formula::chart), inverse = model.tape(Formula::chart_inverse);
  return {record(2 * n + 1, 2 * n,
                 [&](const Recorded& t, EvolutionArguments x, EvolutionResults out) {
                   const auto after = evaluate(*chart, t, x.first(size));
                   const auto before = evaluate(*chart, x[2 * size], x.subspan(size, size));
                   Formulas difference(size);
                   for (std::size_t k = 0; k < size; ++k) {
                     difference[k] = after[k] - before[k];
                     out[size + k] = (after[k] + before[k]) / Recorded(2);
                   }
                   const auto turned = canonical(difference);  // -K_c = J
                   std::copy(turned.begin(), turned.end(), out.begin());
                 }),
          record(2 * n + 1, 2 * n, [&](const Recorded& t, EvolutionArguments x, EvolutionResults out) {
            const auto half = canonical(Formulas(x.begin(), x.begin() + n));
            Formulas after(size), before(size);
            for (std::size_t k = 0; k < size; ++k) {
              after[k] = x[size + k] - half[k] / Recorded(2);
              before[k] = x[size + k] + half[k] / Recorded(2);
            }
            const auto new_z = evaluate(*inverse, t, after), old_z = evaluate(*inverse, x[2 * size], before);
            std::copy(new_z.begin(), new_z.end(), out.begin());
            std::copy(old_z.begin(), old_z.end(), out.begin() + n);
          })};
}

Tape evolution(const Model& model, const AlphaTapes& alpha) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  // K^-1 (grad B + F_t), from F and B where there are any, whatever else the author wrote.
  const auto derived = model.derived(Formula::field);
  const auto field = derived != nullptr ? derived : model.tape(Formula::field);
  return record(2 * n + n * n + 1, n, [&](const Recorded& t, EvolutionArguments u, EvolutionResults out) {
    const EvolutionArguments states_of_alpha = u.first(2 * size);
    Formulas pair(states_of_alpha.begin(), states_of_alpha.end());
    pair.push_back(u.back());
    auto states = evaluate(alpha.backward, t, pair);
    const auto rate = evaluate(*field, t, EvolutionArguments(states).first(size));
    states.push_back(u.back());
    // (A K^-1 g + d_t alpha_1, C K^-1 g + d_t alpha_2): alpha along the flow of z' at fixed z.
    Formulas direction(2 * size + 1);
    std::copy(rate.begin(), rate.end(), direction.begin());
    const auto total = directional_derivative(alpha.forward, t, Recorded(1), states, direction);
    for (std::size_t i = 0; i < size; ++i) {
      out[i] = total[i];
      for (std::size_t j = 0; j < size; ++j) out[i] = out[i] - u[2 * size + i * size + j] * total[size + j];
    }
  });
}

Tape scalar_evolution(const Model& model, const AlphaTapes& alpha, const Tape& exact_part) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  return record(2 * n + 1, 1, [&](const Recorded& t, EvolutionArguments u, EvolutionResults out) {
    auto states = evaluate(alpha.backward, t, u);
    const auto energy =
        evaluate(*model.tape(Formula::birkhoffian), t, EvolutionArguments(states).first(size));
    states.push_back(u.back());
    const auto explicit_rate = time_derivative(alpha.forward, t, states);
    out[0] = time_derivative(exact_part, t, states)[0] - energy[0];
    for (std::size_t k = 0; k < size; ++k) out[0] = out[0] - u[k] * explicit_rate[size + k];
  });
}

Tape scalar_evolution(const Tape& chart_hamiltonian) {
  const int n = chart_hamiltonian.inputs;
  return record(2 * n + 1, 1, [&](const Recorded& t, EvolutionArguments u, EvolutionResults out) {
    const auto half = canonical(Formulas(u.begin(), u.begin() + n));
    Formulas y(half.size());
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = u[y.size() + k] - half[k] / Recorded(2);
    out[0] = -evaluate(chart_hamiltonian, t, y)[0];
  });
}

}  // namespace pfaff
