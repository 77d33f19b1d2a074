// Evaluators of holonomic constraints satisfy the identities of core/facets/conformance: those made from
// tapes, and those of bead-rod systems in every structure of S. An evaluator with one operation broken does
// not, whichever the operation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/core/facets/conformance/constraint_matchers.hpp>
#include <pfaff/systems/bead_rod/system.hpp>

#include "rods.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// Beads at random with rods between pairs of them, one of the beads on an anchor; masses, friction of some of
// the beads, gravity and springs.
struct Graph : BeadRodSystem<Graph> {
  std::size_t beads = 2;
  std::vector<std::array<std::size_t, 2>> joined;
  int axes = 2;
  bool anchored = false, rubbed = false;
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "graph";
    d.dimension = axes;
    std::mt19937 random(99);
    const auto draw = [&](int low, int high) {
      return Real::fraction(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)), 100);
    };
    for (std::size_t i = 0; i < beads; ++i) {
      d.masses.push_back(draw(50, 200));
      if (rubbed) d.friction.push_back(i % 3 == 1 ? Real(0) : draw(10, 90));
      for (int x = 0; x < axes; ++x) {
        d.positions.push_back(draw(-150, 150));
        d.momenta.push_back(draw(-100, 100));
      }
    }
    d.gravity.assign(d.axes(), Real::fraction(-3, 2));
    d.springs.push_back({2, 1, {{0, beads - 1}}});
    if (anchored) d.anchors.push_back({"origin", std::vector<Real>(d.axes(), 0)});
    for (const auto& [a, b] : joined) d.rods.push_back({a, b, d.distance(a, b)});
    if (anchored) d.rods.push_back({0, beads, d.distance(0, beads)});
    return d;
  }
};

std::vector<std::shared_ptr<const Model>> graphs() {
  using Joined = std::vector<std::array<std::size_t, 2>>;
  const std::vector<std::pair<std::size_t, Joined>> shapes{
      {2, {{0, 1}}},
      {6, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}}},                          // a chain
      {7, {{0, 1}, {4, 5}, {5, 6}, {1, 2}}},                                  // chains and a bead
      {6, {{0, 1}, {0, 2}, {2, 3}, {2, 4}, {4, 5}}},                          // a tree
      {6, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}}},                  // a ring
      {7, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 3}}},  // two rings, joined
      {4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}}};                         // a braced square
  std::vector<std::shared_ptr<const Model>> models;
  for (const auto& [beads, joined] : shapes)
    for (const int axes : {2, 3})
      for (const bool rubbed : {false, true}) {
        Graph graph;
        graph.beads = beads;
        graph.joined = joined;
        graph.axes = axes;
        graph.anchored = beads % 2 == 0 && joined.size() < 6 && joined.size() + 1 <= beads;
        graph.rubbed = rubbed;
        models.push_back(make_model(
            SystemDescriptor{.name = "graph of " + std::to_string(joined.size()) + " rods in " +
                                     std::to_string(axes) + "-d" + (rubbed ? ", with friction" : ""),
                             .title = "",
                             .reference = ""},
            graph));
      }
  return models;
}

std::shared_ptr<const Model> taped(const Model& model) {
  ModelSource source = model.source();
  source.holonomic = nullptr;
  return std::make_shared<const Model>(std::move(source));
}

void expect_identities(const std::shared_ptr<const Model>& model) {
  const ConstraintSamples samples{.points = 3};
  EXPECT_THAT(model->holonomic_constraints<double>().get(), KeepsConstraintIdentities(model, samples));
  EXPECT_THAT(model->holonomic_constraints<Quad>().get(), KeepsConstraintIdentities(model, samples));
}

TEST(ConstraintConformance, EverySystemsEvaluators) {
  for (const SystemPlugin* system : systems().all()) {
    if (!system->constrained()) continue;
    SCOPED_TRACE(system->name());
    const auto model = system->make({});
    if (!model->facets().has(Facet::holonomic)) continue;
    expect_identities(model);
    if (model->source().holonomic != nullptr && model->dimension() <= 40) expect_identities(taped(*model));
  }
}

