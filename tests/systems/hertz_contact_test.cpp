// Hertz's contact: a force q^(3/2) that begins at the overlap 0. What is expected follows from the energy,
// t = int_0^q dx / sqrt(v^2 - 2 V(x)), by quadrature with 40 digits (mpmath).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <pfaff/core/system.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../formula_values.hpp"
#include "../integrators/methods.hpp"
#include "../temporary_directory.hpp"

namespace pfaff {
namespace {

std::vector<Quad> state_after(const std::string& name, const Assignments& parameters,
                              const std::shared_ptr<const Model>& model, const Quad& h, int count,
                              std::vector<Quad> z) {
  return testing::after_steps(*testing::method_named(name, parameters), model, h, count, std::move(z));
}

// A force that is not smooth at the start costs methods their order beyond 3 there, in the first step alone:
// its error is some h^(7/2), 1e-9 for h = 1/512.
constexpr double error_of_start = 2e-8;

TEST(HertzContact, StartsAtOverlapZeroAsText) {
  const testing::TemporaryDirectory files;
  struct Case {
    const char* potential;
    const char* time;
    const char* q;
    const char* p;
  };
  for (const Case& c :
       {Case{"2/5*q^(5/2)", "1", "0.891223598734879396594862656", "0.632558801970501806859693733"},
        Case{"6/7*q^(7/3)", "1/2", "0.474991867514655514122275232", "0.835598163696368963081081050"},
        Case{"pow(q, 7/2)/3", "1", "0.929600269543676329494457605", "0.695448295651120092142254092"}}) {
    const std::string path = files / (std::string("contact-in-") + c.q + ".toml");
    std::ofstream(path) << "name = \"contact\"\ncoordinates = [\"q\", \"p\"]\n"
                           "kinetic = \"p^2/2\"\npotential = \""
                        << c.potential << "\"\ninitial = [0, 1]\n";
    const auto model = system_named(path).make({});
    const Quad time = Real::parse(c.time)->quad();
    for (const char* name : {"yoshida-verlet", "gauss"}) {
      const auto z = state_after(name, {}, model, time / Quad(512), 512, {Quad(0), Quad(1)});
      EXPECT_NEAR(static_cast<double>(z[0] - Real::parse(c.q)->quad()), 0, error_of_start) << name;
      EXPECT_NEAR(static_cast<double>(z[1] - Real::parse(c.p)->quad()), 0, error_of_start) << name;
    }
    // The field and its slopes are numbers at the start.
    for (const Quad& x : testing::values(*model, Formula::field_jacobian, Quad(0), {Quad(0), Quad(1)}))
      EXPECT_TRUE(isfinite(x)) << c.potential;
  }
}

// A ball that bounces: the overlap is what is positive of q.
struct Ball {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return Real::fraction(2, 5) * pow(select(q[0], q[0], T(0)), Real::fraction(5, 2));
  }
};

TEST(HertzContact, BouncesWrittenInCode) {
  const auto model = make_model({.name = "ball", .title = "", .reference = "", .initial = {0, 1}}, Ball());
  // In contact for 2 (5/4)^(2/5) sqrt(pi) Gamma(7/5)/Gamma(9/10), and away from there with the velocity -1.
  const Quad contact = Real::parse("3.218065459719043084535930045617")->quad();
  for (const char* name : {"yoshida-verlet", "gauss"}) {
    const auto z = state_after(name, {}, model, Quad(4) / Quad(2048), 2048, {Quad(0), Quad(1)});
    EXPECT_NEAR(static_cast<double>(z[0] + (Quad(4) - contact)), 0, error_of_start) << name;
    EXPECT_NEAR(static_cast<double>(z[1]), -1, error_of_start) << name;
  }
}

}  // namespace
}  // namespace pfaff
