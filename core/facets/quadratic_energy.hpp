// Whether the Hamiltonian of a canonical model is quadratic in the momenta, and steady in time.
#pragma once

namespace pfaff {

class Model;

/// True where H_p is linear in p up to a constant, so that H has a mass matrix, which may depend on positions
/// and time, and terms linear in p. It is found from values in quad at momenta of three sizes, about the
/// initial positions at t = 0 and at a time at which a factor t does not vanish.
bool quadratic_in_momenta(const Model& model);

/// True where the kinetic energy of a separable model does not depend on time.
bool steady_kinetic_energy(const Model& model);

}  // namespace pfaff
