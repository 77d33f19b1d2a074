// Nguyen & Turski, appendix C.1: one-pair matrices (C.2) and symmetric tridiagonal ones are inverse to each
// other. The paper shows one direction and states the other.
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>

namespace pfaff::nguyen_turski {

void one_pair_rows(Rows& rows) {
  ExactSamples samples(12);
  constexpr std::size_t n = 6;
  ExactMatrix q(n, n);
  std::vector<Rational> u, w;
  do {
    u.clear();
    w.clear();
    for (std::size_t k = 0; k < n; ++k) {
      u.push_back(samples.number());
      w.push_back(samples.number());
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) q(i, j) = i <= j ? u[i] * w[j] : u[j] * w[i];
  } while (determinant(q) == Rational(0));
  const ExactMatrix inverted = inverse(q);
  std::vector<Rational> beyond;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) beyond.push_back(inverted(i, j));
  rows.reproduced("C.2", "the inverse of a one-pair matrix is tridiagonal: entries beyond",
                  zeros(beyond.size()), quads(beyond));
  rows.reproduced("C.2", "and symmetric", quads(inverted), quads(inverted.transposed()));
  // A matrix that is no one-pair matrix has no tridiagonal inverse.
  q(0, n - 1) = q(n - 1, 0) = q(0, n - 1) + Rational(1);
  const auto entry = static_cast<double>(inverse(q)(0, n - 1));
  rows.qualitative("C.2", "one pair is needed", "-",
                   "entry (1, 6) of the inverse " + to_string(Quad(entry), 4), std::abs(entry), 0,
                   std::abs(entry) > clearly, "control: one entry changed, the inverse is not tridiagonal");
}

}  // namespace pfaff::nguyen_turski
