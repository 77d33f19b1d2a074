// Integrators that the compiler must refuse, because of the numbers that they take. Each comment `refused
// alone:` is the beginning of a message it must give, and there must be no other.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

// refused alone: step: expected template <HasVectorField P> Status step(const P& p, const Scalar<P>& t, const
struct StepWithoutWork {
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& /*z*/) const {
    return Status::converged;
  }
};
// refused alone: step: expected const Scalar<P>& t, const Scalar<P>& h and State<P>& z, and not doubles
struct StepOfDoubles {
  template <HasVectorField P, class W>
  Status step(const P& /*p*/, double /*t*/, double /*h*/, State<P>& /*z*/, W& /*w*/) const {
    return Status::converged;
  }
};
// refused alone: step: expected const Scalar<P>& t, const Scalar<P>& h and State<P>& z, and not doubles
struct StepOfVectors {
  template <HasVectorField P, class W>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, std::vector<double>& /*z*/,
              W& /*w*/) const {
    return Status::converged;
  }
};
// refused alone: parameter: expected a member of the type Real, such as Real nu = 0.3_r, and not a double
struct ParameterInDouble {
  double weight = 0.5;
  static std::vector<Parameter> parameters() {
    return {parameter(&ParameterInDouble::weight, "weight", "1", 0, 1, "of the slope")};
  }
  template <HasVectorField P, class W>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& /*z*/,
              W& /*w*/) const {
    return Status::converged;
  }
};
// refused alone: step: expected the concept of the facet that it needs, as in template <HasVectorField P>
struct StepOnEverything {
  template <class P, class W>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, W& /*w*/) const {
    z[0] += h * t * Scalar<P>(static_cast<int>(p.size()));
    return Status::converged;
  }
};

template <class M>
const Method<M> registered{{.name = "refused", .title = "", .reference = "", .order = 1}};
const MethodPlugin* const all[] = {&registered<StepWithoutWork>, &registered<StepOfDoubles>,
                                   &registered<StepOfVectors>, &registered<ParameterInDouble>,
                                   &registered<StepOnEverything>};
}  // namespace
