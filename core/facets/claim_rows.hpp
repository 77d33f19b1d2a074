// What a method may claim to keep, one row a claim. This list is the only one: the enumerators of Claim,
// their names, meanings and scopes are made from it, and verification refuses to compile while a row lacks
// its check or its control (verify/claim_checks.cpp).
//
// Included wherever rows are turned into something else, so it has no include guard. A row is
//   PFAFF_CLAIM(enumerator, "name", scope predicate, .meaning = a sentence, .scope = the predicate in words)
// with the predicates of core/facets/claims.cpp. A claim is tested on the systems that its scope speaks of;
// of other systems nothing is claimed, whatever the method says of itself. Notation: z -> z' is a step of
// size h from time t to t', M its Jacobian, J the canonical structure, K the system's own.

// clang-format off
#ifndef PFAFF_CLAIM
#define PFAFF_CLAIM(...)
#endif

// The structure, from the Jacobian of a step.
PFAFF_CLAIM(symplectic, "symplectic", has_canonical_structure,
            .meaning = "A step keeps the canonical structure, M^T J M = J.",
            .scope = "canonical structure")
PFAFF_CLAIM(k_symplectic, "K-symplectic", chart_or_alpha,
            .meaning = "A step keeps the system's own structure, M^T K(z', t') M = K(z, t).",
            .scope = "Darboux chart or alpha")
PFAFF_CLAIM(poisson, "poisson", poisson_tensor_alone,
            .meaning = "A step keeps the Poisson tensor, M Pi(z, t) M^T = Pi(z', t').",
            .scope = "Poisson tensor without a chart")
PFAFF_CLAIM(constrained_symplectic, "constrained-symplectic", holonomic_constraints,
            .meaning = "A step keeps the structure of the constraint surface, u^T (M^T J M - J) v = 0 for u and v tangent to it.",
            .scope = "holonomic constraints")
PFAFF_CLAIM(conformal, "conformal", linear_friction,
            .meaning = "The canonical structure decays as along the flow, M^T J M = e^{-nu h} J with the rate nu of the friction.",
            .scope = "damped energies")
PFAFF_CLAIM(volume, "volume", divergence_free,
            .meaning = "A step keeps the volume of the phase space, det M = 1.",
            .scope = "divergence-free field")

// Symmetries of the map.
PFAFF_CLAIM(symmetric, "symmetric", every_system,
            .meaning = "A step of size -h undoes a step of size h.",
            .scope = "every system")
PFAFF_CLAIM(reversible, "reversible", stated_reversal,
            .meaning = "A step, rho, another step of the same size and rho lead back to the start.",
            .scope = "autonomous systems that state a reversal rho, a linear one")

// What is a number at each end of a step.
PFAFF_CLAIM(quadratic_invariants, "quadratic-invariants", quadratic_invariants,
            .meaning = "Every conserved quadratic form in z keeps its value.",
            .scope = "quadratic invariants, without velocity constraints")
PFAFF_CLAIM(momentum_maps, "momentum-maps", momentum_maps,
            .meaning = "Every conserved momentum map p^T (D q + d) keeps its value.",
            .scope = "quadratic invariants p^T D q")
PFAFF_CLAIM(energy, "energy", conserved_energy,
            .meaning = "The energy H keeps its value, to round-off and whatever its degree.",
            .scope = "autonomous Hamiltonian systems, also with constraints A v = 0")
PFAFF_CLAIM(casimirs, "casimirs", stated_casimirs,
            .meaning = "Every Casimir of the bracket keeps its value.",
            .scope = "Hamiltonian systems whose bracket states its Casimirs")
PFAFF_CLAIM(entropy, "entropy", entropy_of_two_brackets,
            .meaning = "The entropy S does not fall in a step with h > 0.",
            .scope = "metriplectic systems with an entropy")

// Surfaces that the state must lie on.
PFAFF_CLAIM(constraints, "constraints", holonomic_constraints,
            .meaning = "Both levels of constraints hold at the end of a step.",
            .scope = "holonomic constraints")

PFAFF_CLAIM(velocity_constraints, "velocity-constraints", velocity_constraints,
            .meaning = "The constraints A(q, t) v + b(q, t) = 0 of the velocities hold at the end of a step.",
            .scope = "velocity constraints")

// Laws of change.
PFAFF_CLAIM(nonholonomic_momentum, "nonholonomic-momentum", allowed_momentum_maps,
            .meaning = "Every conserved momentum map p^T (D q + d) along directions D q + d that the velocity constraints allow keeps its value, as the momentum equation says.",
            .scope = "velocity constraints that allow the direction of a conserved momentum map")

// Rounding.
PFAFF_CLAIM(unbiased_round_off, "unbiased-round-off", has_canonical_energy,
            .meaning = "Rounding errors of conserved quantities add up without a trend, as a random walk of roundings of what each step adds.",
            .scope = "autonomous canonical systems")

#undef PFAFF_CLAIM
// clang-format on
