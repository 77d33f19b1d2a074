// The table of facets and formulas: one row each, from which everything else that knows them is made.
//
// An X-macro, included without a guard by whoever defines the macros whose rows it reads; the others expand
// to nothing, and all are undefined at the end. Readers: the enumerators, names and `formula_table`
// (facet.hpp), which members there are (formula_rules.hpp), what a system's struct writes
// (written_formulas.hpp) and what is refused (system_formulas.hpp), how it is recorded (collector.hpp), the
// members of a problem (problem.hpp), the names of constraints (model.hpp).
//
//   PFAFF_FACET(name, "text", "meaning", "operation")
//       the operation, where there is one, is a member of the author's struct that belongs to the facet and
//       is no formula, because it iterates or may fail
//   PFAFF_COUNT(name, member, names, "letter")
//       a number that sizes are made of, the author's constant or member function `member`; what is counted
//       is called by the author's `names()`, or by the letter and a number
//   PFAFF_VALUE(name, x, reads, ...)
//       T name(t, x)
//   PFAFF_MAP(name, x, reads, out, writes, ...)
//       void name(t, x, out)
//   PFAFF_FORMULA(name, result, (signature), (call), reads, writes, ...)
//       any other signature over T: one or two times, then In, then Out; `reads` and `writes` are the sizes
//       of one In and of one Out
//   PFAFF_BRACKET(name, member, part, writes, ...)
//       recorded from the object that the author's member() returns: its BracketMatrix, its BracketCasimirs
//   PFAFF_DERIVED(name, reads, writes, ...)
//       never written, always derived
//
// Sizes are expressions in n (the dimension), invariants, casimirs and the counts. What follows them are
// FormulaTraits, designated, in the order of their members. A formula's tape has the time first, then every
// In, and a second time last. How a formula is derived that is not written: core/facets/derivations/. A new
// row goes where it belongs; the numbers of facets and formulas move with it, and plug-ins are rebuilt.

// clang-format off
#ifndef PFAFF_FACET
#define PFAFF_FACET(...)
#endif
#ifndef PFAFF_COUNT
#define PFAFF_COUNT(...)
#endif
#ifndef PFAFF_FORMULA
#define PFAFF_FORMULA(...)
#endif
#ifndef PFAFF_BRACKET
#define PFAFF_BRACKET(...)
#endif
#ifndef PFAFF_DERIVED
#define PFAFF_DERIVED(...)
#endif
#define PFAFF_VALUE(name, x, reads, ...) \
  PFAFF_FORMULA(name, T, (const T& t, In<T> x), (t, x), reads, 1, __VA_ARGS__)
#define PFAFF_MAP(name, x, reads, out, writes, ...) \
  PFAFF_FORMULA(name, void, (const T& t, In<T> x, Out<T> out), (t, x, out), reads, writes, __VA_ARGS__)

PFAFF_FACET(vector_field, "vector-field", "dz/dt = X(z, t)")
PFAFF_FACET(hamiltonian, "hamiltonian", "an energy and the bracket that makes X of it")
PFAFF_FACET(separable, "separable", "canonical, H = T(p, t) + V(q, t)")
PFAFF_FACET(conformal, "conformal", "q' = T_p(p, t), p' = -V_q(q, t) - nu p: the canonical structure times e^{nu t} is kept")
PFAFF_FACET(structure, "structure", "K(z, t) zdot + D(z, t) = 0, self-adjoint: K skew and closed, d_t K = D_z - D_z^T")
PFAFF_FACET(birkhoffian, "birkhoffian", "that of the action of F(z, t).dz - B(z, t) dt: K = dF, D = -(grad B + F_t)")
PFAFF_FACET(darboux_chart, "darboux-chart", "coordinates y in which the structure is constant and canonical")
PFAFF_FACET(generating_map, "generating-map", "alpha of pairs of states, through which generating functions make maps")
PFAFF_FACET(holonomic, "holonomic", "canonical, with constraints phi(q, t) = 0")
PFAFF_FACET(constraints, "constraints", "an energy and a bracket, with constraints phi(z, t) = 0 that are second class")
PFAFF_FACET(velocity_constraints, "velocity-constraints", "canonical, with constraints A(q, t) v + b(q, t) = 0 of the velocities v = H_p")
PFAFF_FACET(metriplectic, "metriplectic", "an energy with two brackets, Poisson's and a symmetric one; an entropy or none")
PFAFF_FACET(invariants, "invariants", "named quantities with their expected behaviour")
PFAFF_FACET(exact_solution, "exact-solution", "the flow in closed form")
PFAFF_FACET(exact_flows, "exact-flows", "X is a sum of parts X_k(z), each of which is solved exactly", "part_flow")

PFAFF_COUNT(constraints, constraint_count, constraint_names, "phi")
PFAFF_COUNT(velocity_constraints, velocity_constraint_count, velocity_constraint_names, "psi")
PFAFF_COUNT(parts, part_count, part_names, "part-")

