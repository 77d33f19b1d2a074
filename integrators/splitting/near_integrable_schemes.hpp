// Splitting methods for H = A + eps B, where the flows of A and of B are known and eps is small.
//
// The logarithm of a step has brackets of A and B with one B, two B, ..., which are of the sizes eps, eps^2,
// ... A method is of generalised order (n_1, n_2, ..., n_m) where those with k letters B vanish up to the
// degree n_k, and those with more than m letters up to the degree n_m (mclachlan1995small;
// blanes-casas-farres-laskar-makazaga-murua2013). Its Hamiltonian is then wrong by
//
//   eps h^(n_1) + eps^2 h^(n_2) + ...,
//
// so that for small eps the orders for one B decide until the step is small, where the smallest n_k does;
// that is the order of the method in h, at fixed eps. There are n_1 + 1 conditions with one B or none, which
// are those of a quadrature formula, and so Gauss's formulas give methods of order (2 n, 2) with n flows of
// B, all of them forwards (laskar-robutel2001).
//
// A corrected scheme is C K C^-1 with the kernel K = A/2 B A/2 and a processor C of flows of B between flows
// of A that undo each other (wisdom-holman-touma1996), which removes what K has with one B up to the order of
// its name. The state after n steps is that after C, n kernels and C^-1.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace pfaff {

struct NearIntegrableScheme {
  std::string name;
  std::vector<int> orders;         // n_1, ..., n_m
  std::vector<PartialFlow> flows;  // of A (part 0) and of B (part 1), in units of the step
  bool symmetric = true;           // reads the same from both ends
  std::size_t processor = 0;       // the number of flows before the kernel, and of those after it
};

/// The names of all schemes.
std::vector<std::string> near_integrable_names();
/// The scheme of that name, which has to be one of these names.
const NearIntegrableScheme& near_integrable_scheme(const std::string& name);

}  // namespace pfaff
