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

// At 1/2, up to degree 8.
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

constexpr std::array<const char*, 9> of_hyperbolic_sine{
    "0.5210953054937473616224256264114915591059",    "1.127625965206380785226225161402672012548",
    "0.260547652746873680811212813205745779553",     "0.1879376608677301308710375269004453354246",
    "0.02171230439557280673426773443381214829608",   "0.009396883043386506543551876345022266771232",
    "0.0007237434798524268911422578144604049432027", "0.0002237353105568215843702827701195777802674",
    "0.00001292399071165048019896888954393580255719"};
constexpr std::array<const char*, 9> of_hyperbolic_tangent{
    "0.4621171572600097585023184836436725487303",   "0.7864477329659274101496989343436361024891",
    "-0.3634309906917936377699184567918493044922",  "-0.09420154804329506014427882024415301576201",
    "0.1646758151551909604532726580378623969403",   "-0.02722238726642827242613095995538703475398",
    "-0.05038825040526614652010333728635480416496", "0.02860159674461236937892679692682961974562",
    "0.008007423564575104860098035900473747388758"};

constexpr std::array all{SpecialFunction::arctangent, SpecialFunction::error_function,
                         SpecialFunction::hyperbolic_sine, SpecialFunction::hyperbolic_tangent};

template <class T>
T value_of_function(SpecialFunction which, const T& x) {
  switch (which) {
    case SpecialFunction::arctangent:
      return atan(x);
    case SpecialFunction::error_function:
      return erf(x);
    case SpecialFunction::hyperbolic_sine:
      return sinh(x);
    case SpecialFunction::hyperbolic_tangent:
      break;
  }
  return tanh(x);
}
Tape tape_of(SpecialFunction which) {
  return record(1, 1, [&](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    out[0] = value_of_function(which, z[0]);
  });
}
Quad coefficient(SpecialFunction which, std::size_t degree) {
  constexpr std::array tables{of_arctangent, of_error_function, of_hyperbolic_sine, of_hyperbolic_tangent};
  return Real::parse(tables[static_cast<std::size_t>(which)][degree])->quad();
}

// x - x^3/3 and x + x^3/6 where the next term is lost: exponentials would leave no digit of them.
template <class T>
void odd_functions_keep_their_digits() {
  const double unit = static_cast<double>(unit_roundoff<T>());
  for (const double size : {1e-9, 1e-20, 1e-150})
    for (const double x : {size, -size}) {
      const T argument(x), cube = argument * argument * argument;
      T sine, tangent;
      Replay<T>(shared(tape_of(SpecialFunction::hyperbolic_sine)))(T(0), &argument, &sine);
      Replay<T>(shared(tape_of(SpecialFunction::hyperbolic_tangent)))(T(0), &argument, &tangent);
      EXPECT_LE(static_cast<double>(abs(T(sine - (argument + cube / T(6))))), 4 * unit * size) << x;
      EXPECT_LE(static_cast<double>(abs(T(tangent - (argument - cube / T(3))))), 4 * unit * size) << x;
    }
}
TEST(SpecialFunctions, OddHyperbolicOnesKeepTheirDigitsNearZero) {
  odd_functions_keep_their_digits<double>();
  odd_functions_keep_their_digits<Quad>();
}

TEST(SpecialFunctions, SeriesAreTaylors) {
  for (const SpecialFunction which : all) {
    SeriesReplay<Quad> series(shared(tape_of(which)), 9, 1);
    const Quad half(0.5), zero(0), one(1);
    series.set_time(&zero, &zero);
    for (std::size_t l = 0; l < 9; ++l) {
      series.set_input(l, l == 0 ? &half : l == 1 ? &one : &zero);
      series.advance(l);
      EXPECT_LT(abs(*series.output(0, l) - coefficient(which, l)), Quad(1e-33)) << l;
    }
  }
}

TEST(SpecialFunctions, DerivativesForwardsAndBackwards) {
  for (const SpecialFunction which : all) {
    const Tape f = tape_of(which);
    const std::vector<Recorded> weight{Recorded(1)};
    const Tape slope = record(1, 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
      out[0] = gradient(f, t, z, weight)[0];
    });
    const Tape second = jacobian_tape(slope);
    const Quad half(0.5);
    Quad found;
    Replay<Quad>(shared(slope))(Quad(0), &half, &found);
    EXPECT_LT(abs(found - coefficient(which, 1)), Quad(1e-33));
    Replay<Quad>(shared(second))(Quad(0), &half, &found);
    EXPECT_LT(abs(found - Quad(2) * coefficient(which, 2)), Quad(1e-33));
    // Third derivatives by duals of duals on the tape of the first.
    using D = Dual<Dual<Quad, 1>, 1>;
    D x(Dual<Quad, 1>::variable(half, 0)), out;
    x.derivative[0] = Dual<Quad, 1>(Quad(1));
    Replay<D>(shared(slope))(D(0), &x, &out);
    EXPECT_LT(abs(out.derivative[0].derivative[0] - Quad(6) * coefficient(which, 3)), Quad(1e-32));
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
  EXPECT_LT(abs(found - coefficient(SpecialFunction::arctangent, 0)), Quad(1e-33));
  Replay<Quad>(shared(jacobian_tape(wrong)))(Quad(0), &half, &found);
  EXPECT_GT(abs(found - coefficient(SpecialFunction::arctangent, 1)), Quad(0.1));
}

}  // namespace
