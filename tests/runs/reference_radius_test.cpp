// Reference solutions of motions whose Taylor coefficients vanish in most degrees, or which are polynomials
// up to the order of the series and none beyond: against integrals and special functions in 40 digits, which
// share nothing with series in time.
#include <gtest/gtest.h>

#include "reference_samples.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::sample_motion;
using pfaff::testing::start_of_sample;

Quad digits_of(const char* digits) { return Real::parse(digits)->quad(); }

template <class T>
T whole_power(const T& x, int exponent) {
  T result(1);
  for (int k = 0; k < exponent; ++k) result = result * x;
  return result;
}
// q'' = -factor q^{exponent - 1}: degrees 1 mod `exponent` of q alone, from q = 0.
template <int exponent, int factor>
struct PowerOscillator {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -T(factor) * whole_power(z[0], exponent - 1);
  }
};
struct Saturating {  // v' = 1 - v^4: degrees 1 mod 4
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = T(1) - whole_power(z[0], 4);
  }
};
template <int exponent>
struct Airy {  // y'' = t^exponent y: degrees 0 and 1 mod exponent + 2; no pole anywhere
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = whole_power(t, exponent) * z[0];
  }
};
struct FlatForce {  // u' = (sin t)^40 beside an oscillator, which alone chooses the first step
  static constexpr int dimension = 3;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
    rate[2] = whole_power(T(sin(t)), 40);
  }
};
struct FlatForceAlone {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& t, In<T> /*z*/, Out<T> rate) const {
    rate[0] = whole_power(T(sin(t)), 40);
  }
};
struct Throwing {  // a polynomial beside z' = -z^2
  static constexpr int dimension = 3;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = T(-1);
    rate[2] = -z[2] * z[2];
  }
};
struct Switched {  // x' = 1 until t = 1, then 2
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& t, In<T> /*z*/, Out<T> rate) const {
    rate[0] = select(T(t - T(1)), T(2), T(1));
  }
};

struct SmallSpring {  // a mass of 1e-26 kg on a spring of 1e-4 N/m, which moves by 1e-10 m in 1e-11 s
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1] * whole_power(T(10), 26);
    rate[1] = -z[0] / whole_power(T(10), 4);
  }
};
struct Driven {  // v' = cos t
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& t, In<T> /*z*/, Out<T> rate) const {
    rate[0] = cos(t);
  }
};

// Coordinate k of both, relative; quad has 34 digits, of which the motions here lose four at most.
void expect_solution(const std::shared_ptr<const Model>& model, int time, const char* expected,
                     std::size_t k = 0) {
  SCOPED_TRACE(expected);
  std::vector<Quad> z = start_of_sample(*model);
  const ReferenceSolution solution(model, Quad(0), z, Quad(abs(Quad(time))));
  taylor_flow(*model, Quad(0), Quad(time), z);
  EXPECT_LE(static_cast<double>(abs(z[k] / digits_of(expected) - Quad(1))), 1e-29);
  if (time < 0) return;
  EXPECT_EQ(solution.ended(), "");
  EXPECT_LE(static_cast<double>(abs(solution.at(Quad(time))[k] / digits_of(expected) - Quad(1))), 1e-29);
}
template <int exponent, int factor>
void expect_oscillator(int momentum, int time, const char* expected) {
  expect_solution(sample_motion(PowerOscillator<exponent, factor>{}, {0, momentum}), time, expected);
}

