// Integrators that throw: no std::exception once the time is beyond 0.45, and where they are asked of a
// model.
#include <stdexcept>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Odd {};

// Euler's explicit step, up to a time.
struct ThrowsLate {
  template <HasVectorField P>
  Status step(const P& problem, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*work*/) const {
    if (value_of(t) > Value<Scalar<P>>(0.45)) throw Odd{};
    State<P> rate = z;
    problem.field(t, z, rate);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += h * rate[k];
    return Status::converged;
  }
};
const Method<ThrowsLate> throws_late{{.name = "throws-late",
                                      .title = "throws after t = 0.45",
                                      .reference = "hairer-lubich-wanner (I.1.5)",
                                      .order = 1,
                                      .preserves = {Claim::none}}};

struct ThrowsOfModels : ThrowsLate {
  [[nodiscard]] std::string refuses(const Model& /*model*/) const {
    throw std::runtime_error("no word of any model");
  }
};
const Method<ThrowsOfModels> throws_of_models{{.name = "throws-of-models",
                                               .title = "throws where it is asked of a model",
                                               .reference = "hairer-lubich-wanner (I.1.5)",
                                               .order = 1,
                                               .preserves = {Claim::none}}};
}  // namespace
