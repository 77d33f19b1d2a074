// Kepler's flow over many turns of an ellipse: the end is as good as that of a flow within one turn. What is
// expected was computed with 60 digits (mpmath): the root of Kepler's equation in universal variables after
// the whole periods are taken off.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/kepler_flow.hpp>

namespace {
using namespace pfaff;

template <class T>
std::array<T, 4> kepler_flow_of(const T& mu, const T& h, const std::array<T, 4>& z) {
  std::array<T, 4> change;
  std::array<T, 2> bend;
  EXPECT_EQ(kepler_change<T>(mu, h, std::span<const T>(z.data(), 2), std::span<const T>(&z[2], 2),
                             std::span<T>(change.data(), 2), std::span<T>(bend), std::span<T>(&change[2], 2)),
            Status::converged);
  for (std::size_t k = 0; k < 4; ++k) change[k] = z[k] + change[k];
  return change;
}

// All numbers are sums of few powers of two, the same in double and quad.
struct Flight {
  double mu, h;
  std::array<double, 4> start;
  std::array<const char*, 4> end;
};
const std::array<Flight, 4> flights{
    {{1,
      7000.25,
      {0.75, 0, 0, 1.25},
      {"-0.721595169402788021234858549054755163", "-0.69654134000547956980099186462311224",
       "0.740806555185523159317527204606326336", "-0.584119222576109323915234970139771152"}},
     {1,
      7000.25,
      {0.5, 0.125, 0.25, 1.5},
      {"-0.64544261150946058082490566712382991", "0.255446675630173959071840876873571911",
       "0.0754445485517984199496726175559857469", "-1.14343559901631718747330299435767505"}},
     {1.5,
      123456.75,
      {0.25, 0.875, 1, 0.375},
      {"0.70306618069442964356771912769612585", "0.87649026142406452540640851745417838",
       "0.651578837221824455611834236747627772", "-0.298901441138143035698047303469053312"}},
     {1,
      -6983.5,
      {0.125, 0, 0, 3.75},
      {"-0.905488437332180347272975499553890326", "-0.0278627891461571045041812100003878429",
       "0.06561375446536378514062560085621958", "-0.515657404935975553305233253356483649"}}}};

template <class T>
double error_in_units(const Flight& flight) {
  std::array<T, 4> z;
  for (std::size_t k = 0; k < 4; ++k) z[k] = T(flight.start[k]);
  z = kepler_flow_of(T(flight.mu), T(flight.h), z);
  double worst = 0;
  for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
    std::array<Quad, 2> end{Real::parse(flight.end[first])->quad(),
                            Real::parse(flight.end[first + 1])->quad()};
    const Quad size = sqrt(end[0] * end[0] + end[1] * end[1]);
    for (std::size_t k = 0; k < 2; ++k)
      worst = std::max(
          worst, static_cast<double>(abs(Quad(z[first + k]) - end[k]) / size / Quad(unit_roundoff<T>())));
  }
  return worst;
}

// A flow within one turn is wrong by ten units or so, which an eccentricity of .76 makes some more. By a
// period of one number it would be thousands of units, in proportion to the turns: 1,100 to 40,000 here.
TEST(KeplerTurns, LoseNoDigits) {
  for (const Flight& flight : flights) {
    EXPECT_LT(error_in_units<double>(flight), 50) << flight.h;
    EXPECT_LT(error_in_units<Quad>(flight), 50) << flight.h;
  }
}

// Derivatives over 1114 turns against central differences in quad: third derivatives of 1e11 times 1e-34.
TEST(KeplerTurns, HaveTheDerivativesOfTheirDifferences) {
  using D = Dual<Quad, 4>;
  const std::array<double, 4>& start = flights[1].start;
  std::array<D, 4> z;
  for (std::size_t k = 0; k < 4; ++k) z[k] = D::variable(Quad(start[k]), static_cast<int>(k));
  const auto end = kepler_flow_of(D(1), D(Quad(7000.25)), z);
  const Quad shift(1e-17);
  for (std::size_t j = 0; j < 4; ++j) {
    std::array<Quad, 4> above, below;
    for (std::size_t k = 0; k < 4; ++k) {
      above[k] = Quad(start[k]) + (k == j ? shift : Quad(0));
      below[k] = Quad(start[k]) - (k == j ? shift : Quad(0));
    }
    above = kepler_flow_of(Quad(1), Quad(7000.25), above);
    below = kepler_flow_of(Quad(1), Quad(7000.25), below);
    for (std::size_t k = 0; k < 4; ++k) {
      const Quad slope = (above[k] - below[k]) / (Quad(2) * shift);
      EXPECT_LT(static_cast<double>(abs(end[k].derivative[j] - slope)), 1e-11) << j << k;
      EXPECT_GT(static_cast<double>(abs(slope)), 1) << j << k;
    }
  }
}

}  // namespace
