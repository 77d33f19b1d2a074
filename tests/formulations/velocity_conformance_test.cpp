// The identities of velocity constraints hold for the derived evaluator, and evaluators with one operation
// wrong break them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/core/facets/conformance/constraint_matchers.hpp>
#include <pfaff/core/facets/joined_velocity_constraints.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>
#include <pfaff/core/facets/taped_velocity_constraints.hpp>
#include <pfaff/verify/skated_models.hpp>

#include "velocity_systems.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// An H that is not quadratic in p: P and S depend on the momenta.
struct FastParticle : ContactParticle {
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return sqrt(1 + p[0] * p[0] + p[1] * p[1] + 2 * p[2] * p[2]);
  }
};

std::vector<std::shared_ptr<const Model>> models() {
  std::vector<std::shared_ptr<const Model>> list = skated_models();
  const std::vector<Real> six{Real::fraction(1, 3), Real::fraction(2, 3), 1, Real::fraction(1, 2), -1, 2};
  list.push_back(model_of<ChaplyginSleigh>("sleigh", six));
  list.push_back(model_of<FastParticle>("fast particle", six));
  return list;
}

TEST(VelocityConformance, TheDerivedEvaluatorKeepsEveryIdentity) {
  const ConstraintSamples samples;
  for (const auto& model : models()) {
    SCOPED_TRACE(model->name());
    EXPECT_THAT(model->velocity_constraints<double>().get(), KeepsConstraintIdentities(model, samples));
    EXPECT_THAT(model->velocity_constraints<Quad>().get(), KeepsConstraintIdentities(model, samples));
  }
}

enum class VelocityFault {
  values,
  velocity,
  force,
  apply,
  apply_transpose,
  solve,
  by_momentum,
  by_momentum_transpose,
  place,
  residuals,
  rates,
  velocities,
  forces,
  ideal_rates,
  none
};

// An evaluator with one operation wrong by a relative 1e-8, or placed wrongly.
class WrongVelocityConstraints final : public VelocityConstraints<double> {
 public:
  WrongVelocityConstraints(VelocityPointer<double> right, VelocityFault broken)
      : right_(std::move(right)), broken_(broken) {}
  [[nodiscard]] std::size_t count() const override { return right_->count(); }
  [[nodiscard]] std::size_t degrees() const override { return right_->degrees(); }
  [[nodiscard]] const SymmetricPattern& pattern() const override { return right_->pattern(); }
  void values(const double& t, In<double> q, In<double> p, Out<double> psi) override {
    right_->values(t, q, p, psi), spoil(VelocityFault::values, psi);
  }
  void velocity(const double& t, In<double> q, In<double> p, Out<double> v) override {
    right_->velocity(t, q, p, v), spoil(VelocityFault::velocity, v);
  }
  void force(const double& t, In<double> q, In<double> p, Out<double> f) override {
    right_->force(t, q, p, f), spoil(VelocityFault::force, f);
  }
  Status linearise(const double& t, In<double> q, In<double> p) override {
    return right_->linearise(t, q, p);
  }
  void apply(In<double> u, Out<double> r) const override {
    right_->apply(u, r), spoil(VelocityFault::apply, r);
  }
  void apply_transpose(In<double> x, Out<double> f) const override {
    right_->apply_transpose(x, f), spoil(VelocityFault::apply_transpose, f);
  }
  void solve(In<double> r, Out<double> x) const override {
    right_->solve(r, x), spoil(VelocityFault::solve, x);
  }
  void by_momentum(In<double> u, Out<double> r) const override {
    right_->by_momentum(u, r), spoil(VelocityFault::by_momentum, r);
  }
  void by_momentum_transpose(In<double> x, Out<double> v) const override {
    right_->by_momentum_transpose(x, v), spoil(VelocityFault::by_momentum_transpose, v);
  }
  Status place(const double& t, In<double> q, In<double> p) override {
    const Status status = right_->place(broken_ == VelocityFault::place ? t + 1e-8 : t, q, p);
    for (const auto& [part, values] : {std::pair(&residuals_, right_->residuals()),
                                       {&rates_, right_->rates()},
                                       {&velocities_, right_->velocities()},
                                       {&forces_, right_->forces()}})
      part->assign(values.begin(), values.end());
    spoil(VelocityFault::residuals, residuals_), spoil(VelocityFault::rates, rates_);
    spoil(VelocityFault::velocities, velocities_), spoil(VelocityFault::forces, forces_);
    return status;
  }
  [[nodiscard]] std::span<const double> residuals() const override { return residuals_; }
  [[nodiscard]] std::span<const double> rates() const override { return rates_; }
  [[nodiscard]] std::span<const double> velocities() const override { return velocities_; }
  [[nodiscard]] std::span<const double> forces() const override { return forces_; }
  [[nodiscard]] ConstrainedRates<double>* ideal_rates() override { return &motion_; }

