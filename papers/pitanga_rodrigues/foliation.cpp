// Pitanga & Rodrigues, section 3.1: projectors for the symplectic foliation. Exact in rationals.
#include <pfaff/brackets/almost_product/almost_product.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/projectors.hpp>

namespace pfaff::pitanga_rodrigues {

void foliation_rows(Rows& rows) {
  // Leaves of dimension 4 in 6, with the coordinates z^a of the leaf first: Y_a = d_a, w^a = dz^a + A^a_u
  // dz^u.
  constexpr std::size_t leaf = 4, across = 2, n = leaf + across;
  ExactSamples samples{31};
  const ExactMatrix a = samples.any(leaf, across), pi = samples.skew(leaf);
  ExactMatrix w(leaf, n);
  for (std::size_t i = 0; i < leaf; ++i) {
    w(i, i) = 1;
    for (std::size_t u = 0; u < across; ++u) w(i, leaf + u) = a(i, u);
  }
  std::vector<TangentVector<Rational>> y;
  for (std::size_t i = 0; i < leaf; ++i) y.push_back(coordinate_element<Rational, Vectors>(n, i));
  const AlmostProduct<Rational> structure(covectors_in_rows(w), y);
  const ExactMatrix onto_leaf = structure.complement().matrix(), onto_rest = structure.admissible().matrix();

  const auto tables = table_of(a), forms = table_of(w), bivector = table_of(pi),
             lambda = printed::inverse(bivector);
  rows.erratum("X_u", "the fields across the leaves", quads(printed::transversal_fields(tables, across)),
               quads(printed::transversal_fields(tables, leaf)),
               quads(onto_rest.block(0, leaf, n, across).transposed()),
               "X_u: the sum runs to m, the dimension of the leaf");
  const auto idempotent_to = [](const ExactMatrix& m) { return static_cast<double>(largest(m * m - m)); };
  const auto printed_map = printed::leaf_map_11(lambda, forms);
  const auto square = printed::difference(printed::product(printed_map, printed_map), printed_map);
  double failure = 0;
  for (const Rational& x : printed::listed(square)) failure = std::max(failure, static_cast<double>(abs(x)));
  rows.claim("(11)", "lambda_ab w^b (x) Y_a is a projector", {"yes", "no: it is not idempotent"},
             {at_least(failure, clearly), at_most(idempotent_to(onto_leaf), 0)},
             "(11): the projector is that of (12), w^a (x) Y_a");
  rows.reproduced("(12)", "w^a lambda_ab xi^b = w^a (x) Y_a",
                  quads(printed::leaf_map_12(lambda, bivector, forms)), quads(onto_leaf));
}

}  // namespace pfaff::pitanga_rodrigues
