// What systems declare about their invariants (conserved, decreasing, quadratic and so on) is true by their
// derivatives along the field.
#include <gtest/gtest.h>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "motion.hpp"
#include "samples.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::on_velocity_constraints;
using pfaff::testing::Samples;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

constexpr int rate_points = 30;

// For every invariant: its rate along the field, the sum of the sizes of the terms that make it, and the most
// that rates mixed with each other could make of it.
struct Rates {
  explicit Rates(const Model& model)
      : size(model.invariants().size()),
        replay(std::make_shared<const Tape>(tape_of(model))),
        values(4 * size) {}

  void evaluate(Quad t, const std::vector<Quad>& z) { replay(t, z.data(), values.data()); }
  [[nodiscard]] Quad rate(std::size_t k) const { return values[k]; }
  [[nodiscard]] Quad scale(std::size_t k) const { return values[size + k]; }
  /// The rate of a sum of all coordinates, which is no invariant.
  [[nodiscard]] Quad control(std::size_t k) const { return values[2 * size + k]; }
  [[nodiscard]] Quad mixed(std::size_t k) const { return values[3 * size + k]; }

  static Tape tape_of(const Model& model) {
    const auto invariants = model.tape(Formula::invariants), field = model.tape(Formula::field);
    const int n = model.dimension(), m = static_cast<int>(model.invariants().size());
    return record(n, 4 * m, [&](const Recorded& t, Arguments z, Results out) {
      const auto size = static_cast<std::size_t>(m);
      const auto x = evaluate_field(*field, t, z);
      const auto rate = directional_derivative(*invariants, t, Recorded(1), z, x);
      const auto timed = time_derivative(*invariants, t, z);
      const auto slopes = jacobian(*invariants, t, z);
      const auto size_of = [](const Recorded& a) { return select(a, a, -a); };
      for (std::size_t k = 0; k < size; ++k) {
        out[k] = rate[k];
        out[size + k] = size_of(timed[k]);
        Recorded slope(0), speed(0);
        out[2 * size + k] = Recorded(0);
        for (std::size_t i = 0; i < z.size(); ++i) {
          out[size + k] = out[size + k] + size_of(slopes[k * z.size() + i] * x[i]);
          out[2 * size + k] = out[2 * size + k] + static_cast<int>(i + 1) * x[i];
          slope = slope + size_of(slopes[k * z.size() + i]);
          speed = speed + size_of(x[i]);
        }
        out[3 * size + k] = slope * speed;
      }
    });
  }
  static std::vector<Recorded> evaluate_field(const Tape& field, const Recorded& t, Arguments z) {
    return pfaff::evaluate(field, t, z);
  }

  std::size_t size;
  Replay<Quad> replay;
  std::vector<Quad> values;
};

TEST(Invariants, BehaveAsDeclared) {
  int conserved = 0, decreasing = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    Samples samples(31);
    for (int k = 0; k < rate_points; ++k) {
      const Assignments parameters = samples.parameters(*plugin);
      const auto model = motion_of(plugin->make(parameters));
      if (!model->facets().has(Facet::invariants)) continue;
      Rates rates(*model);
      const Quad t = samples.quad(0, 3);
      const auto z = on_velocity_constraints(*plugin, parameters, samples.state(*model, 0.3), t);
      SCOPED_TRACE(plugin->name() + " " + pfaff::testing::describe(parameters, z));
      rates.evaluate(t, z);
      for (std::size_t i = 0; i < rates.size; ++i) {
        const Invariant& invariant = model->invariants()[i];
        const Quad rate = rates.rate(i), scale = rates.scale(i);
        ASSERT_TRUE(isfinite(rate)) << invariant.name;
        // Terms that cancel, each good to a few roundings, which a solve for constraint forces amplifies and
        // mixes.
        const Quad noise = model->restricted() ? Quad(1e-30) * std::max(scale, rates.mixed(i) * Quad(1e-2))
                                               : Quad(1e-32) * scale;
        switch (invariant.behaviour) {
          case Behaviour::conserved:
            ++conserved;
            EXPECT_LE(abs(rate), noise) << invariant.name;
            EXPECT_GT(rates.mixed(i), Quad(0)) << invariant.name << " is constant: it says nothing";
            // Control: with a millionth of a coordinate added it is not conserved.
            EXPECT_GT(abs(rate + Quad(1e-6) * rates.control(i)), noise) << invariant.name;
            break;
          case Behaviour::decreasing:
            ++decreasing;
            EXPECT_LT(rate, -noise) << invariant.name;
            break;
          case Behaviour::increasing:
            EXPECT_GT(rate, noise) << invariant.name;
            break;
          case Behaviour::free:
            break;
        }
      }
    }
  }
  EXPECT_GE(conserved, rate_points * 8);
  EXPECT_GE(decreasing, rate_points * 2);
}