TEST(ConstraintConformance, EveryGraphOfRods) {
  for (const auto& model : graphs()) {
    SCOPED_TRACE(model->name());
    EXPECT_NE(model->holonomic_constraints<double>()->rates(Reactions::hamiltonian), nullptr);
    expect_identities(model);
  }
}

// Operations that an evaluator may have wrong.
enum class HolonomicFault {
  none,
  values,
  hidden_values,
  velocity,
  force,
  linearise,
  apply,
  apply_transpose,
  solve,
  solve_of_two,
  solve_in_place,
  hidden_by_momentum,
  hidden_by_momentum_transpose,
  place,
  residuals,
  hidden,
  hidden_rates,
  velocities,
  forces,
  hidden_by_position,
  hidden_by_position_transpose,
  friction,
  factor_friction,
  solve_friction,
  ideal_rates,
  ideal_rates_that_respond,
  respond,
  hamiltonian_rates,
  pattern,
  count
};

// Another evaluator's operations, one of them off by a millionth in its first number (or not done at all).
template <class T>
class WrongHolonomicConstraints final : public HolonomicConstraints<T> {
 public:
  WrongHolonomicConstraints(std::unique_ptr<HolonomicConstraints<T>> sound, HolonomicFault broken)
      : c_(std::move(sound)), broken_(broken), pattern_(c_->count(), {}) {}

  [[nodiscard]] std::size_t count() const override {
    return broken_ == HolonomicFault::count ? c_->count() - 1 : c_->count();
  }
  [[nodiscard]] std::size_t degrees() const override { return c_->degrees(); }
  [[nodiscard]] const SymmetricPattern& pattern() const override {
    return broken_ == HolonomicFault::pattern ? pattern_ : c_->pattern();
  }
  void values(const T& t, In<T> q, Out<T> phi) override {
    c_->values(t, q, phi), spoil(HolonomicFault::values, phi);
  }
  void hidden_values(const T& t, In<T> q, In<T> p, Out<T> hidden) override {
    c_->hidden_values(t, q, p, hidden), spoil(HolonomicFault::hidden_values, hidden);
  }
  void velocity(const T& t, In<T> q, In<T> p, Out<T> v) override {
    c_->velocity(t, q, p, v), spoil(HolonomicFault::velocity, v);
  }
  void force(const T& t, In<T> q, In<T> p, Out<T> f) override {
    c_->force(t, q, p, f), spoil(HolonomicFault::force, f);
  }
  Status linearise(const T& t, In<T> q, In<T> p) override {
    return broken_ == HolonomicFault::linearise ? Status::converged : c_->linearise(t, q, p);
  }
  void apply(In<T> u, Out<T> r) const override { c_->apply(u, r), spoil(HolonomicFault::apply, r); }
  void apply_transpose(In<T> x, Out<T> f) const override {
    c_->apply_transpose(x, f), spoil(HolonomicFault::apply_transpose, f);
  }
  void solve(In<T> r, Out<T> x) const override {
    const bool in_place = r.data() == x.data();
    c_->solve(r, x), spoil(in_place ? HolonomicFault::solve_in_place : HolonomicFault::solve, x);
  }
  void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const override {
    c_->solve(r1, x1, r2, x2), spoil(HolonomicFault::solve_of_two, x2);
  }
  void hidden_by_momentum(In<T> u, Out<T> r) const override {
    c_->hidden_by_momentum(u, r), spoil(HolonomicFault::hidden_by_momentum, r);
  }
  void hidden_by_momentum_transpose(In<T> x, Out<T> v) const override {
    c_->hidden_by_momentum_transpose(x, v), spoil(HolonomicFault::hidden_by_momentum_transpose, v);
  }
  Status place(const T& t, In<T> q, In<T> p) override {
    return broken_ == HolonomicFault::place ? Status::converged : c_->place(t, q, p);
  }
  [[nodiscard]] std::span<const T> residuals() const override {
    return spoiled(HolonomicFault::residuals, c_->residuals());
  }
  [[nodiscard]] std::span<const T> hidden() const override {
    return spoiled(HolonomicFault::hidden, c_->hidden());
  }
  [[nodiscard]] std::span<const T> hidden_rates() const override {
    return spoiled(HolonomicFault::hidden_rates, c_->hidden_rates());
  }
  [[nodiscard]] std::span<const T> velocities() const override {
    return spoiled(HolonomicFault::velocities, c_->velocities());
  }
  [[nodiscard]] std::span<const T> forces() const override {
    return spoiled(HolonomicFault::forces, c_->forces());
  }
  void hidden_by_position(In<T> u, Out<T> r) const override {
    c_->hidden_by_position(u, r), spoil(HolonomicFault::hidden_by_position, r);
  }
  void hidden_by_position_transpose(In<T> x, Out<T> f) const override {
    c_->hidden_by_position_transpose(x, f), spoil(HolonomicFault::hidden_by_position_transpose, f);
  }
  [[nodiscard]] ConstrainedRates<T>* rates(Reactions reactions) override {
    rates_.inner = c_->rates(reactions);
    const bool wrong = (broken_ == HolonomicFault::ideal_rates && reactions == Reactions::ideal) ||
                       (broken_ == HolonomicFault::hamiltonian_rates && reactions == Reactions::hamiltonian);
    return wrong ? &rates_ : rates_.inner;
  }
  [[nodiscard]] IdealRates<T>* ideal_rates() override {
    responding_.inner = c_->ideal_rates();
    responding_.wrong = broken_;
    return responding_.inner == nullptr ? nullptr : &responding_;
  }
  [[nodiscard]] std::span<const T> friction() const override {
    return spoiled(HolonomicFault::friction, c_->friction());
  }
  Status factor_friction() override {
    return broken_ == HolonomicFault::factor_friction ? Status::converged : c_->factor_friction();
  }
  void solve_friction(In<T> r, Out<T> x) const override {
    c_->solve_friction(r, x), spoil(HolonomicFault::solve_friction, x);
  }

