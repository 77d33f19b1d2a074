// A formula that an author writes although it could be derived must give the same as the derived one.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "samples.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Samples;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;
using OverridableFormulas = std::vector<std::pair<std::string, Formula>>;

// Two ways to compute one vector differ by roundings only: a few dozen operations.
constexpr double double_bound = 1e-14, quad_bound = 1e-31;
constexpr int override_points = 30;

const OverridableFormulas overridable{{"field", Formula::field},
                                      {"force", Formula::force},
                                      {"velocity", Formula::velocity},
                                      {"hamiltonian", Formula::hamiltonian},
                                      {"chart_field", Formula::chart_field},
                                      {"structure", Formula::structure},
                                      {"poisson_tensor", Formula::poisson_tensor}};

// The largest difference of two tapes at (t, z), relative to 1 + the largest value.
template <class T>
double tape_difference(const std::shared_ptr<const Tape>& a, const std::shared_ptr<const Tape>& b, Quad t,
                       const std::vector<Quad>& z) {
  std::vector<T> arguments, x(a->outputs.size()), y(b->outputs.size());
  for (const Quad v : z) arguments.push_back(static_cast<T>(v));
  Replay<T> first(a), second(b);
  first(static_cast<T>(t), arguments.data(), x.data());
  second(static_cast<T>(t), arguments.data(), y.data());
  T worst(0), size(1);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!isfinite(x[k] - y[k])) return INFINITY;
    worst = std::max(worst, abs(x[k] - y[k]));
    size = std::max(size, abs(y[k]));
  }
  return static_cast<double>(worst / size);
}

// The arguments of a formula: q or p for those of half the dimension.
std::vector<Quad> arguments_of(const Tape& tape, const std::vector<Quad>& z) {
  return {z.begin(), z.begin() + tape.inputs};
}

// The worst difference between what `model` was given and what it derives, in double and quad.
std::pair<double, double> worst_override(const Model& model, Samples& samples, int& compared) {
  double coarse = 0, fine = 0;
  for (const auto& [name, formula] : overridable) {
    if (!model.given(formula)) continue;
    const auto derived = model.derived(formula);
    if (derived == nullptr) continue;
    const auto given = model.tape(formula);
    for (int k = 0; k < override_points; ++k) {
      const auto z = arguments_of(*given, samples.state(model, 0.3));
      const Quad t = samples.quad(0, 3);
      coarse = std::max(coarse, tape_difference<double>(given, derived, t, z));
      fine = std::max(fine, tape_difference<Quad>(given, derived, t, z));
    }
    ++compared;
  }
  return {coarse, fine};
}

TEST(Overrides, AgreeWithWhatIsDerived) {
  int compared = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    Samples samples(41);
    for (int instance = 0; instance < 3; ++instance) {
      const Assignments parameters = samples.parameters(*plugin);
      const auto [coarse, fine] = worst_override(*plugin->make(parameters), samples, compared);
      EXPECT_LE(coarse, double_bound) << plugin->name() << " " << pfaff::testing::describe(parameters, {});
      EXPECT_LE(fine, quad_bound) << plugin->name() << " " << pfaff::testing::describe(parameters, {});
    }
  }
  EXPECT_GE(compared, 3 * 9);
}

// Doubles run the compiled formula, everything else the tape.
TEST(Overrides, CompiledFormulasAreThoseOnTheTape) {
  int compared = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    Samples samples(42);
    for (std::size_t f = 0; f < formula_count; ++f) {
      const auto formula = static_cast<Formula>(f);
      const CompiledFormula compiled = model->compiled(formula);
      if (compiled == nullptr) continue;
      ++compared;
      const auto tape = model->tape(formula);
      Replay<double> replay(tape);
      for (int k = 0; k < override_points; ++k) {
        std::vector<double> z, a(tape->outputs.size()), b(tape->outputs.size());
        for (const Quad x : arguments_of(*tape, samples.state(*model, 0.3)))
          z.push_back(static_cast<double>(x));
        const double t = samples.number(0, 3);
        compiled(model->system(), t, z.data(), a.data());
        replay(t, z.data(), b.data());
        for (std::size_t i = 0; i < a.size(); ++i)
          EXPECT_LE(std::fabs(a[i] - b[i]), double_bound * (1 + std::fabs(b[i])))
              << plugin->name() << " formula " << f;
      }
    }
  }
  EXPECT_GE(compared, 10);
}

