// What is generated from the rows of core/facets/formula_rows.hpp: names, texts, sizes and tapes of formulas.
#include <gtest/gtest.h>

#include <set>

#include <pfaff/core/system.hpp>

#include "../formula_values.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::values;

const SystemDescriptor sample_descriptor{.name = "sample", .title = "", .reference = ""};

TEST(FormulaTable, RowsStandInTheOrderOfTheirEnumeratorsUnderNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < formula_table.size(); ++k) {
    EXPECT_EQ(index(formula_table[k].formula), k);
    names.insert(formula_table[k].name);
  }
  EXPECT_EQ(names.size(), formula_table.size());
  for (const FacetRow& facet : facet_table) EXPECT_FALSE(facet.name.empty() || facet.meaning.empty());
}

TEST(FormulaTable, ARowSaysHowItsFormulaIsWritten) {
  EXPECT_EQ(row_of(Formula::field).written, "field(t, z, rate)");
  EXPECT_EQ(row_of(Formula::kinetic).written, "kinetic(t, p)");
  EXPECT_EQ(row_of(Formula::alpha).written, "alpha(t, t0, new_z, old_z, w_hat, w)");
  EXPECT_EQ(row_of(Formula::exact_solution).written, "exact_solution(elapsed, t0, z0, z)");
  EXPECT_EQ(row_of(Formula::poisson_tensor).written, "bracket()");
  EXPECT_EQ(row_of(Formula::field_jacobian).written, "");
  EXPECT_EQ(row_of(Formula::force).reads, "n / 2");
  EXPECT_EQ(row_of(Formula::constraint_gradients).writes, "constraints * n");
}

TEST(FormulaTable, SizesFollowFromSignatures) {
  using namespace pfaff::detail;
  const Sizes sizes{.n = 6, .invariants = 4, .casimirs = 2, .constraints = 3};
  const auto is = [](FormulaSize size, int inputs, int outputs) {
    return size.inputs == inputs && size.outputs == outputs;
  };
  EXPECT_TRUE(is(size_of<Formula::field>(sizes), 6, 6));
  EXPECT_TRUE(is(size_of<Formula::kinetic>(sizes), 3, 1));
  EXPECT_TRUE(is(size_of<Formula::structure>(sizes), 6, 36));
  EXPECT_TRUE(is(size_of<Formula::alpha>(sizes), 13, 12));
  EXPECT_TRUE(is(size_of<Formula::exact_solution>(sizes), 7, 6));
  EXPECT_TRUE(is(size_of<Formula::holonomic>(sizes), 3, 3));
  EXPECT_TRUE(is(size_of<Formula::constraint_gradients>(sizes), 6, 18));
  EXPECT_TRUE(is(size_of<Formula::invariants>(sizes), 6, 4));
  EXPECT_TRUE(is(size_of<Formula::casimirs>(sizes), 6, 2));
}

// Two states, two times, two results: each argument has to come from its place in the tape.
struct Transformed {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    w_hat[0] = new_z[0] + 10 * old_z[0];
    w_hat[1] = new_z[1] + 10 * old_z[1];
    w[0] = t;
    w[1] = t0;
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& t0, In<T> z0, Out<T> z) const {
    z[0] = elapsed + 10 * t0;
    z[1] = z0[1];
  }
};

TEST(FormulaTable, ArgumentsStandInTheOrderOfTheTape) {
  const auto model = make_model(sample_descriptor, Transformed{});
  EXPECT_EQ(values(*model, Formula::alpha, 7.0, {1, 2, 3, 4, 5}), (std::vector<double>{31, 42, 7, 5}));
  EXPECT_EQ(values(*model, Formula::exact_solution, 7.0, {1, 2, 5}), (std::vector<double>{57, 2}));
}

// Reversal and Casimirs: a body whose bracket is that of so(3), and one whose bracket claims nothing.
struct Rotation {
  static constexpr int dimension = 3;
  int count = 1;
  [[nodiscard]] int casimir_count() const { return count; }
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      vector[k] = covector[i] * z[j] - covector[j] * z[i];
    }
  }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> out) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      out.data()[k] = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  }
};
struct Silent {
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    Rotation().sharp(t, z, covector, vector);
  }
};
template <class Bracket>
struct Body {
  static constexpr int dimension = 3;
  static std::vector<Parameter> parameters() { return {}; }
  Bracket of{};
  [[nodiscard]] Bracket bracket() const { return of; }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + 2 * z[1] * z[1] + 3 * z[2] * z[2]) / 2;
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    for (std::size_t k = 0; k < 3; ++k) reversed[k] = -z[k];
  }
};

TEST(FormulaTable, CasimirsComeFromTheBracketThatCountsThem) {
  const auto body = make_model(sample_descriptor, Body<Rotation>{});
  ASSERT_TRUE(body->given(Formula::casimirs));
  EXPECT_EQ(values(*body, Formula::casimirs, 0.0, {1, 2, 3}), (std::vector<double>{14}));
  EXPECT_FALSE(make_model(sample_descriptor, Body<Silent>{})->given(Formula::casimirs));
  // A bracket without any, for its parameters.
  EXPECT_FALSE(make_model(sample_descriptor, Body<Rotation>{{.count = 0}})->given(Formula::casimirs));
}

TEST(FormulaTable, ReversalIsAFormulaAndNoFacet) {
  const auto body = make_model(sample_descriptor, Body<Rotation>{}),
             plain = make_model(sample_descriptor, Transformed{});
  ASSERT_TRUE(body->given(Formula::reversal));
  EXPECT_FALSE(plain->given(Formula::reversal));
  EXPECT_EQ(values(*body, Formula::reversal, 0.0, {1, 2, 3}), (std::vector<double>{-1, -2, -3}));
  EXPECT_EQ(body->facets(), facets(Facet::vector_field, Facet::hamiltonian));
}

}  // namespace