 private:
  void spoil(VelocityFault operation, std::span<double> numbers) const {
    if (operation == broken_) numbers[0] += 1e-8;
  }
  // Those of the operations, spoilt.
  struct Motion final : ConstrainedRates<double> {
    explicit Motion(WrongVelocityConstraints& of) : of(of) {}
    Status operator()(const double& t, In<double> q, In<double> p, Out<double> q_rate,
                      Out<double> p_rate) override {
      std::vector<double> x(of.count());
      const Status status = of.right_->place(t, q, p);
      of.right_->solve(of.right_->rates(), x);
      of.right_->apply_transpose(x, p_rate);
      for (std::size_t k = 0; k < q.size(); ++k) {
        q_rate[k] = of.right_->velocities()[k];
        p_rate[k] = of.right_->forces()[k] - p_rate[k];
      }
      of.spoil(VelocityFault::ideal_rates, p_rate);
      return status;
    }
    WrongVelocityConstraints& of;
  };
  VelocityPointer<double> right_;
  VelocityFault broken_;
  std::vector<double> residuals_, rates_, velocities_, forces_;
  Motion motion_{*this};
};

TEST(VelocityConformance, EveryWrongOperationIsFound) {
  const auto model = two_blades(true);
  for (int k = 0; k <= static_cast<int>(VelocityFault::none); ++k) {
    const auto broken = static_cast<VelocityFault>(k);
    WrongVelocityConstraints wrong(model->velocity_constraints<double>(), broken);
    if (broken == VelocityFault::none) {
      EXPECT_THAT(&wrong, KeepsConstraintIdentities(model, ConstraintSamples{}));
    } else {
      EXPECT_THAT(&wrong, ::testing::Not(KeepsConstraintIdentities(model, ConstraintSamples{}))) << k;
    }
  }
}

// A chain of rods with a skate: S couples neighbours, and its tape the skate to the two rods at its bead,
// which leaves a structure without fill. The evaluator that joins the skate to the rods of the system leaves
// out the rod that the skate points along, for which the entry is zero everywhere, and its own tape does not
// grow with the chain.
TEST(VelocityConformance, AChainWithASkateIsLinearInItsLength) {
  const auto chain = [](int beads) {
    return systems().get("skate-chain", "system").make({{"beads", std::to_string(beads)}});
  };
  const auto work = [&](int beads) {
    const auto model = chain(beads);
    const VelocityTapes tapes = record_velocity(*model);
    const auto size = static_cast<std::size_t>(beads);
    EXPECT_EQ(tapes.count, size + 1);
    EXPECT_EQ(tapes.pattern->couplings().size(), size + 1);
    EXPECT_EQ(tapes.pattern->structure(), MatrixStructure::tree);
    EXPECT_EQ(tapes.pattern->fill(), 0U);
    auto expected = tapes.pattern->couplings();
    std::erase(expected, SymmetricPattern::Coupling(size / 2, size));
    EXPECT_EQ(expected.size(), size);
    EXPECT_EQ(model->velocity_constraints<double>()->pattern().couplings(), expected);
    return tapes.place->code.size();
  };
  const std::size_t short_one = work(10), middle = work(20), long_one = work(30);
  EXPECT_EQ(long_one - middle, middle - short_one);
  const auto joined = [&](int beads) {
    const JoinedTapes tapes = record_joined(*chain(beads));
    return tapes.place->outputs.size() + tapes.values->outputs.size();
  };
  EXPECT_EQ(joined(10), joined(30));
}

// Chains of even and odd numbers of rods with a skate, whose rods offer their motion and its responses as one
// operation, to which the skate is joined.
TEST(VelocityConformance, ChainsWithASkateKeepEveryIdentity) {
  for (const char* beads : {"2", "3", "6", "7"}) {
    const auto model = systems().get("skate-chain", "system").make({{"beads", beads}});
    SCOPED_TRACE(beads);
    const auto in_double = model->velocity_constraints<double>();
    const auto in_quad = model->velocity_constraints<Quad>();
    EXPECT_NE(in_double->ideal_rates(), nullptr);
    EXPECT_THAT(in_double.get(), KeepsConstraintIdentities(model, ConstraintSamples{}));
    EXPECT_THAT(in_quad.get(), KeepsConstraintIdentities(model, ConstraintSamples{}));
  }
}

// With two skates, a mass matrix that depends on positions and constraints that move, joined by the same
// rules to holonomic constraints from tapes: against the evaluator that has all of them on one tape.
TEST(VelocityConformance, JoinedEvaluatorsKeepEveryIdentity) {
  const auto model = two_blades(true);
  const auto tapes = std::make_shared<const HolonomicTapes>(record_holonomic(*model));
  const auto joined = std::make_shared<const JoinedTapes>(record_joined(*model));
  const auto evaluator = [&]<class T>(std::type_identity<T>) {
    return JoinedVelocityConstraints<T>(std::make_unique<TapedConstraints<T>>(tapes), joined);
  };
  auto in_double = evaluator(std::type_identity<double>());
  auto in_quad = evaluator(std::type_identity<Quad>());
  EXPECT_THAT(&in_double, KeepsConstraintIdentities(model, ConstraintSamples{}));
  EXPECT_THAT(&in_quad, KeepsConstraintIdentities(model, ConstraintSamples{}));
}

}  // namespace
