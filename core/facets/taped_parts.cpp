#include <pfaff/core/facets/taped_parts.hpp>

#include <cstddef>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

void record_linear(const SparseRecorded& rows, const SparseRecorded& by_momentum, LinearTapes& tapes,
                   std::vector<Recorded>& out) {
  tapes.rows = record_sparse(rows, out);
  tapes.by_momentum = record_sparse(by_momentum, out);
  tapes.pattern = record_gram(rows, by_momentum, {}, out);
}

std::shared_ptr<const Tape> slopes_of_motion(const Model& model) {
  auto gradient = model.tape(Formula::hamiltonian_gradient);
  if (!model.forced()) return gradient;
  const auto force = model.tape(Formula::applied_force);
  return std::make_shared<const Tape>(
      record(gradient->inputs, gradient->inputs, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        const std::vector<Recorded> slopes = evaluate(*gradient, t, z), applied = evaluate(*force, t, z);
        std::copy(slopes.begin(), slopes.end(), out.begin());
        for (std::size_t k = 0; k < applied.size(); ++k) out[k] = out[k] - applied[k];
      }));
}

std::vector<Recorded> flow_of(const Tape& gradient, const Recorded& t, const std::vector<Recorded>& z) {
  const std::vector<Recorded> slopes = evaluate(gradient, t, z);
  const std::size_t n = slopes.size() / 2;
  std::vector<Recorded> flow(slopes.begin() + static_cast<std::ptrdiff_t>(n), slopes.end());
  for (std::size_t k = 0; k < n; ++k) flow.push_back(-slopes[k]);
  return flow;
}

}  // namespace pfaff
