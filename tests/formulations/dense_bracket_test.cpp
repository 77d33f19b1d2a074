// Structured formulations give the same as the dense Dirac bracket of all constraints, both as a formula and
// on a system that writes its constraints in the phase space.
#include <gtest/gtest.h>

#include "off_the_surface.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// (1.2) word for word with the dense W of all constraints: Pi dH - X_i (W^-1)_ij (dphi_j Pi dH + d_t phi_j).
template <class T>
std::vector<T> dense_dirac(const Model& model, const T& t, const std::vector<T>& z) {
  const std::size_t n = z.size();
  const auto phi = model.tape(Formula::constraints);
  const std::size_t count = phi->outputs.size();
  const auto still = std::make_shared<const Tape>(
      record(phi->inputs, static_cast<int>(count), [&](const Recorded& s, Arguments x, Results out) {
        const auto rest = time_derivative(*phi, s, x);
        std::copy(rest.begin(), rest.end(), out.begin());
      }));
  const Matrix<T> rows(count, values(model.tape(Formula::constraint_gradients), t, z));
  const Matrix<T> pi(n, values(model.tape(Formula::poisson_tensor), t, z));
  const Matrix<T> slope(n, values(model.tape(Formula::hamiltonian_gradient), t, z));
  const Matrix<T> moving(count, values(still, t, z));
  const Matrix<T> x = pi * rows.transposed(), free = pi * slope;
  const Matrix<T> w = rows * x, right = rows * free + moving;
  LU<T> lu(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) lu(i, j) = w(i, j);
  EXPECT_TRUE(lu.factor());
  std::vector<T> c(count), rate(n);
  lu.solve(right.entries().data(), c.data());
  for (std::size_t a = 0; a < n; ++a) {
    rate[a] = free(a, 0);
    for (std::size_t i = 0; i < count; ++i) rate[a] = rate[a] - x(a, i) * c[i];
  }
  return rate;
}

template <class T>
void generic_bracket_is_the_structured_one() {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto dirac = motion(model, "dirac"), simple = motion(model, "simplified-dirac");
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model), dense = dense_dirac(*model, t, z);
      EXPECT_LE(relative_distance<T>(field(dirac, t, z), dense),
                10 * kept<T>);  // W has the condition of S twice
      EXPECT_GT(relative_distance<T>(field(simple, t, z), dense), 1e-6)
          << "the control is the same off the surface";
    }
  }
}
TEST(Formulations, GenericDiracBracketIsTheStructuredOne) {
  generic_bracket_is_the_structured_one<double>();
  generic_bracket_is_the_structured_one<Quad>();
}

// The chain of rods with phi and phi~ written as constraints of the phase space, and its friction as a
// symmetric bracket: the same equations by the dense way.
struct Drag {
  std::vector<Real> coefficients;
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    const std::size_t half = covector.size() / 2;
    for (std::size_t k = 0; k < half; ++k) {
      vector[k] = T(0);
      vector[half + k] = coefficients[k / 2] * covector[half + k];
    }
  }
};
struct DenseRods {
  Rods rods;
  [[nodiscard]] int dimension() const { return rods.dimension(); }
  [[nodiscard]] int constraint_count() const { return 2 * rods.constraint_count(); }
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return rods.kinetic(t, p);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return rods.potential(t, q);
  }
  [[nodiscard]] Drag symmetric_bracket() const { return {rods.drag}; }
  template <class T>
  void constraints(const T& t, In<T> z, Out<T> phi) const {
    const std::size_t half = z.size() / 2, count = rods.masses.size();
    rods.holonomic(t, z.first(half), phi.first(count));
    for (std::size_t k = 0; k < count; ++k) {
      T sum(0);
      for (std::size_t c = 0; c < 2; ++c) {
        const std::size_t i = 2 * k + c;
        const T v = z[half + i] / rods.masses[k];
        sum = sum + (k == 0 ? z[i] * v : (z[i - 2] - z[i]) * (z[half + i - 2] / rods.masses[k - 1] - v));
      }
      phi[count + k] = sum;
    }
  }
};
TEST(Formulations, ConstraintsOfThePhaseSpaceGiveTheSameMotion) {
  const auto structured = chain(golden_rods().drag);
  const auto dense = make_model(SystemDescriptor{.name = "dense-rods", .title = "", .reference = ""},
                                DenseRods{golden_rods()});
  EXPECT_FALSE(dense->facets().has(Facet::holonomic));
  Points<Quad> at;
  for (const char* form : {"none", "metriplectic"})
    for (int k = 0; k < points; ++k) {
      const auto z = at.near(*structured);
      EXPECT_LE(
          relative_distance<Quad>(field(motion(dense, "dirac", {{"friction-form", form}}), Quad(0), z),
                                  field(motion(structured, "dirac", {{"friction-form", form}}), Quad(0), z)),
          10 * kept<Quad>)
          << form;
    }
  EXPECT_THROW(motion(dense, "lmm"), InputError);
}

}  // namespace
