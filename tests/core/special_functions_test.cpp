// Special functions on tapes: derivatives forwards and backwards, and coefficients of power series, against
// Taylor coefficients of 40 digits by mpmath.
#include <gtest/gtest.h>

#include <array>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/series.hpp>

#include "../formula_values.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::shared;

// Of arctangent and error function at 1/2, up to degree 8.
constexpr std::array<const char*, 9> of_arctangent{"0.4636476090008061162142562314612144020285",
                                                   "0.8",
                                                   "-0.32",
                                                   "-0.04266666666666666666666666666666666666667",
                                                   "0.1536",
                                                   "-0.077824",
                                                   "-0.03003733333333333333333333333333333333333",
                                                   "0.06506788571428571428571428571428571428571",
                                                   "-0.02752512"};
constexpr std::array<const char*, 9> of_error_function{
    "0.5204998778130465376827466538919645287364",  "0.8787825789354447940937239548244578983625",
    "-0.4393912894677223970468619774122289491813", "-0.1464637631559074656822873258040763163938",
    "0.1830797039448843321028591572550953954922",  "0.007323188157795373284114366290203815819688",
    "-0.0500417857449350507747815029830594081012", "0.005405210306944204090655841785626625962150",
    "0.0100475885141180567975497704160236877764"};

Tape tape_of(bool arctangent) {
  return record(1, 1, [&](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    out[0] = arctangent ? atan(z[0]) : erf(z[0]);
  });
}
Quad coefficient(bool arctangent, std::size_t degree) {
  return Real::parse(arctangent ? of_arctangent[degree] : of_error_function[degree])->quad();
}

TEST(SpecialFunctions, SeriesAreTaylors) {
  for (const bool arctangent : {true, false}) {
    SeriesReplay<Quad> series(shared(tape_of(arctangent)), 9, 1);
    const Quad half(0.5), zero(0), one(1);
    series.set_time(&zero, &zero);
    for (std::size_t l = 0; l < 9; ++l) {
      series.set_input(l, l == 0 ? &half : l == 1 ? &one : &zero);
      series.advance(l);
      EXPECT_LT(abs(*series.output(0, l) - coefficient(arctangent, l)), Quad(1e-33)) << l;
    }
  }
}

TEST(SpecialFunctions, DerivativesForwardsAndBackwards) {
  for (const bool arctangent : {true, false}) {
    const Tape f = tape_of(arctangent);
    const std::vector<Recorded> weight{Recorded(1)};
    const Tape slope = record(1, 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
      out[0] = gradient(f, t, z, weight)[0];
    });
    const Tape second = jacobian_tape(slope);
    const Quad half(0.5);
    Quad found;
    Replay<Quad>(shared(slope))(Quad(0), &half, &found);
    EXPECT_LT(abs(found - coefficient(arctangent, 1)), Quad(1e-33));
    Replay<Quad>(shared(second))(Quad(0), &half, &found);
    EXPECT_LT(abs(found - Quad(2) * coefficient(arctangent, 2)), Quad(1e-33));
    // Third derivatives by duals of duals on the tape of the first.
    using D = Dual<Dual<Quad, 1>, 1>;
    D x(Dual<Quad, 1>::variable(half, 0)), out;
    x.derivative[0] = Dual<Quad, 1>(Quad(1));
    Replay<D>(shared(slope))(D(0), &x, &out);
    EXPECT_LT(abs(out.derivative[0].derivative[0] - Quad(6) * coefficient(arctangent, 3)), Quad(1e-32));
  }
}

// What only a wrong slope would change is seen: the value is right with any.
TEST(SpecialFunctions, AWrongSlopeIsSeen) {
  const Tape wrong = record(1, 1, [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    out[0] = special(SpecialFunction::arctangent, z[0], Recorded(1) / (Recorded(2) + z[0] * z[0]));
  });
  const Quad half(0.5);
  Quad found;
  Replay<Quad>(shared(wrong))(Quad(0), &half, &found);
  EXPECT_LT(abs(found - coefficient(true, 0)), Quad(1e-33));
  Replay<Quad>(shared(jacobian_tape(wrong)))(Quad(0), &half, &found);
  EXPECT_GT(abs(found - coefficient(true, 1)), Quad(0.1));
}

}  // namespace
