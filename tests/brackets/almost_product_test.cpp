// Almost-product structures: projectors of a metric and one-forms against the golden ones, exact in
// rationals, and the identities of pitanga-rodrigues section 2.
#include <gtest/gtest.h>

#include <pfaff/bench/runner/json.hpp>
#include <pfaff/brackets/almost_product/lie_bracket.hpp>
#include <pfaff/brackets/almost_product/tensor_split.hpp>

#include "golden_brackets.hpp"
#include "random_gram.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using nlohmann::json;
using pfaff::testing::zero;  // beside that of linear maps

const json& golden_projectors() {
  static const json file = golden("projectors");
  return file;
}
Exact golden_entries(const char* key) { return golden_matrix(golden_projectors().at(key)); }
std::vector<Rational> golden_list(const char* key) {
  std::vector<Rational> list;
  for (const auto& x : golden_projectors().at(key)) list.push_back(fraction(x.get<std::string>()));
  return list;
}
template <class From, class To>
bool zero(const LinearMap<Rational, From, To>& m) {
  return zero(m.matrix());
}
template <class T>
void expect_equal(const Matrix<T>& a, const Exact& expected, double bound = 0) {
  ASSERT_EQ(a.rows(), expected.rows());
  ASSERT_EQ(a.columns(), expected.columns());
  EXPECT_LE(static_cast<double>(largest(a - as<T>(expected))), bound);
}

template <class T>
void expect_golden_projectors(double bound) {
  const Metric<T> metric(as<T>(golden_entries("g")));
  const auto forms = one_forms_of(as<T>(golden_entries("Gamma")));
  const auto q = orthogonal(metric.sharp(), forms), oblique_one = oblique(forms);
  expect_equal(q.complement().matrix(), golden_entries("q"), bound);
  expect_equal(q.admissible().matrix(), golden_entries("p"), bound);
  expect_equal(oblique_one.complement().matrix(), golden_entries("Q_oblique"), bound);
  expect_equal(oblique_one.admissible().matrix(), golden_entries("P_oblique"), bound);
  expect_equal(gram(metric.sharp(), forms, forms), golden_entries("G_up"), bound);  // G^{alpha beta}
  const auto xi = raised(metric.sharp(), forms);
  const Exact columns = golden_entries("xi_columns");
  for (std::size_t a = 0; a < xi.size(); ++a)
    expect_equal(Matrix<T>(columns.rows(), xi[a].components()), columns.block(0, a, columns.rows(), 1),
                 bound);
}
// Round-off of a 5 x 5 inverse with condition about 20; entries are about 1.
TEST(AlmostProduct, GoldenProjectors) {
  expect_golden_projectors<Rational>(0);
  expect_golden_projectors<double>(1e-14);
  expect_golden_projectors<Quad>(1e-32);
}

TEST(AlmostProduct, GoldenMetricInTheCoframe) {
  const Metric<Rational> metric(golden_entries("g"));
  const auto structure = oblique(one_forms_of(golden_entries("Gamma")));
  const std::size_t n = 5, free = 3;
  std::vector<TangentVector<Rational>> x;
  for (std::size_t a = 0; a < free; ++a)
    x.push_back(structure.admissible() * coordinate_element<Rational, Vectors>(n, a));
  const Exact columns = golden_entries("X_columns");
  for (std::size_t a = 0; a < free; ++a) EXPECT_EQ(x[a].components(), columns.block(0, a, n, 1).entries());
  expect_equal(gram(metric.flat(), x, x), golden_entries("F_ab"));
  expect_equal(gram(metric.flat(), x, structure.fields()),
               golden_entries("F_a_alpha_symmetrised_g_of_Xa_Yalpha"));
  expect_equal(gram(metric.flat(), structure.fields(), structure.fields()), golden_entries("g_alpha_beta"));
}

// (10): where the mixed block g(X_a, Y_alpha) vanishes both projectors are one, and otherwise they differ.
TEST(AlmostProduct, CompatibleWhereTheMixedBlockVanishes) {
  const Metric<Rational> metric(golden_entries("g"));
  const auto chosen = one_forms_of(golden_entries("Gamma_orthogonal_choice"));
  const auto other = one_forms_of(golden_entries("Gamma"));
  expect_equal(oblique(chosen).complement().matrix(), golden_entries("q_for_Gamma_orthogonal"));
  EXPECT_TRUE(zero(oblique(chosen).complement() - orthogonal(metric.sharp(), chosen).complement()));
  EXPECT_TRUE(split(metric.flat(), oblique(chosen)).compatible());
  EXPECT_FALSE(split(metric.flat(), oblique(other)).compatible());
  EXPECT_FALSE(zero(oblique(other).complement() - orthogonal(metric.sharp(), other).complement()));
}

