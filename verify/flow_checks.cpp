// The claims of a system that is split into parts that are solved exactly. A map phi_h that is a group,
// phi_s o phi_t = phi_(s+t), is the flow of its derivative at h = 0, so that with the sum of these
// derivatives, which has to be the field of the system, everything is said; and each flow has to keep the
// structure.
//
// Flows iterate, so that they are measured as numbers, with the derivatives of dual numbers.
#include <cmath>

#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/measured_step.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {

// The flows of a model near one state, for one scalar.
template <class T>
class MeasuredFlows {
 public:
  MeasuredFlows(std::shared_ptr<const Model> model, const std::vector<Real>& centre)
      : model_(std::move(model)),
        flows_(model_->exact_flows<T>()),
        dual_(model_->exact_flows<StepDual<T>>()),
        now_(generic_time_of(*model_)),
        // A quarter of the time in which the motion changes, as far as flows of one step go.
        time_(T(Real(own_time(*model_, now_, centre))) / T(4)) {
    for (const Real& x : centre) start_.push_back(T(x));
    for (const double x : coordinate_scales(*model_, now_, centre)) scales_.push_back(T(x));
  }

  // phi_s o phi_t - phi_(s+t) for times of either sign, t = -s among them, in units of the sizes that the
  // coordinates have or come to have on the way: one that starts next to zero may be moved far away.
  // Not-a-number where a flow fails.
  double off_group(std::size_t part) {
    double worst = 0;
    for (const auto& [first, second] : {std::pair{3, 5}, {7, -4}, {6, -6}, {-2, -7}}) {
      const T s = T(first) * time_ / T(8), t = T(second) * time_ / T(8);
      std::vector<T> first_end = start_, at_once = start_;
      if (!flow(part, s, first_end)) return no_step;
      std::vector<T> there = first_end;
      if (!flow(part, t, there) || !flow(part, s + t, at_once)) return no_step;
      for (std::size_t k = 0; k < start_.size(); ++k) {
        const T size = std::max({scales_[k], T(abs(first_end[k])), T(abs(at_once[k]))});
        worst = std::max(worst, static_cast<double>(T(abs(there[k] - at_once[k])) / size));
      }
    }
    return worst;
  }
  // The sum of the derivatives at h = 0 less the field, times the time, in units of the sizes of the
  // coordinates or of what the field moves them by in the time.
  double off_field() {
    using D = StepDual<T>;
    const std::size_t n = start_.size();
    std::vector<T> sum(n), field(n);
    std::vector<D> z(start_.begin(), start_.end()), change(n);
    for (std::size_t part = 0; part < model_->part_names().size(); ++part) {
      if (dual_->change(part, D::variable(T(0), 0), In<D>(z), Out<D>(change)) != Status::converged)
        return no_step;
      for (std::size_t k = 0; k < n; ++k) sum[k] = sum[k] + change[k].derivative[0];
    }
    Problem<T>(model_).field(T(now_), In<T>(start_), Out<T>(field));
    double worst = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const T size = std::max(scales_[k], T(abs(field[k])) * time_);
      worst = std::max(worst, static_cast<double>(T(abs(sum[k] - field[k])) * time_ / size));
    }
    return worst;
  }
  // How far the Jacobian of the flow is from keeping the structure of the system.
  double off_structure(std::size_t part) {
    const auto step = jacobian_of_map(
        start_, [&](std::vector<StepDual<T>>& z) { return flow(*dual_, part, StepDual<T>(time_), z); });
    if (step.status != Status::converged) return no_step;
    return static_cast<double>(KeptStructure<T>(model_)(step, T(now_), time_, start_, scales_));
  }

 private:
  template <class U>
  static Status flow(ExactFlows<U>& flows, std::size_t part, const U& h, std::vector<U>& z) {
    std::vector<U> change(z.size());
    const Status status = flows.change(part, h, In<U>(z), Out<U>(change));
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + change[k];
    return status;
  }
  bool flow(std::size_t part, const T& h, std::vector<T>& z) {
    return flow(*flows_, part, h, z) == Status::converged;
  }

  std::shared_ptr<const Model> model_;
  ExactFlowsPointer<T> flows_;
  ExactFlowsPointer<StepDual<T>> dual_;
  Real now_;
  T time_;
  std::vector<T> start_, scales_;
};

template <class T>
void check_in(std::vector<Check>& checks, const std::string& name, const std::shared_ptr<const Model>& model,
              const std::vector<Real>& centre) {
  MeasuredFlows<T> flows(model, centre);
  const auto add = [&](const std::string& claim, double measured) {
    checks.push_back(named(name, claim, name, precision_name<T>(), measured, tolerance<T>()));
    checks.back().scope = "a generic state";
    if (std::isnan(measured)) checks.back().reason = "a flow was not found";
  };
  const std::vector<std::string>& parts = model->part_names();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    add("flows of the " + parts[k] + " are a group", flows.off_group(k));
    if (KeptStructure<T>::applies(*model))
      add("flows of the " + parts[k] + " keep the structure", flows.off_structure(k));
  }
  add("flows of the parts add up to the field", flows.off_field());
}

}  // namespace

std::vector<Check> check_flows(const std::string& name, const std::shared_ptr<const Model>& model,
                               const std::vector<Real>& centre) {
  std::vector<Check> checks;
  check_in<double>(checks, name, model, centre);
  check_in<Quad>(checks, name, model, centre);
  return checks;
}

namespace {

// A pendulum split into drift and kick, with a drift that is wrong in one of these ways.
enum class FalseFlow { bent, stretched, slowed };
struct FaultyDrift {
  static constexpr int dimension = 2, part_count = 2;
  FalseFlow fault;
  static std::vector<std::string> part_names() { return {"drift", "kick"}; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -cos(q[0]);
  }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    const T millionth(Real::fraction(1, 1000000));
    change[0] = change[1] = T(0);
    if (part == 1) {
      change[1] = -(h * sin(z[0]));
    } else if (fault == FalseFlow::slowed) {  // the flow of q' = p, p' = -1e-6 p
      const T decay = exp(-(millionth * h)) - T(1);
      change[0] = -(decay * z[1] / millionth);
      change[1] = decay * z[1];
    } else {
      change[0] = z[1] * (fault == FalseFlow::bent ? T(h + millionth * h * h) : T(h + millionth * h));
    }
    return Status::converged;
  }
};

}  // namespace

std::vector<Check> check_false_flows() {
  std::vector<Check> controls;
  const auto control = [&](const char* what, FalseFlow fault, const std::string& claim) {
    const auto model = make_model(
        SystemDescriptor{
            .name = "faulty-drift", .title = "", .reference = "", .initial = {Real(1), Real::fraction(1, 2)}},
        FaultyDrift{fault});
    add_controls(controls, what, claim, check_flows("faulty-drift", model, model->initial()),
                 [&](const Check& check) { return check.claim == claim; });
  };
  control("a drift for the time h + 1e-6 h^2", FalseFlow::bent, "flows of the drift are a group");
  control("a drift stretched by 1e-6", FalseFlow::stretched, "flows of the parts add up to the field");
  control("a drift with friction of 1e-6", FalseFlow::slowed, "flows of the drift keep the structure");
  return controls;
}

}  // namespace pfaff