// The vector field X and dX_i / dz_j, row-major.
PFAFF_MAP(field, z, n, rate, n, .compiled = true, .in_lanes = true, .offered_by = facets(Facet::vector_field), .counts = Counts::field)
PFAFF_DERIVED(field_jacobian, n, n * n, .offered_by = facets(Facet::vector_field), .counts = Counts::jacobian)
// The energy H, its gradient, and the tensor Pi(z, t), row-major, with X = Pi grad H.
PFAFF_VALUE(hamiltonian, z, n, .offered_by = facets(Facet::hamiltonian), .part_of = facets(Facet::constraints, Facet::metriplectic))
PFAFF_DERIVED(hamiltonian_gradient, n, n, .part_of = facets(Facet::hamiltonian))
PFAFF_BRACKET(poisson_tensor, bracket, BracketMatrix, n * n, .offered_by = facets(Facet::hamiltonian), .part_of = facets(Facet::constraints, Facet::metriplectic))
// What the bracket keeps whatever the energy: Pi grad C = 0. Where it says how many, casimir_count(), and which,
// casimirs(t, z, values).
PFAFF_BRACKET(casimirs, bracket, BracketCasimirs, casimirs, .part_of = facets(Facet::hamiltonian))
// H = T(p, t) + V(q, t), the force -dV/dq and the velocity dT/dp.
PFAFF_VALUE(kinetic, p, n / 2, .part_of = facets(Facet::separable, Facet::conformal))
PFAFF_VALUE(potential, q, n / 2, .part_of = facets(Facet::separable, Facet::conformal))
PFAFF_MAP(force, q, n / 2, f, n / 2, .compiled = true, .in_lanes = true, .offered_by = facets(Facet::separable), .part_of = facets(Facet::conformal), .counts = Counts::field)
PFAFF_MAP(velocity, p, n / 2, v, n / 2, .compiled = true, .in_lanes = true, .offered_by = facets(Facet::separable), .part_of = facets(Facet::conformal))
// The action form F.dz - B dt, and K zdot + D = 0 with K_ij = d_i F_j - d_j F_i, row-major, D = -(grad B + F_t). K is
// constant, -J, for canonical systems.
PFAFF_VALUE(birkhoffian, z, n, .offered_by = facets(Facet::birkhoffian))
PFAFF_MAP(one_form, z, n, form, n, .may_skip_zeros = true, .offered_by = facets(Facet::birkhoffian))
PFAFF_MAP(structure, z, n, k, n * n, .may_skip_zeros = true, .offered_by = facets(Facet::structure, Facet::darboux_chart))
PFAFF_MAP(covector, z, n, d, n, .may_skip_zeros = true, .offered_by = facets(Facet::structure))
// y = chart(t, z), in which K is constant, K_c = [[0, -I], [I, 0]]; the energy, the field Y of dy/dt = Y(y, t) and its
// Jacobian there.
PFAFF_MAP(chart, z, n, y, n, .compiled = true, .unique = false, .offered_by = facets(Facet::darboux_chart))
PFAFF_MAP(chart_inverse, y, n, z, n, .compiled = true, .unique = false, .offered_by = facets(Facet::darboux_chart))
PFAFF_VALUE(chart_hamiltonian, y, n, .part_of = facets(Facet::darboux_chart))
PFAFF_MAP(chart_field, y, n, rate, n, .offered_by = facets(Facet::darboux_chart), .counts = Counts::field)
PFAFF_DERIVED(chart_field_jacobian, n, n * n, .offered_by = facets(Facet::darboux_chart), .counts = Counts::jacobian)
// Pairs of states to (w^, w).
PFAFF_FORMULA(alpha, void, (const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w),
              (t, t0, new_z, old_z, w_hat, w), n, n, .part_of = facets(Facet::generating_map))
// Constraints of positions; coefficients lambda >= 0 of friction, of the momenta.
PFAFF_MAP(holonomic, q, n / 2, phi, constraints, .part_of = facets(Facet::holonomic))
PFAFF_MAP(friction, z, n, lambda, n / 2, .may_skip_zeros = true, .part_of = facets(Facet::holonomic))
// Applied forces Q, one for each momentum, beside a canonical energy: p' = -H_q + Q. Where they are written the facets
// of the energy are not offered, because the energy alone does not make the motion.
PFAFF_MAP(applied_force, z, n, f, n / 2, .may_skip_zeros = true, .part_of = facets(Facet::vector_field, Facet::holonomic, Facet::velocity_constraints))
// All constraints, with hidden ones where they are holonomic, and d phi_i / dz_j, row-major.
PFAFF_MAP(constraints, z, n, phi, constraints, .part_of = facets(Facet::constraints, Facet::velocity_constraints))
PFAFF_MAP(constraint_gradients, z, n, rows, constraints * n, .may_skip_zeros = true, .part_of = facets(Facet::constraints, Facet::velocity_constraints))
// Constraints A v + b = 0 of velocities: A, row-major, and b, which is zero where it is left out.
PFAFF_MAP(velocity_constraints, q, n / 2, rows, velocity_constraints * n / 2, .may_skip_zeros = true, .offered_by = facets(Facet::velocity_constraints))
PFAFF_MAP(velocity_offsets, q, n / 2, b, velocity_constraints, .may_skip_zeros = true, .offered_by = facets(Facet::velocity_constraints))
// The symmetric bracket of a metriplectic system, row-major, and its entropy.
PFAFF_BRACKET(symmetric_tensor, symmetric_bracket, BracketMatrix, n * n, .part_of = facets(Facet::metriplectic))
PFAFF_VALUE(entropy, z, n, .part_of = facets(Facet::metriplectic))
// The named quantities, in the order of the descriptor's list.
PFAFF_MAP(invariants, z, n, values, invariants, .listed = true, .offered_by = facets(Facet::invariants))
// The state after `elapsed` from z0 at t0.
PFAFF_FORMULA(exact_solution, void, (const T& elapsed, const T& t0, In<T> z0, Out<T> z), (elapsed, t0, z0, z), n, n,
              .part_of = facets(Facet::exact_solution))
// An involution rho of the states that reverses the motion, rho o flow_h = flow_-h o rho: of momenta and other
// velocities the signs, as a rule. It serves no facet; what is reversible is told by it.
PFAFF_MAP(reversal, z, n, reversed, n)
// clang-format on

#undef PFAFF_FACET
#undef PFAFF_COUNT
#undef PFAFF_FORMULA
#undef PFAFF_BRACKET
#undef PFAFF_DERIVED
#undef PFAFF_VALUE
#undef PFAFF_MAP