// q'' = -2 q^3: the sine lemniscate, sn(t | m = -1).
TEST(ReferenceRadius, LemniscateOscillator) {
  expect_oscillator<4, 2>(1, 100, "0.361193780021377981261763648476976105254895");
}
// Potential q^6/2 with p = 1 and 2, q^8/8 with p = 2 and 10; quadratures of dq/p, checked to 40 digits.
TEST(ReferenceRadius, PowerOscillators) {
  expect_oscillator<6, 3>(1, 2, "0.428460829879984263594233231522481584851935");
  expect_oscillator<6, 3>(2, 2, "-0.9286927715879321881357444350880379485275656");
  expect_oscillator<8, 1>(2, 2, "-0.7087063569452047804509721054731466485559939");
  expect_oscillator<8, 1>(10, 10, "1.563984925063535239511589809821606839694164");
}
// Gaps longer than the last quarter of the degrees, and longer than the series.
TEST(ReferenceRadius, LongerGaps) {
  expect_oscillator<10, 1>(1, 2, "0.6599683244724490613382078808568179755401586");
  expect_oscillator<12, 1>(1, 3, "-0.4199922878649937603430521861574764641787292");
  expect_oscillator<30, 1>(2, 2, "-0.7933962274318839137981456439810429408424069");
  expect_oscillator<40, 1>(1, 2, "0.2293407310699672948364503129580201700028506");
}
// (atan v + atanh v) / 2 = t, and the same with acoth from 10.
TEST(ReferenceRadius, Saturation) {
  expect_solution(sample_motion(Saturating{}, {0}), 1, "0.8591791788773327554208284372703610400621");
  expect_solution(sample_motion(Saturating{}, {10}), 10,
                  "1.000000000000000001763938577872213750256575546324936");
}
// Airy's functions, and 0F1(; 1 - 1/(m+2); t^{m+2}/(m+2)^2): entire functions with gaps of 3, 5 and 9.
TEST(ReferenceRadius, EntireFunctionsWithGaps) {
  expect_solution(sample_motion(Airy<1>{}, {1, 0}), 4, "68.1778246566239135347820691212308088143981038141");
  expect_solution(sample_motion(Airy<1>{}, {1, 0}), -8,
                  "-0.34356896166525157421066291922496226640498493672412");
  expect_solution(sample_motion(Airy<3>{}, {1, 0}), 3, "121.4265880032017473842334196519267907651407915672");
  expect_solution(sample_motion(Airy<7>{}, {1, 0}), 2, "33.312396962574838967679025851312475805871612028073");
}
// The integral of (sin t)^40 from 0 to 10: no degree of the first series below 41.
TEST(ReferenceRadius, FlatForces) {
  const char* const integral = "1.181590893603929514742415714245333096138";
  expect_solution(sample_motion(FlatForceAlone{}, {0}), 10, integral);
  expect_solution(sample_motion(FlatForce{}, {1, 0, 0}), 10, integral, 2);
}
// A polynomial says nothing of the step; what stands beside it does.
TEST(ReferenceRadius, PolynomialBesideAnother) {
  const auto throwing = sample_motion(Throwing{}, {0, 7, 1});
  expect_solution(throwing, 30, "-240");
  expect_solution(throwing, 30, "0.032258064516129032258064516129032258064516129", 2);
}
// A second's hundred millionth part is 1000 radians; each coordinate counts by its own size.
TEST(ReferenceRadius, SmallUnits) {
  const Quad mass = digits_of("1e-26"), stiffness = digits_of("1e-4"), amplitude = digits_of("1e-10"),
             time = digits_of("1e-8"), rate = sqrt(stiffness / mass);
  const auto model = sample_motion(SmallSpring{}, {*Real::parse("1e-10"), 0});
  const std::vector<Quad> z = ReferenceSolution(model, Quad(0), start_of_sample(*model), time).at(time),
                          exact{amplitude * cos(rate * time), -mass * rate * amplitude * sin(rate * time)};
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_LE(static_cast<double>(abs(z[k] / exact[k] - Quad(1))), 1e-28) << k;  // 2e3 radians of u each
}
// The times of steps are rounded, and the force is that of the time which is left.
TEST(ReferenceRadius, LateTimes) {
  const auto model = sample_motion(Driven{}, {0});
  const Quad late(1000000), after = late + Quad(10);
  const ReferenceSolution solution(model, late, {Quad(0)}, Quad(10));
  EXPECT_LE(static_cast<double>(abs(solution.at(after)[0] - (sin(after) - sin(late)))), 1e-32);
}
// The series before a jump of the field knows nothing of it.
TEST(ReferenceRadius, JumpOfTheField) { expect_solution(sample_motion(Switched{}, {0}), 3, "5"); }

}  // namespace