// In how many numbers a formula in packs differs from the formula in doubles, at points of its own in every
// lane; -1 where it is not evaluated in packs.
template <int W>
int different_in_lanes(const std::shared_ptr<const Model>& model, Formula formula, Samples& samples) {
  const auto packs = make_evaluator_in_lanes<W>(model, formula);
  if (packs.call == nullptr) return -1;
  const auto doubles = make_evaluator<double>(model, formula);
  const auto tape = model->tape(formula);
  const auto inputs = static_cast<std::size_t>(tape->inputs);
  std::array<std::vector<double>, W> points;
  std::vector<Pack<W>> arguments(inputs), results(tape->outputs.size());
  Pack<W> time;
  for (std::size_t lane = 0; lane < W; ++lane) {
    for (const Quad x : arguments_of(*tape, samples.state(*model, 0.3)))
      points[lane].push_back(static_cast<double>(x));
    for (std::size_t k = 0; k < inputs; ++k) arguments[k].set(lane, points[lane][k]);
    time.set(lane, samples.number(0, 3));
  }
  packs.call(packs.context, time, arguments.data(), results.data());
  int count = 0;
  std::vector<double> alone(results.size());
  for (std::size_t lane = 0; lane < W; ++lane) {
    doubles.call(doubles.context, time[lane], points[lane].data(), alone.data());
    for (std::size_t k = 0; k < alone.size(); ++k)
      count +=
          std::bit_cast<std::uint64_t>(alone[k]) == std::bit_cast<std::uint64_t>(results[k][lane]) ? 0 : 1;
  }
  return count;
}

// Compiled or replayed, with linear systems that are solved on the way.
TEST(Overrides, PacksHaveTheBitsOfDoublesInEveryLane) {
  int compared = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    Samples samples(43);
    for (const Formula formula : {Formula::field, Formula::force, Formula::velocity, Formula::chart_field}) {
      if (!model->facets().meets(row_of(formula).traits.offered_by)) continue;
      const int four = different_in_lanes<4>(model, formula, samples),
                eight = different_in_lanes<8>(model, formula, samples);
      EXPECT_LE(four, 0) << plugin->name() << ' ' << to_string(formula);
      EXPECT_LE(eight, 0) << plugin->name() << ' ' << to_string(formula);
      compared += four == 0 && eight == 0 ? 1 : 0;
    }
  }
  EXPECT_GE(compared, 60);
}

// y = chart(t, z) moves by y' = chart_z X + chart_t: the push-forward of the field, whether the chart's field
// comes from chart_hamiltonian or from the pulled-back action form.
std::shared_ptr<const Tape> pushed_forward(const Model& model) {
  const auto chart = model.tape(Formula::chart), inverse = model.tape(Formula::chart_inverse);
  const auto field = model.tape(Formula::field);
  return std::make_shared<const Tape>(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments y, Results out) {
        const auto z = evaluate(*inverse, t, y);
        const auto rate = directional_derivative(*chart, t, Recorded(1), z, evaluate(*field, t, z));
        std::copy(rate.begin(), rate.end(), out.begin());
      }));
}

