// The motion of a model with constraints at one point, computed in quad and straight from the definitions
// with dense matrices. The right-hand sides of formulations are compared with it.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/conformance/dense_constraints.hpp>
#include <pfaff/core/facets/conformance/dense_velocity_constraints.hpp>
#include <pfaff/core/formulation.hpp>

namespace pfaff {

class DenseMotion {
 public:
  explicit DenseMotion(const Model& model);

  void place(Quad t, const std::vector<Quad>& z);

  /// The right-hand side that a formulation's statement defines; empty where the statement defines nothing
  /// here. For holonomic constraints it is made with the statement's reactions and friction. For velocity
  /// constraints it is Lagrange and d'Alembert's motion where the statement has ideal reactions, and
  /// vakonomic motion where it makes an energy, both by saddle-point systems. For constraints phi(z, t) = 0
  /// of the phase space with hamiltonian reactions it is nguyen-turski (1.2) word for word, Pi dH - X_i
  /// (W^-1)_ij (dphi_j Pi dH + d_t phi_j) with X_i = Pi dphi_i, plus the same expression for the symmetric
  /// bracket, over those constraints that are no Casimirs of it.
  [[nodiscard]] std::vector<Quad> field(const FormulationStatement& statement);

  /// The field without constraints and friction.
  [[nodiscard]] std::vector<Quad> free_field() const;
  /// dH.
  [[nodiscard]] std::vector<Quad> energy_gradient() const;

  /// The largest rates phi', phi~', psi' and H' along a field and the largest A q' + b, each relative to the
  /// sum of the sizes of its terms and of what the rounding of the field amounts to in it, `bounds` being
  /// those of its components in units of round-off; zero where there is no such thing. phi~' belongs to
  /// holonomic constraints alone, since among velocity constraints it is one of the psi'. The explicit
  /// dependence of H on time is left out.
  struct Rates {
    double constraints = 0, hidden = 0, velocities = 0, energy = 0, inadmissible = 0;
  };
  [[nodiscard]] Rates rates(const std::vector<Quad>& field, const std::vector<Quad>& bounds) const;

 private:
  struct PhaseSpace {
    explicit PhaseSpace(const Model& model);
    Replay<Quad> gradients, moving, poisson, slope;
    std::vector<Replay<Quad>> symmetric,
        entropy;  // each with one entry, or none where the system has no such bracket
    Matrix<Quad> rows{0, 0}, pi{0, 0}, g{0, 0};
    std::vector<Quad> shift, energy,
        direction;  // d_t phi; dH; the covector that the symmetric bracket acts on
    void place(Quad t, const std::vector<Quad>& z);
    [[nodiscard]] std::vector<Quad> projected(const Matrix<Quad>& tensor, const std::vector<Quad>& covector,
                                              const std::vector<Quad>& shift) const;
  };

  [[nodiscard]] Rates rates_of_velocities(const std::vector<Quad>& field,
                                          const std::vector<Quad>& bounds) const;

  std::vector<Quad> state_;
  std::unique_ptr<DenseConstraints> holonomic_;
  std::unique_ptr<DenseVelocityConstraints> velocities_;
  std::unique_ptr<PhaseSpace> phase_space_;
};

}  // namespace pfaff
