// Formulations against the golden values of a pendulum of four bobs, on and off the surface of constraints.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>

#include "off_the_surface.hpp"
#include "rods.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using nlohmann::json;

template <class T>
std::vector<T> state_of(const json& state) {
  std::vector<T> z = numbers<T>(state["q"]);
  for (const T& x : numbers<T>(state["p"])) z.push_back(x);
  return z;
}
// Rounding of a few dozen operations and of solves with S, whose condition is below a hundred, on numbers of
// the size of the largest.
template <class T>
void expect_golden(std::span<const T> values, const std::vector<T>& golden, const std::string& what) {
  ASSERT_EQ(values.size(), golden.size()) << what;
  T size(1);
  for (const T& x : golden) size = std::max(size, abs(x));
  for (std::size_t k = 0; k < golden.size(); ++k)
    EXPECT_LE(static_cast<double>(abs(values[k] - golden[k]) / size), 20 * bound<T>) << what << " " << k;
}

template <class T>
void compare_rates(const char* formulation, const json& golden, const std::vector<T>& z) {
  const auto model = model_of(golden_rods());
  const std::size_t half = z.size() / 2;
  struct Case {
    const char *form, *key;
  };
  for (const Case c :
       {Case{"none", "pdot_no_friction"}, Case{"metriplectic", "pdot_with_metriplectic_friction"},
        Case{"stokes", "pdot_with_dAlembert_friction"}}) {
    if (!golden.contains(c.key)) continue;
    const auto rate = field(motion(model, formulation, {{"friction-form", c.form}}), T(0), z);
    const std::string what = std::string(formulation) + " " + c.key;
    expect_golden<T>(std::span<const T>(rate).first(half), numbers<T>(golden["qdot"]), what + " q'");
    expect_golden<T>(std::span<const T>(rate).subspan(half), numbers<T>(golden[c.key]), what + " p'");
  }
}

template <class T>
void compare_all() {
  const json golden = golden_pendulum();
  ASSERT_EQ(golden["states"].size(), 2U);
  for (const json& state : golden["states"]) {
    SCOPED_TRACE(state["label"].get<std::string>());
    const std::vector<T> z = state_of<T>(state);
    compare_rates<T>("dirac", state["dirac_4_2"], z);
    compare_rates<T>("simplified-dirac", state["simplified_4_7"], z);
    compare_rates<T>("lmm", state["lmm_A_5"], z);
  }
}
TEST(FormulationsGolden, RatesInDouble) { compare_all<double>(); }
TEST(FormulationsGolden, RatesInQuad) { compare_all<Quad>(); }

// phi, phi~, h and, column by column from their maps, S, A = T P^T - P T^T and S^D.
template <class T>
void compare_matrices() {
  const json golden = golden_pendulum();
  const auto constraints = model_of(golden_rods())->holonomic_constraints<T>();
  EXPECT_EQ(constraints->pattern().structure(), MatrixStructure::tridiagonal);
  const std::size_t n = constraints->degrees(), count = constraints->count();
  for (const json& state : golden["states"]) {
    SCOPED_TRACE(state["label"].get<std::string>());
    const std::vector<T> z = state_of<T>(state);
    ASSERT_EQ(constraints->place(T(0), In<T>(z).first(n), In<T>(z).subspan(n)), Status::converged);
    ASSERT_EQ(constraints->factor_friction(), Status::converged);
    expect_golden<T>(constraints->residuals(), numbers<T>(state["phi"]), "phi");
    expect_golden<T>(constraints->hidden(), numbers<T>(state["phitilde"]), "phi~");
    expect_golden<T>(constraints->hidden_rates(), numbers<T>(state["h_k_phitilde_H"]), "h");
    for (std::size_t j = 0; j < count; ++j) {
      std::vector<T> unit(count), by_momentum(n), by_position(n), column(count), other(count), lambda(n);
      unit[j] = T(1);
      const auto golden_column = [&](const char* key) {
        std::vector<T> values;
        for (std::size_t i = 0; i < count; ++i) values.push_back(numbers<T>(state[key][i])[j]);
        return values;
      };
      constraints->hidden_by_momentum_transpose(unit, by_momentum);
      constraints->apply(by_momentum, column);
      expect_golden<T>(column, golden_column("S"), "S");
      constraints->solve(unit, column);
      expect_golden<T>(column, golden_column("S_inv"), "S^-1");
      constraints->hidden_by_position_transpose(unit, by_position);
      constraints->hidden_by_position(by_momentum, column);
      constraints->hidden_by_momentum(by_position, other);
      for (std::size_t i = 0; i < count; ++i) column[i] = column[i] - other[i];
      expect_golden<T>(column, golden_column("A"), "A");
      for (std::size_t k = 0; k < n; ++k) lambda[k] = constraints->friction()[k] * by_momentum[k];
      constraints->hidden_by_momentum(lambda, column);
      expect_golden<T>(column, golden_column("S_D"), "S^D");
      constraints->solve_friction(column, column);
      expect_golden<T>(column, unit, "S^D^-1 S^D");
    }
  }
}
TEST(FormulationsGolden, MatricesInDouble) { compare_matrices<double>(); }
TEST(FormulationsGolden, MatricesInQuad) { compare_matrices<Quad>(); }

TEST(FormulationsGolden, OfOneFormulationAreNotThoseOfAnother) {
  const json state = golden_pendulum()["states"][1];  // off the surface
  const auto z = state_of<Quad>(state);
  const auto rate = field(motion(model_of(golden_rods()), "ggl", {{"friction-form", "none"}}), Quad(0), z);
  const auto golden = numbers<Quad>(state["dirac_4_2"]["pdot_no_friction"]);
  Quad worst(0);
  for (std::size_t k = 0; k < golden.size(); ++k)
    worst = std::max(worst, abs(rate[golden.size() + k] - golden[k]));
  EXPECT_GT(worst, Quad(1e-3));
}

}  // namespace
