// Formulations that the compiler must refuse. Each comment `refused:` is the beginning of a message it must
// give.
#include <pfaff/core/formulation.hpp>

namespace {
using namespace pfaff;

// What is sound of them.
struct Free {
  template <class T>
  struct Work {
    Work(const Free& /*formulation*/, HolonomicConstraints<T>& /*constraints*/) {}
  };
  template <class T, class W>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, W& /*work*/) const {
    constraints.velocity(t, q, p, q_rate);
    constraints.force(t, q, p, p_rate);
    return Status::converged;
  }
};

// refused: field: expected template <class T> Status field(HolonomicConstraints<T>& constraints, const T& t,
struct FieldWithoutStatus {
  template <class T>
  struct Work {
    Work(const FieldWithoutStatus& /*formulation*/, HolonomicConstraints<T>& /*constraints*/) {}
  };
  template <class T>
  void field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate,
             Work<T>& /*work*/) const {
    constraints.velocity(t, q, p, q_rate);
    constraints.force(t, q, p, p_rate);
  }
};
// refused: Work: expected template <class T> struct Work with a constructor Work(const F&,
// HolonomicConstraints<T>&)
struct WorkOfSizes {
  template <class T>
  struct Work {
    Work(std::size_t /*degrees*/, std::size_t /*count*/) {}
  };
  template <class T>
  Status field(HolonomicConstraints<T>& /*constraints*/, const T& /*t*/, In<T> /*q*/, In<T> /*p*/,
               Out<T> /*q_rate*/, Out<T> /*p_rate*/, Work<T>& /*work*/) const {
    return Status::converged;
  }
};
// refused: field: expected template <class T> Status field(HolonomicConstraints<T>& constraints, const T& t,
struct FieldOfOtherConstraints {
  template <class T>
  struct Work {
    Work(const FieldOfOtherConstraints& /*formulation*/, VelocityConstraints<T>& /*constraints*/) {}
  };
  template <class T>
  Status field(HolonomicConstraints<T>& /*constraints*/, const T& /*t*/, In<T> /*q*/, In<T> /*p*/,
               Out<T> /*q_rate*/, Out<T> /*p_rate*/, Work<T>& /*work*/) const {
    return Status::converged;
  }
};
// refused: hamiltonian_tape: expected Tape hamiltonian_tape(const Model& model) const
struct EnergyShared {
  [[nodiscard]] std::shared_ptr<const Tape> hamiltonian_tape(const Model& /*model*/) const { return nullptr; }
};
// refused: hamiltonian_tape and field or field_tape make two motions of a system
struct EnergyAndField : Free {
  [[nodiscard]] Tape hamiltonian_tape(const Model& model) const { return *model.tape(Formula::hamiltonian); }
};
// refused: field_tape is written beside a field of holonomic constraints
struct FieldTapeOfVelocities {
  template <class T>
  struct Work {
    Work(const FieldTapeOfVelocities& /*formulation*/, VelocityConstraints<T>& /*constraints*/) {}
  };
  template <class T>
  Status field(VelocityConstraints<T>& /*constraints*/, const T& /*t*/, In<T> /*q*/, In<T> /*p*/,
               Out<T> /*q_rate*/, Out<T> /*p_rate*/, Work<T>& /*work*/) const {
    return Status::converged;
  }
  [[nodiscard]] Tape field_tape(const Model& model) const { return *model.tape(Formula::field); }
};
// refused: refuses: expected std::string refuses(const Model& model) const
struct RefusesSilently : Free {
  [[nodiscard]] bool refuses(const Model& /*model*/) const { return false; }
};
// refused: field_tape: expected Tape field_tape(const Model& model) const
struct FieldTapeShared : Free {
  [[nodiscard]] std::shared_ptr<const Tape> field_tape(const Model& /*model*/) const { return nullptr; }
};
// refused: keeps: expected std::vector<FormulationClaim> keeps() const
struct KeepsOfAModel : Free {
  [[nodiscard]] std::vector<FormulationClaim> keeps(const Model& /*model*/) const { return {}; }
};
// refused: friction: expected FrictionForm friction() const
struct FrictionByName : Free {
  std::string friction = "stokes";
};
// refused: instances: expected static std::vector<Assignments> instances(bool full)
struct InstancesWithoutFull : Free {
  static std::vector<Assignments> instances() { return {{}}; }
};
// refused: parameters: expected static std::vector<Parameter> parameters()
struct ParametersOfAnObject : Free {
  [[nodiscard]] std::vector<Parameter> parameters() const { return {}; }
};
// refused: a plug-in's struct must not be final
struct Closed final : Free {};

template <class F>
const Formulation<F> registered{{.name = "refused", .title = "", .reference = ""}};
const FormulationPlugin* const all[] = {&registered<FieldWithoutStatus>,
                                        &registered<WorkOfSizes>,
                                        &registered<FieldOfOtherConstraints>,
                                        &registered<EnergyShared>,
                                        &registered<EnergyAndField>,
                                        &registered<FieldTapeOfVelocities>,
                                        &registered<RefusesSilently>,
                                        &registered<FieldTapeShared>,
                                        &registered<KeepsOfAModel>,
                                        &registered<FrictionByName>,
                                        &registered<InstancesWithoutFull>,
                                        &registered<ParametersOfAnObject>,
                                        &registered<Closed>};
}  // namespace
