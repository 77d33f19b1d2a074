// A plug-in of which two builds are made that differ in one number.
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>

namespace {
using namespace pfaff;

struct Spring {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] * SPRING_STIFFNESS / 2;
  }
};

const System<Spring> registered{{.name = "test-spring",
                                 .title = "a spring",
                                 .reference = "su-qin",
                                 .description = "A spring of unit mass. It is there to be tested.",
                                 .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                 .initial = {1, 0}}};

// The canonical bracket times the stiffness.
struct Stiff {
  static constexpr int dimension = 2;
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    vector[0] = covector[1] * SPRING_STIFFNESS;
    vector[1] = -covector[0] * SPRING_STIFFNESS;
  }
};

const Bracket<Stiff> bracket{{.name = "test-stiff",
                              .title = "a multiple of the canonical bracket",
                              .reference = "su-qin",
                              .description = "The canonical bracket in two dimensions, times a number. It is "
                                             "there to be tested."}};

struct OwnVerlet : Verlet {
  using Composed = Composition<Verlet>;
};

const Method<OwnVerlet> method{{.name = "test-verlet",
                                .title = "Stoermer-Verlet of a plug-in",
                                .reference = "hairer-lubich-wanner2006 (I.1.17)",
                                .description = "Stoermer-Verlet once more. It is there to be tested.",
                                .order = 2,
                                .preserves = {Claim::symplectic, Claim::symmetric, Claim::reversible}}};
}  // namespace
