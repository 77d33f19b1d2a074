// How well single steps keep the structure of the system, along a run.
//
// The residual of M^T K(z', t') M = K(z, t), M being the Jacobian of one step from a state of the run, over
// the size of the terms that it is the difference of (KeptStructure). A method that keeps the structure has
// it at round-off at every step size; where it falls with the step it is accuracy.
#include <cmath>

#include <pfaff/runs/history.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/linear_step.hpp>
#include <pfaff/runs/support/structure.hpp>

namespace {
using namespace pfaff;

struct Structure {
  // The Jacobian of a step costs as the cube of their number. Beyond this it would take most of a run.
  static constexpr int most_coordinates = 64;
  int count = 50;

  static std::vector<Parameter> parameters() {
    return {parameter(&Structure::count, "looks", "", 1, 1000, "at steps of the run")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    return {{.name = "residual", .digits = 6}};
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    return StructureResidual<double>::applies(model) && model.dimension() <= most_coordinates
               ? ""
               : "needs a symplectic, K-symplectic or Poisson system of at most " +
                     std::to_string(most_coordinates) + " coordinates; " + model.name() + " is none";
  }
  // The Jacobian of a single step says nothing of the map of several states that a method with history is.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    const Integration<T>& start = run.start;
    if (keeps_history(start.method(), start.model(), Quad(start.time()), Quad(start.step()),
                      {start.state().begin(), start.state().end()}))
      return {};
    return evenly(run.steps, count);
  }

  template <class T>
  struct Work {
    StructureResidual<T> residual;
    Work(const Structure& /*measure*/, const Measured<T>& run)
        : residual(run.start.method(), run.start.model()) {}
  };
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    row = {work.residual(at.t, run.start.step(), {at.z.begin(), at.z.end()})};
    return true;
  }

  // A step of RK4 of the oscillator is a turn times the root of its determinant d = even^2 + odd^2, which is
  // also the largest of the terms: the residual is |d - 1|/d.
  static std::vector<MeasureControl> controls() {
    const double determinant = std::norm(factor_of_rk4({0, 0.1}));
    const auto of = [](const char* method) {
      return MeasureControl::of("harmonic-oscillator", method, "0.1", 10);
    };
    const double known = 1e-15;  // some roundings of numbers of size one
    return {of("verlet").gives("residual", 0, known), of("rk4").does_not_give("residual", 0, known),
            of("rk4").gives("residual", (1 - determinant) / determinant, known)};
  }
};

const Measure<Structure> registered{
    {.name = "structure",
     .title = "How well single steps keep the structure of the system",
     .reference = "hairer-lubich-wanner2006 VI.2",
     .description =
         "The residual of the structure that the exact flow keeps, symplectic, K-symplectic or Poisson, of "
         "one "
         "step from states of the run, over the size of the terms that it is the difference of. At round-off "
         "it is kept. Methods that remember earlier steps have no rows.",
     .watches = {Claim::symplectic, Claim::k_symplectic, Claim::poisson}}};
}  // namespace