 private:
  void spoil(HolonomicFault operation, Out<T> numbers) const {
    if (operation == broken_) numbers[0] = numbers[0] + T(1e-6);
  }
  [[nodiscard]] std::span<const T> spoiled(HolonomicFault operation, std::span<const T> numbers) const {
    if (operation != broken_) return numbers;
    copy_.assign(numbers.begin(), numbers.end());
    spoil(operation, copy_);
    return copy_;
  }
  struct Rates final : ConstrainedRates<T> {
    ConstrainedRates<T>* inner = nullptr;
    Status operator()(const T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) override {
      const Status status = (*inner)(t, q, p, q_rate, p_rate);
      p_rate[0] = p_rate[0] + T(1e-6);
      return status;
    }
  };

  struct Responding final : IdealRates<T> {
    IdealRates<T>* inner = nullptr;
    HolonomicFault wrong = HolonomicFault::none;
    Status operator()(const T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) override {
      const Status status = (*inner)(t, q, p, q_rate, p_rate);
      if (wrong == HolonomicFault::ideal_rates_that_respond) p_rate[0] = p_rate[0] + T(1e-6);
      return status;
    }
    void respond(In<T> f, Out<T> rest) override {
      inner->respond(f, rest);
      if (wrong == HolonomicFault::respond) rest[0] = rest[0] + T(1e-6);
    }
  };

  std::unique_ptr<HolonomicConstraints<T>> c_;
  HolonomicFault broken_;
  SymmetricPattern pattern_;
  mutable std::vector<T> copy_;
  Rates rates_;
  Responding responding_;
};

