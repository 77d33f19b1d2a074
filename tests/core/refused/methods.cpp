// Integrators that the compiler must refuse. Each comment `refused:` is the beginning of a message it must
// give.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

// What is sound of them.
struct Euler {
  template <class P>
  struct Work {
    State<P> slope;
    Work(const Euler& /*method*/, const P& p) : slope(p.make_state()) {}
  };
  template <HasVectorField P, class W>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, W& w) const {
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * w.slope[k];
    return Status::converged;
  }
};

// refused: order: expected int order(const Model& model) const
struct OrderOfNothing : Euler {
  [[nodiscard]] int order() const { return 1; }
};
// refused: preserves: expected std::vector<Claim> preserves(const Model& model) const
struct PreservesNotConst : Euler {
  std::vector<Claim> preserves(const Model& /*model*/) { return {Claim::none}; }
};
// refused: validate: expected void validate()
struct ValidateWithArgument : Euler {
  void validate(int /*unused*/) {}
};
// refused: coefficients: expected std::span<Quad> coefficients()
struct CoefficientsAsCopy : Euler {
  std::array<double, 1> numbers{1};
  std::span<double> coefficients() { return numbers; }
};
// refused: refuses: expected std::string refuses(const Model& model) const
struct RefusesByBool : Euler {
  [[nodiscard]] bool refuses(const Model& /*model*/) const { return false; }
};
// refused: instances: expected static std::vector<Assignments> instances(bool full)
struct InstancesOfAnObject : Euler {
  [[nodiscard]] std::vector<Assignments> instances(bool /*full*/) const { return {{}}; }
};
// refused: advance_to: expected template <class P> Status advance_to(const P& p, double& t, double end,
// const Tolerance<double>& tolerance,
struct AdvanceToANumber : Euler {
  template <class P>
  Status advance_to(const P& /*p*/, double& /*t*/, double /*end*/, double /*tolerance*/, State<P>& /*z*/,
                    Work<P>& /*w*/) const {
    return Status::converged;
  }
};
// refused: processed, preprocess, kernel, postprocess: expected bool processed() const and, all three of
struct ProcessedWithoutKernel : Euler {
  [[nodiscard]] bool processed() const { return true; }
};
// refused: fixed_sizes: expected static constexpr bool fixed_sizes
struct FixedSizesOfAnObject : Euler {
  bool fixed_sizes = false;
};
// refused: compensated: expected a member bool compensated
struct CompensatedByFunction : Euler {
  [[nodiscard]] bool compensated() const { return true; }
};
// refused: Composed: expected using Composed = Composition<the method without Composed>, or another method
struct ComposableByConstant : Euler {
  static constexpr bool Composed = true;
};
// refused: Composed: expected using Composed = Composition<the method without Composed>, or another method
struct ComposedOfNoWeights : Euler {
  using Composed = Euler;
};
// refused: parameters: expected static std::vector<Parameter> parameters()
struct ParametersOfAnObject : Euler {
  [[nodiscard]] std::vector<Parameter> parameters() const { return {}; }
};
// refused: Work: expected template <class P> struct Work with a constructor Work(const M&, const P&)
struct WorkWithoutProblem {
  template <class P>
  struct Work {
    explicit Work(const WorkWithoutProblem& /*method*/) {}
  };
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& /*z*/,
              Work<P>& /*w*/) const {
    return Status::converged;
  }
};
// refused: step: expected template <HasVectorField P> Status step(const P& p, const Scalar<P>& t, const
struct StepWithoutTime {
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*h*/, State<P>& /*z*/) const {
    return Status::converged;
  }
};
// refused: restart of Work: expected void restart()
// refused: hand_over of Work: expected void hand_over(Work& next)
struct WorkOfAnotherProtocol {
  template <class P>
  struct Work {
    Work(const WorkOfAnotherProtocol& /*method*/, const P& /*p*/) {}
    void restart(bool /*all*/) {}
    void hand_over() {}
  };
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& /*z*/,
              Work<P>& /*w*/) const {
    return Status::converged;
  }
};
// refused: a plug-in's struct must not be final
struct Closed final : Euler {};

template <class M>
const Method<M> registered{{.name = "refused", .title = "", .reference = "", .order = 1}};
const MethodPlugin* const all[] = {&registered<OrderOfNothing>,
                                   &registered<PreservesNotConst>,
                                   &registered<ValidateWithArgument>,
                                   &registered<CoefficientsAsCopy>,
                                   &registered<RefusesByBool>,
                                   &registered<InstancesOfAnObject>,
                                   &registered<AdvanceToANumber>,
                                   &registered<ProcessedWithoutKernel>,
                                   &registered<FixedSizesOfAnObject>,
                                   &registered<CompensatedByFunction>,
                                   &registered<ComposableByConstant>,
                                   &registered<ComposedOfNoWeights>,
                                   &registered<ParametersOfAnObject>,
                                   &registered<WorkWithoutProblem>,
                                   &registered<StepWithoutTime>,
                                   &registered<WorkOfAnotherProtocol>,
                                   &registered<Closed>};
}  // namespace
