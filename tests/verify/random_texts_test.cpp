// Random systems as text models: what is read from the text is the system that methods ran on.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/tests/formula_values.hpp>
#include <pfaff/tests/temporary_directory.hpp>
#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {
namespace {

std::shared_ptr<const Model> read_back(const std::string& text) {
  const testing::TemporaryDirectory directory;
  const auto file = directory.path() / "model.toml";
  std::ofstream(file) << text;
  return TextSystem::read(file.string())->make({});
}

std::vector<Quad> values_at_a_point(const Model& model, Formula formula) {
  Replay<Quad> replay(model.tape(formula));
  std::vector<Quad> in(static_cast<std::size_t>(replay.tape().inputs)), out(replay.tape().outputs.size());
  for (std::size_t k = 0; k < in.size(); ++k) in[k] = Quad(0.3) + Quad(static_cast<double>(k)) / Quad(7);
  replay(Quad(0.4), in.data(), out.data());
  return out;
}

// The largest difference between a formula of two models, in units of the largest value.
double formula_difference(const Model& a, const Model& b, Formula formula) {
  const auto x = values_at_a_point(a, formula), y = values_at_a_point(b, formula);
  if (x.size() != y.size()) return 1;
  Quad largest(1), apart(0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    largest = std::max(largest, abs(x[k]));
    apart = std::max(apart, abs(x[k] - y[k]));
  }
  return static_cast<double>(apart / largest);
}

PolynomialSystem with_name(PolynomialSystem system) {
  system.name = "found";
  system.title = "a random system";
  return system;
}

// Both evaluate the same sums and products in an order of their own, whose rounding is some 1e-34.
constexpr double rounding = 1e-31;

// The largest difference of the invariants that one model writes from the first ones of another.
double invariant_difference(const Model& read, const Model& written) {
  const auto n = static_cast<std::size_t>(written.dimension());
  std::vector<Quad> z;
  for (std::size_t k = 0; k < n; ++k) z.push_back(Quad(static_cast<int>(2 * k + 3)) / Quad(7));
  const std::vector<Quad> a = pfaff::testing::values(read.tape(Formula::invariants), Quad(0.3), z),
                          b = pfaff::testing::values(written.tape(Formula::invariants), Quad(0.3), z);
  double worst = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    worst = std::max(worst, static_cast<double>(abs(a[k] - b[k]) / std::max(abs(b[k]), Quad(1))));
  return worst;
}

// What a model offers, but for invariants.
std::string facets_of(const Model& model) {
  std::string names = to_string(model.facets());
  const std::string left_out = ", invariants";
  if (const auto at = names.find(left_out); at != std::string::npos) names.erase(at, left_out.size());
  return names;
}

TEST(RandomTexts, AreTheSystemsThatTheyWrite) {
  std::size_t formulas = 0;
  for (const SystemKind kind : system_kinds)
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      for (int size = 0; size < 3; ++size) {
        const PolynomialSystem system = with_name(system_of(random_recipe(kind, seed, size)));
        const std::string text = text_model(system, {"A comment.", "", "  and a command"});
        SCOPED_TRACE(text);
        const auto written = model_of(system), read = read_back(text);
        EXPECT_EQ(facets_of(*read), facets_of(*written));
        for (std::size_t k = 0; k < system.initial.size(); ++k)
          EXPECT_EQ(read->initial()[k].quad(), written->initial()[k].quad());
        // A model that is read follows its energy besides.
        ASSERT_GE(read->invariants().size(), written->invariants().size());
        for (std::size_t k = 0; k < written->invariants().size(); ++k) {
          EXPECT_EQ(read->invariants()[k].name, written->invariants()[k].name);
          EXPECT_EQ(read->invariants()[k].quadratic, written->invariants()[k].quadratic);
          EXPECT_EQ(read->invariants()[k].behaviour, written->invariants()[k].behaviour);
        }
        if (system.damping) {
          EXPECT_EQ(read->damping().quad(), written->damping().quad());
        }
        for (const auto& [formula, results] : system.formulas) {
          if (formula == Formula::invariants) {
            EXPECT_LE(invariant_difference(*read, *written), rounding);
          } else {
            EXPECT_LE(formula_difference(*read, *written, formula), rounding) << to_string(formula);
          }
          ++formulas;
        }
      }
  EXPECT_GT(formulas, 18U * 9);
}

// The control: a term that is missing in the text is seen in the formula.
TEST(RandomTexts, ATermThatIsMissingShows) {
  PolynomialSystem system = with_name(system_of(random_recipe(SystemKind::nonseparable, 1, 2)));
  const auto whole = model_of(system);
  SparsePolynomial& energy = system.formulas.at(Formula::hamiltonian).front();
  const auto [powers, coefficient] = *energy.terms().begin();
  energy.add(powers, -coefficient);
  EXPECT_GT(formula_difference(*read_back(text_model(system, {})), *whole, Formula::hamiltonian), 1e-6);
}

TEST(RandomTexts, LongExpressionsAreBrokenAtSpaces) {
  std::size_t broken = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::string text =
        text_model(with_name(system_of(random_recipe(SystemKind::sheared_form, seed, 2))), {});
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
      EXPECT_LE(text.find('\n', begin) - begin, 120U) << text.substr(begin, 130);
    broken += text.find("\"\"\"\n") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(broken, 0U);
}

}  // namespace
}  // namespace pfaff