// D4 with the golden force, by projectors alone.
TEST(AlmostProduct, GoldenAcceleration) {
  const Metric<Rational> metric(golden_entries("g"));
  const auto forms = one_forms_of(golden_entries("Gamma"));
  const auto structure = orthogonal(metric.sharp(), forms);
  const auto adot_v = golden_list("Adot_v"), bdot = golden_list("Bdot");
  TangentVector<Rational> expected(golden_list("acceleration"));
  auto acceleration = structure.admissible() * (metric.sharp() * Covector<Rational>(golden_list("F")));
  for (std::size_t a = 0; a < forms.size(); ++a)  // fields() are columns of g^-1 A^T G^-1
    acceleration = acceleration - (adot_v[a] + bdot[a]) * structure.fields()[a];
  EXPECT_EQ(acceleration.components(), expected.components());
}

struct Sample {
  explicit Sample(unsigned seed) : random(seed) {}
  RandomGram random;
  std::size_t n = 5, m = 2;
  Exact g = [this] {
    const Exact b = random.regular(Symmetry::none, n);
    return b * b.transposed();
  }();
  std::vector<Covector<Rational>> forms = one_forms_of(random.any(m, n - m));
};

TEST(AlmostProduct, ProjectsAlongTheComplement) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Sample s(seed);
    const Metric<Rational> metric(s.g);
    for (const auto& structure : {oblique(s.forms), orthogonal(metric.sharp(), s.forms)}) {
      const auto p = structure.admissible(), q = structure.complement();
      EXPECT_TRUE(zero(p * p - p));
      EXPECT_TRUE(zero(q * q - q));
      EXPECT_TRUE(zero(p * q));
      EXPECT_TRUE(zero(structure.reflection() * structure.reflection() - identity_of_vectors<Rational>(s.n)));
      for (std::size_t a = 0; a < s.m; ++a) {
        EXPECT_TRUE(zero(Exact(1, (p.transposed() * s.forms[a]).components())));
        EXPECT_EQ((q.transposed() * s.forms[a]).components(), s.forms[a].components());
        for (std::size_t b = 0; b < s.m; ++b)
          EXPECT_EQ(pairing(s.forms[a], structure.fields()[b]), Rational(a == b ? 1 : 0));
      }
    }
    // Q of the metric = U q U^-1, q oblique.
    const auto u = conjugation(oblique(s.forms), metric.sharp());
    EXPECT_NE(determinant(u.matrix()), Rational(0));
    EXPECT_TRUE(
        zero(orthogonal(metric.sharp(), s.forms).complement() * u - u * oblique(s.forms).complement()));
    EXPECT_FALSE(zero(orthogonal(metric.sharp(), s.forms).complement() - oblique(s.forms).complement()));
  }
}

// (1)-(4) by their own words, and that an oblique structure breaks each of them.
TEST(AlmostProduct, MetricSplitsAlongOrthogonalProjectorsOnly) {
  for (unsigned seed = 20; seed < 30; ++seed) {
    Sample s(seed);
    const Metric<Rational> metric(s.g);
    const auto& sharp = metric.sharp();
    const Covector<Rational> phi(s.random.any(1, s.n).entries()), psi(s.random.any(1, s.n).entries());
    const auto on_covectors = [&](const Covector<Rational>& a, const Covector<Rational>& b) {
      return pairing(a, sharp * b);
    };
    const auto residuals = [&](const AlmostProduct<Rational>& structure) {
      const auto p = structure.admissible().transposed(), q = structure.complement().transposed();
      return std::vector<Rational>{
          on_covectors(q * phi, psi) - on_covectors(phi, q * psi),
          on_covectors(q * phi, psi) - on_covectors(q * phi, q * psi),
          on_covectors(p * phi, p * psi) - on_covectors(phi, psi) + on_covectors(q * phi, q * psi),
          largest(
              (sharp - split(sharp, structure).admissible - split(sharp, structure).complement).matrix())};
    };
    for (const Rational& r : residuals(orthogonal(sharp, s.forms))) EXPECT_EQ(r, Rational(0));
    for (const Rational& r : residuals(oblique(s.forms))) EXPECT_NE(r, Rational(0));
    EXPECT_TRUE(split(sharp, orthogonal(sharp, s.forms)).compatible());
    EXPECT_FALSE(split(sharp, oblique(s.forms)).compatible());
    // The parts add up, compatible or not.
    const auto parts = split(metric.flat(), oblique(s.forms));
    EXPECT_TRUE(zero(parts.admissible + parts.complement + parts.mixed - metric.flat()));
  }
}

