// Derivation: how a formula that its author did not write follows from others, as a tape.
//
// A formula may have several; they stand in arrays by family, each beside its mathematics in a header of this
// folder, and the first that applies is taken (derivations.cpp). Conditions look at Model::content(), what
// the formulas make, and not at Model::facets(), which leaves out what is not true of a constrained motion.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

/// One way to derive a formula. `from` lists the formulas it is made of, and Formula::count in the places
/// that are left where these are fewer than three.
struct Derivation {
  Formula of;
  std::array<Formula, 3> from;
  bool (*applies)(const Model& model);
  std::shared_ptr<const Tape> (*make)(const Model& model);
};

namespace derivations {

inline constexpr Formula none = Formula::count;

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

template <Facet F>
bool has(const Model& model) {
  return model.content().has(F);
}
/// True where the formula is written or can be derived.
template <Formula F>
bool gives(const Model& model) {
  return model.given(F) || derivation_of(F, model) != nullptr;
}

inline std::shared_ptr<const Tape> shared(Tape tape) { return std::make_shared<const Tape>(std::move(tape)); }

inline void copy(const std::vector<Recorded>& from, Results to) {
  for (std::size_t k = 0; k < from.size(); ++k) to[k] = from[k];
}
inline std::vector<Recorded> gradient_of(const Tape& scalar, const Recorded& t, Arguments z) {
  const std::vector<Recorded> one{Recorded(1)};
  return gradient(scalar, t, z, one);
}
/// J v for the canonical bracket on (q, p): (v_p, -v_q).
inline void canonical_sharp(Arguments covector, Results vector) {
  const std::size_t half = covector.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    vector[k] = covector[half + k];
    vector[half + k] = -covector[k];
  }
}
/// The canonical matrix, row-major, n x n: [[0, upper], [-upper, 0]].
inline std::shared_ptr<const Tape> canonical_matrix(const Model& model, int upper) {
  const int n = model.dimension();
  return shared(record(n, n * n, [&](const Recorded&, Arguments z, Results out) {
    for (std::size_t k = 0, size = z.size(); k < size / 2; ++k) {
      out[k * size + size / 2 + k] = Recorded(upper);
      out[(size / 2 + k) * size + k] = Recorded(-upper);
    }
  }));
}
/// d out_i / d z_j of another formula.
template <Formula F>
std::shared_ptr<const Tape> jacobian_of(const Model& model) {
  return shared(jacobian_tape(*model.tape(F)));
}

}  // namespace derivations
}  // namespace pfaff