// I(z) = z.Q z/2 + d.z with constant Q: the Hessian is the same everywhere, and what is left of I without its
// form is linear. What is not marked has another Hessian or a linear part.
TEST(Invariants, MarkedQuadraticAreQuadraticForms) {
  int quadratic = 0, others = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    const std::size_t n = static_cast<std::size_t>(model->dimension());
    if (!model->facets().has(Facet::invariants)) continue;
    const auto invariants = model->tape(Formula::invariants);
    Samples samples(32);
    for (std::size_t i = 0; i < model->invariants().size(); ++i) {
      const Tape one = record(model->dimension(), 1, [&](const Recorded& t, Arguments z, Results out) {
        out[0] = evaluate(*invariants, t, z)[i];
      });
      Replay<Quad> value(std::make_shared<const Tape>(one));
      Replay<Quad> hessian(std::make_shared<const Tape>(jacobian_tape(jacobian_tape(one))));
      Quad worst(0), linear(0);
      for (int k = 0; k < rate_points; ++k) {
        const auto z = samples.state(*model, 0.3), other = samples.state(*model, 0.3);
        std::vector<Quad> a(n * n), b(n * n);
        const Quad t = samples.quad(0, 3), later = samples.quad(0, 3);
        hessian(t, z.data(), a.data());
        hessian(later, other.data(), b.data());
        const auto beside_form = [&](const std::vector<Quad>& at) {
          Quad direct(0);
          value(t, at.data(), &direct);
          for (std::size_t r = 0; r < n; ++r)
            for (std::size_t c = 0; c < n; ++c) direct -= at[r] * a[r * n + c] * at[c] / Quad(2);
          return direct;
        };
        for (std::size_t r = 0; r < n; ++r)
          for (std::size_t c = 0; c < n; ++c) {
            worst = std::max(worst, abs(a[r * n + c] - b[r * n + c]));
          }
        std::vector<Quad> sum = z;
        for (std::size_t r = 0; r < n; ++r) sum[r] += other[r];
        linear = std::max(linear, abs(beside_form(z)));
        worst = std::max(worst, abs(beside_form(sum) - beside_form(z) - beside_form(other)));
      }
      const std::string name = plugin->name() + " " + model->invariants()[i].name;
      if (model->invariants()[i].quadratic) {
        ++quadratic;
        EXPECT_LE(worst, Quad(1e-31)) << name;
      } else if (model->invariants()[i].behaviour == Behaviour::conserved) {
        // The controls: a conserved one that is not marked fails the same test, by far more than round-off.
        // The potential energy of light planets is 1e-8 and less.
        ++others;
        EXPECT_GT(std::max(worst, linear), Quad(1e-12)) << name << " is quadratic: mark it";
      }
    }
  }
  EXPECT_GE(quadratic, 4);
  EXPECT_GE(others, 4);
}

TEST(Invariants, SystemsWithoutDissipationParametersConserveWhatTheyDissipate) {
  // Control of `decreasing`: at nu = 0 the mechanical energy no longer decreases.
  for (const char* name : {"damped-oscillator", "damped-pendulum"}) {
    const auto model = systems().get(name, "system").make({{"nu", "0"}});
    Rates rates(*model);
    rates.evaluate(Quad(0.4), {Quad(0.9), Quad(-0.7)});
    EXPECT_LE(abs(rates.rate(rates.size - 1)), Quad(1e-33));
  }
}

}  // namespace
