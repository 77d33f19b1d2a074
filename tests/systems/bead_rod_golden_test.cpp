// Bead-rod systems read from files, against reference values of 38 digits: the matrices of the constraints
// and what they are made of, energies, and right-hand sides of every formulation, on and off the constraint
// surface.
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>

#include "bead_rod_files.hpp"

namespace {
using namespace pfaff;
using nlohmann::json;
using pfaff::testing::bead_rod;
using pfaff::testing::golden;
using pfaff::testing::golden_model;

template <class T>
class BeadRodGolden : public ::testing::Test {
 public:
  // A few dozen roundings of numbers up to 30; solves with matrices of condition below 100.
  static constexpr double tolerance = std::is_same_v<T, double> ? 1e-12 : 1e-28;

  static double distance(const T& ours, const json& theirs) {
    const Quad reference = Real::parse(theirs.get<std::string>())->quad();
    return static_cast<double>(abs(Quad(ours) - reference) / std::max(Quad(1), abs(reference)));
  }
  template <class Numbers>
  static void expect_near(const Numbers& ours, const json& theirs, const std::string& what) {
    ASSERT_EQ(ours.size(), theirs.size()) << what;
    for (std::size_t k = 0; k < ours.size(); ++k)
      EXPECT_LE(distance(ours[k], theirs[k]), tolerance) << what << ' ' << k;
  }
  /// Calls check(name, model, state) for every golden state.
  template <class Check>
  static void each_state(const Check& check) {
    for (const char* file : {"pendulum4_2d", "chain6_3d"}) {
      const json source = golden(file);
      ASSERT_GE(source["states"].size(), 2U);
      for (const json& state : source["states"]) {
        const std::string name = std::string(file) + "-" + state["label"].get<std::string>();
        check(name, bead_rod(name, golden_model(source, state)), state);
      }
    }
  }
  static std::vector<T> numbers(const json& list) {
    std::vector<T> result;
    for (const json& x : list) result.push_back(T(*Real::parse(x.get<std::string>())));
    return result;
  }
};
using Scalars = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(BeadRodGolden, Scalars);

TYPED_TEST(BeadRodGolden, ConstraintsAndTheirMatrices) {
  using T = TypeParam;
  using Numbers = std::vector<T>;
  this->each_state([&](const std::string& name, const auto& model, const json& state) {
    const auto constraints = model->template holonomic_constraints<T>();
    const Numbers q = this->numbers(state["q"]), p = this->numbers(state["p"]);
    ASSERT_EQ(constraints->place(T(0), q, p), Status::converged);
    this->expect_near(constraints->residuals(), state["phi"], name + " phi");
    this->expect_near(constraints->hidden(), state["phitilde"], name + " hidden");
    this->expect_near(constraints->hidden_rates(), state["h_k_phitilde_H"], name + " rates");
    const std::size_t count = constraints->count(), n = constraints->degrees();
    Numbers phi(count), hidden(count);
    constraints->values(T(0), q, phi);
    constraints->hidden_values(T(0), q, p, hidden);
    this->expect_near(phi, state["phi"], name + " phi alone");
    this->expect_near(hidden, state["phitilde"], name + " hidden alone");
    ASSERT_EQ(constraints->factor_friction(), Status::converged);
    for (std::size_t k = 0; k < count; ++k) {
      Numbers unit(count), column(count), other(count), along(n), turned(n);
      unit[k] = T(1);
      constraints->apply_transpose(unit, along);
      constraints->hidden_by_momentum(along, column);  // P B^T
      this->expect_near(column, state["S"][k], name + " S");
      constraints->solve(column, column);
      for (std::size_t i = 0; i < count; ++i) EXPECT_LE(abs(column[i] - unit[i]), T(this->tolerance)) << name;
      constraints->hidden_by_momentum_transpose(unit, along);
      constraints->hidden_by_position(along, column);
      constraints->hidden_by_position_transpose(unit, turned);
      constraints->hidden_by_momentum(turned, other);
      for (std::size_t i = 0; i < count; ++i) column[i] = column[i] - other[i];  // T P^T - P T^T, column k
      Numbers row(count);
      for (std::size_t i = 0; i < count; ++i) row[i] = -column[i];  // A is skew
      this->expect_near(row, state["A"][k], name + " A");
      const Numbers friction_column = this->numbers(state["S_D"][k]);
      constraints->solve_friction(friction_column, column);
      for (std::size_t i = 0; i < count; ++i) EXPECT_LE(abs(column[i] - unit[i]), T(this->tolerance)) << name;
    }
  });
}

TYPED_TEST(BeadRodGolden, EnergyAndRightHandSides) {
  using T = TypeParam;
  struct Case {
    const char *entry, *rate, *formulation, *friction;
  };
  this->each_state([&](const std::string& name, const auto& model, const json& state) {
    std::vector<T> z = this->numbers(state["q"]);
    for (const T& p : this->numbers(state["p"])) z.push_back(p);
    std::vector<T> energy(model->invariants().size());
    const auto invariants = make_evaluator<T>(model, Formula::invariants);
    invariants.call(invariants.context, T(0), z.data(), energy.data());
    EXPECT_LE(this->distance(energy[0], state["H"]), this->tolerance) << name;
    for (const Case& c :
         {Case{"dirac_4_2", "pdot_no_friction", "dirac", "none"},
          Case{"dirac_4_2", "pdot_with_metriplectic_friction", "dirac", "metriplectic"},
          Case{"simplified_4_7", "pdot_no_friction", "simplified-dirac", "none"},
          Case{"simplified_4_7", "pdot_with_metriplectic_friction", "simplified-dirac", "metriplectic"},
          Case{"lmm_A_5", "pdot_no_friction", "lmm", "none"},
          Case{"lmm_A_5", "pdot_with_dAlembert_friction", "lmm", "stokes"}}) {
      const auto formulated =
          formulations().get(c.formulation, "formulation").apply(model, {{"friction-form", c.friction}});
      const auto field = make_evaluator<T>(formulated, Formula::field);
      std::vector<T> rate(z.size());
      field.call(field.context, T(0), z.data(), rate.data());
      const std::size_t n = z.size() / 2;
      const std::string what = name + " " + c.formulation + " " + c.friction;
      this->expect_near(std::span<const T>(rate).first(n), state[c.entry]["qdot"], what + " q");
      this->expect_near(std::span<const T>(rate).subspan(n), state[c.entry][c.rate], what + " p");
    }
  });
}

}  // namespace