TEST(Overrides, ChartFieldsArePushedForward) {
  int compared = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    Samples samples(43);
    const auto model = plugin->make(samples.parameters(*plugin));
    if (!model->facets().has(Facet::darboux_chart)) continue;
    ++compared;
    const auto pushed = pushed_forward(*model), field = model->tape(Formula::chart_field);
    for (int k = 0; k < override_points; ++k) {
      const auto y = samples.state(*model, 0.3);
      const Quad t = samples.quad(0, 3);
      EXPECT_LE(tape_difference<double>(field, pushed, t, y), double_bound) << plugin->name();
      EXPECT_LE(tape_difference<Quad>(field, pushed, t, y), quad_bound) << plugin->name();
    }
  }
  EXPECT_GE(compared, 5);
}

// Controls: an author who is wrong by one part in 1e9, here and there.
struct WrongOscillator {
  static constexpr int dimension = 2;
  int wrong = 0;
  [[nodiscard]] Real factor(int place) const { return wrong == place ? 1.000000001_r : Real(1); }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return (1 + t * t) * q[0] * q[0] / 2;
  }
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const {
    f[0] = -(factor(1) * (1 + t * t) * q[0]);
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = factor(2) * p[0];
  }
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -(factor(3) * (1 + t * t) * z[0]);
  }
};

TEST(Overrides, AWrongAuthorIsFound) {
  const SystemDescriptor descriptor{.name = "wrong", .title = "", .reference = "", .initial = {1, 0.5_r}};
  for (int wrong = 0; wrong <= 3; ++wrong) {
    Samples samples(44);
    int compared = 0;
    const auto [coarse, fine] =
        worst_override(*make_model(descriptor, WrongOscillator{wrong}), samples, compared);
    EXPECT_EQ(compared, 3);
    EXPECT_EQ(coarse <= double_bound, wrong == 0) << wrong;
    EXPECT_EQ(fine <= quad_bound, wrong == 0) << wrong;
  }
}

// Where there is friction, the field is that of the energies and the damping.
std::pair<double, double> worst_friction(const Model& model, Samples& samples) {
  const auto damped = std::make_shared<const Tape>(damped_field(model));
  const auto field = model.tape(Formula::field);
  double coarse = 0, fine = 0;
  for (int k = 0; k < override_points; ++k) {
    const auto z = samples.state(model, 0.3);
    const Quad t = samples.quad(0, 3);
    coarse = std::max(coarse, tape_difference<double>(field, damped, t, z));
    fine = std::max(fine, tape_difference<Quad>(field, damped, t, z));
  }
  return {coarse, fine};
}

TEST(Overrides, DampedEnergiesMakeTheField) {
  int compared = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    Samples samples(45);
    const Assignments parameters = samples.parameters(*plugin);
    const auto model = plugin->make(parameters);
    if (!model->facets().has(Facet::conformal)) continue;
    ++compared;
    const auto [coarse, fine] = worst_friction(*model, samples);
    EXPECT_LE(coarse, double_bound) << plugin->name() << " " << pfaff::testing::describe(parameters, {});
    EXPECT_LE(fine, quad_bound) << plugin->name() << " " << pfaff::testing::describe(parameters, {});
  }
  EXPECT_GE(compared, 2);
}

// Control: a rate of damping that is not the field's by one part in 1e9.
struct WrongFriction {
  static constexpr int dimension = 2;
  bool wrong = false;
  [[nodiscard]] Real damping() const { return wrong ? 0.5000000005_r : 0.5_r; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return -cos(q[0]) - q[0] * sin(t);
  }
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = sin(t) - sin(z[0]) - z[1] / 2;
  }
};

TEST(Overrides, AWrongRateOfDampingIsFound) {
  const SystemDescriptor descriptor{.name = "wrong", .title = "", .reference = "", .initial = {1, 0.5_r}};
  for (const bool wrong : {false, true}) {
    Samples samples(46);
    const auto [coarse, fine] = worst_friction(*make_model(descriptor, WrongFriction{wrong}), samples);
    EXPECT_EQ(coarse <= double_bound, !wrong);
    EXPECT_EQ(fine <= quad_bound, !wrong);
  }
}

}  // namespace