// Remark 1: a bivector and a two-form split along a structure made of their own complement, sharp(w).
TEST(AlmostProduct, BivectorsSplitWhereCompatible) {
  for (unsigned seed = 40; seed < 50; ++seed) {
    RandomGram random(seed);
    const std::size_t n = 6, m = 2;
    const ContravariantTensor<Rational> bivector(random.regular(Symmetry::skew, n));
    const auto forms = covectors_in_rows(random.any(m, n));
    if (determinant(gram(bivector, forms, forms)) == Rational(0)) continue;
    const AlmostProduct<Rational> own(forms, raised(bivector, forms));
    EXPECT_TRUE(split(bivector, own).compatible());
    EXPECT_TRUE(split(CovariantTensor<Rational>(inverse(bivector.matrix())), own).compatible());
    EXPECT_FALSE(split(bivector, oblique(one_forms_of(random.any(m, n - m)))).compatible());
  }
}

// [X_1, X_2] = -d/dz of the contact form's admissible fields.
struct AdmissibleField {
  std::size_t index;
  template <class S>
  [[nodiscard]] TangentVector<S> at(const std::vector<S>& z) const {
    Matrix<S> a(1, 3);
    a(0, 0) = -z[1];
    a(0, 2) = S(1);
    return oblique(covectors_in_rows(a)).admissible() * coordinate_element<S, Vectors>(3, index);
  }
};
TEST(AlmostProduct, LieBracketOfTheContactForm) {
  const std::vector<Rational> z{Rational(3), Rational(2) / Rational(7), Rational(-1)};
  const AdmissibleField x1{0}, x2{1};
  EXPECT_EQ(lie_bracket(x1, x2, z).components(), (std::vector<Rational>{0, 0, -1}));
  EXPECT_EQ(lie_bracket(x2, x1, z).components(), (std::vector<Rational>{0, 0, 1}));
  EXPECT_EQ(lie_bracket(x1, x1, z).components(), (std::vector<Rational>{0, 0, 0}));
}

template <class F>
void expect_refused(F&& make, const std::string& message) {
  try {
    (void)make();
    FAIL() << "expected: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), message);
  }
}
template <class T>
void expect_bad_input() {
  using Rows = Matrix<T>;
  const auto matrix = [](std::size_t rows, std::vector<int> entries) {
    std::vector<T> numbers;
    for (const int x : entries) numbers.emplace_back(x);
    return Rows(rows, numbers);
  };
  expect_refused(
      [&] {
        return Metric<T>(matrix(3, {1, 2, 3, 2, 4, 6, 3, 6, 1}));
      },
      "metric: row 2 is a combination of row 1; expected a metric that is not degenerate");
  expect_refused(
      [&] {
        return Metric<T>(matrix(2, {1, 2, 3, 4}));
      },
      "metric: entries (1, 2) and (2, 1) differ; expected a symmetric matrix");
  expect_refused(
      [&] {
        return Metric<T>(matrix(2, {1, 2}));
      },
      "linear map: a matrix of 2 x 1; expected a square one");
  const ContravariantTensor<T> unit(Rows::identity(3));
  expect_refused(
      [&] {
        return orthogonal(unit, covectors_in_rows(matrix(3, {1, 0, 1, 0, 1, 1, 1, 2, 3})), {"a", "b", "c"});
      },
      "one-forms: row 3 (c) is a combination of rows 1 (a), 2 (b); expected one-forms that are independent");
  expect_refused(
      [&] {
        return orthogonal(unit, covectors_in_rows(matrix(1, {0, 0, 0})));
      },
      "one-forms: row 1 vanishes; expected one-forms that are independent");
  expect_refused(
      [&] {
        return oblique(covectors_in_rows(matrix(1, {1, 2, 0})));
      },
      "one-forms on the complement: row 1 vanishes; expected a complement that no combination of the "
      "one-forms annihilates");
  // A null covector of an indefinite metric has no orthogonal complement.
  expect_refused(
      [&] {
        return orthogonal(Metric<T>(matrix(2, {1, 0, 0, -1})).sharp(), covectors_in_rows(matrix(1, {1, 1})));
      },
      "one-forms on the complement: row 1 vanishes; expected a complement that no combination of the "
      "one-forms annihilates");
  expect_refused(
      [&] { return oblique(std::vector<Covector<T>>{}); },
      "almost-product structure: 0 one-forms and 0 fields; expected at least one, and as many of each");
}
TEST(AlmostProduct, BadInputIsNamed) {
  expect_bad_input<Rational>();
  expect_bad_input<double>();
  expect_bad_input<Quad>();
  Matrix<double> broken = Matrix<double>::identity(2);
  broken(1, 0) = std::numeric_limits<double>::quiet_NaN();
  broken(0, 1) = broken(1, 0);
  expect_refused([&] { return Metric<double>(broken); },
                 "metric: row 1 is not finite; expected a metric that is not degenerate");
}

}  // namespace
