// What both kinds of tables of linear multistep methods read alike.
#pragma once

#include <vector>

#include <pfaff/integrators/order_conditions/multistep_conditions.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace pfaff {

/// The polynomials `rho` and `sigma` of a table, lowest coefficient first, as many numbers of one as of the
/// other; at least `fewest`. Claims are refused, since none speaks of a map of several states. InputError for
/// what is wrong in the file.
MultistepPolynomials read_multistep_polynomials(TableDocument& document, TableHead& head, std::size_t fewest);

/// The theory of a method with coefficients r_0, ..., r_{steps - 1} and behind them those of sigma. Its first
/// condition that does not hold by itself is that the sum of r_j is the sum of sigma_j.
OrderTheory multistep_theory(const char* kind, const TableHead& head, const std::vector<Quad>& numbers,
                             std::size_t steps);

}  // namespace pfaff
