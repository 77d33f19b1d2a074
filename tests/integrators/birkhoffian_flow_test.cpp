// The geometry on which the Birkhoffian schemes rest: the contact form of Birkhoff's equations, and the
// composition law of their flow between two times.
#include <gtest/gtest.h>

#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/support/structure.hpp>

#include "bent.hpp"
#include "generating_samples.hpp"

namespace pfaff {
namespace {

using testing::at_round_off;
using testing::bent;
using testing::distance;
using testing::Numbers;
using testing::shared;
using testing::size_of;
using testing::start_time;
using testing::structure_at;

// The contact form (11)-(13): with F~ = (-B, F) on (t, z), d_a F~_b - d_b F~_a = [[0, -D^T], [D, K]], D = -K
// z'. The form is closed, and (1, z') is its kernel.
TEST(BirkhoffianFlow, ContactForm) {
  for (const int sign : {-1, 1})  // +B is the control
    for (const auto& model : {systems().get("damped-pendulum", "system").make({{"nu", "0.3"}}), bent()}) {
      const Numbers z{Quad(0.4), Quad(0.25)};
      const std::size_t n = z.size();
      const int all = static_cast<int>(n) + 1;
      const Tape form =
          record(all, all, [&](const Recorded&, std::span<const Recorded> x, std::span<Recorded> out) {
            out[0] = Recorded(sign) * evaluate(*model->tape(Formula::birkhoffian), x[0], x.subspan(1))[0];
            const auto f = evaluate(*model->tape(Formula::one_form), x[0], x.subspan(1));
            std::copy(f.begin(), f.end(), out.begin() + 1);
          });
      Numbers x{start_time}, slope((n + 1) * (n + 1)), rate(n);
      x.insert(x.end(), z.begin(), z.end());
      Replay<Quad> slopes(shared(jacobian_tape(form)));
      slopes(Quad(0), x.data(), slope.data());
      Matrix<Quad> k_hat(n + 1, slope);
      k_hat = k_hat.transposed() - k_hat;
      Replay<Quad> field(model->derived(Formula::field));
      field(start_time, z.data(), rate.data());
      const Matrix<Quad> k = structure_at(*model, start_time, z);
      const Numbers minus_d = k * rate;
      Matrix<Quad> expected(n + 1, n + 1);
      for (std::size_t i = 0; i < n; ++i) {
        expected(0, i + 1) = minus_d[i];
        expected(i + 1, 0) = -minus_d[i];
        for (std::size_t j = 0; j < n; ++j) expected(i + 1, j + 1) = k(i, j);
      }
      Numbers along{Quad(1)};
      along.insert(along.end(), rate.begin(), rate.end());
      const double kernel = distance(k_hat * along, Numbers(n + 1));
      if (sign < 0) {
        EXPECT_LE(size_of(k_hat - expected), at_round_off);
        EXPECT_LE(kernel, at_round_off);
      } else {
        EXPECT_GT(size_of(k_hat - expected), 1e-2);
        EXPECT_GT(kernel, 1e-2);
      }
    }
}

// A driven particle, q' = p, p' = t: its flow is a family of two times and not a group in one. Gauss methods
// of three stages are exact for it.
struct Driven {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return -(t * q[0]);
  }
};

TEST(BirkhoffianFlow, FlowsAreFamiliesOfTwoTimes) {
  const auto model =
      make_model({.name = "driven", .title = "", .reference = "", .initial = {1, 0}}, Driven{});
  const auto method = integrators().get("gauss", "integrator").make({{"stages", "3"}});
  StepDifferentiator<Quad> differentiate(*method, model);
  const auto flow = [&](Quad to, Quad from, const Numbers& z) { return differentiate(from, to - from, z).z; };
  const Numbers z{Quad(0.3), Quad(-0.2)};
  const Quad a(0.5), b(0.75);
  const Numbers whole = flow(a + b, Quad(0), z);
  const Quad end = a + b;
  EXPECT_LE(distance(whole, {z[0] + z[1] * end + end * end * end / Quad(6), z[1] + end * end / Quad(2)}),
            at_round_off);
  EXPECT_LE(distance(flow(a + b, a, flow(a, Quad(0), z)), whole), at_round_off);
  // As printed in (56), both factors starting at time 0.
  EXPECT_GT(distance(flow(b, Quad(0), flow(a, Quad(0), z)), whole), 1e-2);
}

}  // namespace
}  // namespace pfaff
