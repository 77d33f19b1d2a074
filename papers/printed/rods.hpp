// Nguyen & Turski, section 4 and appendices A and B, as printed (with the index of (B.1)-(B.3) corrected): a
// chain of beads on rigid rods, and the same chain hanging from the origin.
#pragma once

#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

/// N beads at a state in d dimensions, the last of which points up. Rod k of a chain joins beads k and k + 1;
/// rod 0 of a pendulum joins the origin and bead 0, rod k beads k - 1 and k.
struct Rods {
  using Numbers = std::vector<Quad>;

  bool pendulum = false;
  std::size_t dimension = 2;
  Numbers masses, lengths, friction;  // N; one per rod; N coefficients Lambda_i
  Quad gravity = 0;
  Numbers q, p;

  [[nodiscard]] std::size_t beads() const { return masses.size(); }
  [[nodiscard]] std::size_t count() const { return lengths.size(); }  // K

  /// v_i = p_i / m_i.
  [[nodiscard]] Numbers velocity() const;
  /// -dH/dq of the weights alone.
  [[nodiscard]] Numbers force() const;
  /// The friction coefficient of each component, Lambda_i for those of bead i.
  [[nodiscard]] Numbers coefficients() const;

  /// Delta r_k and Delta v_k of a rod, from the first of its beads to the second; r_1 and v_1 of the rod that
  /// hangs from the origin.
  [[nodiscard]] Numbers link(std::size_t k) const { return along(k, q); }
  [[nodiscard]] Numbers link_velocity(std::size_t k) const { return along(k, velocity()); }

  /// phi and phi~, (4.4) and (B.1)-(B.3) corrected.
  [[nodiscard]] Numbers constraints() const;
  [[nodiscard]] Numbers hidden_constraints() const;
  /// (B.1)-(B.3) as printed, with Delta r_k = r_k - r_{k+1} in phi_k: of the rods 1 to N - 1, because r_{N+1}
  /// of the last rod does not exist.
  [[nodiscard]] Numbers constraints_as_printed() const;
  [[nodiscard]] Numbers hidden_constraints_as_printed() const;

  /// S with the entries of table 1 or, of a pendulum, (B.5), with the lengths of the rods as printed: on the
  /// surface phi = 0.
  [[nodiscard]] Table<Quad> table_s() const;
  /// A and S^D of a chain, tables 1 and 2.
  [[nodiscard]] Table<Quad> table_a() const;
  [[nodiscard]] Table<Quad> table_s_friction() const;

  /// dphi/dq, dphi~/dq and dphi~/dp, rows for the constraints.
  [[nodiscard]] Table<Quad> phi_by_q() const;
  [[nodiscard]] Table<Quad> hidden_by_q() const;
  [[nodiscard]] Table<Quad> hidden_by_p() const;

 private:
  [[nodiscard]] Numbers along(std::size_t k, const Numbers& x) const;
  /// +1 and -1 of the beads that a rod joins.
  [[nodiscard]] int sign(std::size_t k, std::size_t bead) const;
  [[nodiscard]] Table<Quad> spread(bool velocities, bool over_mass) const;
};

inline Quad dot(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  Quad sum(0);
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// The equations of motion of section 4 and appendix A at the state of `rods`.
class Motion {
 public:
  using Numbers = std::vector<Quad>;
  explicit Motion(const Rods& rods);

  /// W of (4.1), phi before phi~, and its inverse by the blocks of (4.1).
  [[nodiscard]] Table<Quad> w() const;
  [[nodiscard]] Table<Quad> w_inverse() const;

  /// (q', p') of (4.2), with its last line, the friction, or without.
  [[nodiscard]] Numbers dirac(bool with_friction) const;
  /// (q', p') of (4.7).
  [[nodiscard]] Numbers simplified(bool with_friction) const;
  /// -lambda_i [ .. ], the last line of (4.2) and (4.7).
  [[nodiscard]] Numbers friction() const;

  /// G_k of (A.3), lambda below (A.4), and (q', p') of (A.5), for F without friction.
  [[nodiscard]] Numbers second_derivatives() const;
  [[nodiscard]] Numbers multipliers() const;
  [[nodiscard]] Numbers lagrange() const;
  /// B^T q' of (A.2).
  [[nodiscard]] Numbers first_derivatives() const;
  /// G + B^T M^-1 F, {phi~, H}.
  [[nodiscard]] Numbers hidden_rates() const;
  /// B lambda of (A.1), the force of the constraints with its sign turned.
  [[nodiscard]] Numbers reactions() const;

 private:
  Rods rods_;
  Numbers v_, f_, lambda_;                    // velocities, -dH/dq, friction coefficients
  Table<Quad> b_, t_, p_;                     // dphi/dq, dphi~/dq, dphi~/dp
  Table<Quad> s_, a_, friction_, s_inverse_;  // {phi, phi~}, {phi~, phi~}, W^D = <phi~, phi~>
  Numbers hidden_;                            // phi~
};

}  // namespace pfaff::printed
