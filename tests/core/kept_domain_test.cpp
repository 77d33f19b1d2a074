// What is zero by its words keeps the domain of what it is made of: 0*log(1 - z) has no value beyond z = 1,
// while products with zeros of sparse matrices fold away.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/text/scope.hpp>

#include "../formula_values.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::text;
using pfaff::testing::shared;

Tape tape_of(const std::string& written) {
  return record(1, 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
    Scope scope;
    scope.define("t", t);
    scope.define("z", z[0]);
    out[0] = scope.evaluate(Expression({written, "model.toml", 1, 1}));
  });
}
template <class T>
T value_at(const Tape& tape, T z) {
  Replay<T> replay(shared(tape));
  T y(0);
  replay(T(0), &z, &y);
  return y;
}

TEST(KeptDomain, OfTextIsThatOfItsWords) {
  for (const char* written :
       {"0*log(1 - z)", "log(1 - z)*0", "0/log(1 - z)*z", "0*sqrt(1 - z)", "0*(1 - z)^(1/3)",
        "0*(1 - z)^(5/2)", "log(1 - z) - log(1 - z)", "0*z/(1 - z)^0 + 0*log(1 - z)", "log(1 - z)^0 - 1",
        "1^log(1 - z) - 1", "sum(i, 0, 2, (i - 1)^2 - 1)*0*log(1 - z) + z - z",
        "0*exp(z + sin(log(1 - z)))"}) {
    const Tape tape = tape_of(written);
    EXPECT_EQ(value_at(tape, 0.25), 0) << written;
    EXPECT_TRUE(std::isnan(value_at(tape, 2.0))) << written;
    EXPECT_TRUE(isnan(value_at(tape, Quad(2)))) << written;
    // A tape that is recorded from this one has the domain as well.
    const Tape again = record(1, 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
      out[0] = Recorded(3) + evaluate(tape, t, std::vector<Recorded>{z[0]}).front();
    });
    EXPECT_EQ(value_at(again, 0.25), 3) << written;
    EXPECT_TRUE(std::isnan(value_at(again, 2.0))) << written;
    // Its derivative is zero by construction: sparse matrices stay sparse.
    EXPECT_EQ(value_at(jacobian_tape(tape), 0.25), 0) << written;
  }
  EXPECT_FALSE(std::isfinite(value_at(tape_of("0/z"), 0.0)));
  EXPECT_EQ(value_at(tape_of("0/z"), 2.0), 0);
}

// Control: what has a value everywhere folds to a constant, and costs nothing.
TEST(KeptDomain, OfWhatIsDefinedEverywhereIsFolded) {
  for (const char* written : {"0*z", "0*(z^3 - 4*z*t + 2)", "0*sin(z)*exp(cos(t) + z)", "0*(z/3)", "z - z",
                              "(z + t)^0 - 1", "0*1.5", "0*pi*z"}) {
    const Tape tape = tape_of(written);
    EXPECT_EQ(tape.code.size(), 1U) << written;
    EXPECT_EQ(value_at(tape, 2.0), 0) << written;
  }
  // The product that formulas in code and derivatives are made of.
  const Tape plain = record(
      1, 1, [](const Recorded&, In<Recorded> z, Out<Recorded> out) { out[0] = Recorded(0) * log(z[0]); });
  EXPECT_EQ(plain.code.size(), 1U);
}

// As many constants as terms: each is found where it stands, and the tape is in the order of its recording.
TEST(KeptDomain, ManyConstantsAreEachRecordedOnce) {
  constexpr int terms = 4000;
  const Tape tape = record(1, 1, [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    for (int round = 0; round < 2; ++round)
      for (int k = 1; k <= terms; ++k) {
        const Real c = Real::fraction(2 * k + 1, 2);
        out[0] = out[0] + (round == 0 ? Recorded(c) * z[0] : Recorded(Real(c.quad())) * z[0]);
      }
  });
  // A fraction and a quad of one value are two constants.
  EXPECT_EQ(tape.constants.size(), 2U * terms);
  for (int k = 0; k < terms; ++k) {
    EXPECT_TRUE(tape.constants[static_cast<std::size_t>(k)] == Real::fraction(2 * k + 3, 2)) << k;
    EXPECT_TRUE(tape.constants[static_cast<std::size_t>(k)].is_fraction()) << k;
  }
  // 2 sum (k + 1/2)
  EXPECT_EQ(value_at(tape, 1.0), double(terms) * (terms + 2));
}

}  // namespace