// The operations that are found to be wrong, in the order they are tried.
template <class T>
std::vector<std::string> found(const Model& model, HolonomicFault broken) {
  WrongHolonomicConstraints<T> wrong(model.holonomic_constraints<T>(), broken);
  const ConstraintSamples samples{.points = 3};
  std::vector<std::string> operations;
  for (const ConstraintIdentity& identity : constraint_identities<T>(wrong, model, samples))
    if (!(identity.roundings <= samples.roundings)) operations.push_back(identity.operation);
  return operations;
}

template <class T>
void expect_every_fault_found(const Model& model) {
  const auto once_placed = [](const std::string& name) {
    return std::vector<std::string>{name, name + " once placed"};
  };
  const std::vector<std::pair<HolonomicFault, std::vector<std::string>>> faults{
      {HolonomicFault::none, {}},
      {HolonomicFault::values, {"values"}},
      {HolonomicFault::hidden_values, {"hidden_values"}},
      {HolonomicFault::velocity, {"velocity"}},
      {HolonomicFault::force, {"force"}},
      {HolonomicFault::apply, once_placed("apply")},
      {HolonomicFault::apply_transpose, once_placed("apply_transpose")},
      {HolonomicFault::solve, once_placed("solve")},
      {HolonomicFault::solve_of_two, once_placed("solve of two")},
      {HolonomicFault::solve_in_place, once_placed("solve in place")},
      {HolonomicFault::hidden_by_momentum, once_placed("hidden_by_momentum")},
      {HolonomicFault::hidden_by_momentum_transpose, once_placed("hidden_by_momentum_transpose")},
      {HolonomicFault::residuals, {"residuals"}},
      {HolonomicFault::hidden, {"hidden"}},
      {HolonomicFault::hidden_rates, {"hidden_rates"}},
      {HolonomicFault::velocities, {"velocities"}},
      {HolonomicFault::forces, {"forces"}},
      {HolonomicFault::hidden_by_position, {"hidden_by_position"}},
      {HolonomicFault::hidden_by_position_transpose, {"hidden_by_position_transpose"}},
      {HolonomicFault::friction, {"friction"}},
      {HolonomicFault::solve_friction, {"solve_friction"}},
      {HolonomicFault::factor_friction, {"solve_friction"}},
      {HolonomicFault::ideal_rates, {"rates, ideal"}},
      {HolonomicFault::ideal_rates_that_respond, {"ideal_rates"}},
      {HolonomicFault::respond, {"respond"}},
      {HolonomicFault::hamiltonian_rates, {"rates, hamiltonian"}},
      {HolonomicFault::pattern, {"pattern"}},
      {HolonomicFault::count, {"count"}}};
  for (const auto& [broken, expected] : faults)
    EXPECT_THAT(found<T>(model, broken), ::testing::UnorderedElementsAreArray(expected))
        << static_cast<int>(broken);
  // Maps that are not placed are those of another state.
  EXPECT_THAT(found<T>(model, HolonomicFault::linearise), ::testing::Contains("apply"));
  EXPECT_THAT(found<T>(model, HolonomicFault::linearise), ::testing::Contains("solve"));
  EXPECT_THAT(found<T>(model, HolonomicFault::place), ::testing::Contains("apply once placed"));
  EXPECT_THAT(found<T>(model, HolonomicFault::place), ::testing::Contains("residuals"));
}

TEST(ConstraintConformance, EveryOperationThatIsWrongIsNamed) {
  Graph graph;
  graph.beads = 6;
  graph.joined = {{0, 1}, {0, 2}, {2, 3}, {2, 4}, {4, 5}};
  graph.rubbed = true;
  const auto model = make_model(SystemDescriptor{.name = "tree", .title = "", .reference = ""}, graph);
  expect_every_fault_found<double>(*model);
  expect_every_fault_found<Quad>(*model);
  // The matcher says so.
  WrongHolonomicConstraints<double> wrong(model->holonomic_constraints<double>(),
                                          HolonomicFault::solve_of_two);
  EXPECT_THAT(&wrong, ::testing::Not(KeepsConstraintIdentities(model, ConstraintSamples{})));
}

}  // namespace
