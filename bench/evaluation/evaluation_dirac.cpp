// The part of an evaluation that is about Dirac's bracket: its tensor, and the motion by every solver beside
// that of the formulation.
#include <pfaff/bench/evaluation/evaluation_parts.hpp>
#include <pfaff/brackets/dirac/dirac.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraint_brackets.hpp>

namespace pfaff::evaluation_parts {

namespace {

// Up to so many constraints, what costs the cube of their number for every coordinate is evaluated too.
constexpr std::size_t most_determinants = 60;

// The data of a Dirac bracket in the phase space extended by time t and its conjugate momentum e, with {t, e}
// = 1 and the Hamiltonian H + e. There, constraints that depend on time are like any others.
template <class T>
class Extended {
 public:
  Extended(const Point<T>& at, const ConstraintBrackets<T>& b)
      : n_(at.z.size() + 2),
        count_(b.values.size()),
        gradients_(count_ * n_),
        sharps_(count_ * n_),
        covector_(n_),
        vector_(n_),
        brackets_(count_),
        tensor_(n_ * n_),
        gram_(b.brackets.entries()) {
    const std::size_t n = at.z.size();
    const auto energy = at.model->tape(Formula::hamiltonian);
    const auto slopes = at.values(at.model->tape(Formula::hamiltonian_gradient));
    std::copy(slopes.begin(), slopes.end(), covector_.begin());
    covector_[n] = at.values(std::make_shared<const Tape>(record(
        energy->inputs, 1, [&](const Recorded& s, std::span<const Recorded> x, std::span<Recorded> out) {
          out[0] = time_derivative(*energy, s, x)[0];
        })))[0];
    covector_[n + 1] = T(1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) tensor_[i * n_ + k] = b.tensor(i, k);
    tensor_[n * n_ + n + 1] = T(1);
    tensor_[(n + 1) * n_ + n] = T(-1);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t k = 0; k < n; ++k) gradients_[i * n_ + k] = b.gradients(i, k);
      gradients_[i * n_ + n] = b.rates[i];
      sharp(gradients_.data() + i * n_, sharps_.data() + i * n_);
    }
    sharp(covector_.data(), vector_.data());
    for (std::size_t i = 0; i < count_; ++i)
      brackets_[i] = detail::dot<T>(n_, gradients_.data() + i * n_, vector_.data());
  }
  [[nodiscard]] DiracData<T> data() const {
    return {n_, count_, Symmetry::skew, gradients_, sharps_, gram_, covector_, vector_, brackets_, tensor_};
  }
  /// W as doubles, by which a solver says whether it applies.
  [[nodiscard]] std::vector<double> doubles() const {
    std::vector<double> w;
    for (const T& x : gram_) w.push_back(static_cast<double>(x));
    return w;
  }

 private:
  void sharp(const T* covector, T* vector) const {
    for (std::size_t i = 0; i < n_; ++i) vector[i] = detail::dot<T>(n_, tensor_.data() + i * n_, covector);
  }
  std::size_t n_, count_;
  std::vector<T> gradients_, sharps_, covector_, vector_, brackets_, tensor_, gram_;
};

// The same system without the formulation that was chosen for it.
std::shared_ptr<const Model> unformulated(const Model& model) {
  ModelSource source = model.source();
  source.formulation.clear();
  source.formulation_parameters.clear();
  source.given[index(Formula::field)] = nullptr;
  source.programs[index(Formula::field)] = nullptr;
  return std::make_shared<const Model>(std::move(source));
}

// The least number `difference` for which |a - b| <= difference max(1, |b|) in every component.
template <class T>
T largest_difference(const std::vector<T>& a, const std::vector<T>& b) {
  T worst(0);
  for (std::size_t k = 0; k < b.size(); ++k) {
    const T size = abs(b[k]) > T(1) ? abs(b[k]) : T(1), difference = abs(a[k] - b[k]) / size;
    if (!(difference <= worst)) worst = difference;
  }
  return worst;
}

template <class T>
class Solvers {
 public:
  // `reference` is the right-hand side of Dirac's formulation; `friction` is the part of it that does not
  // come from the skew bracket and is added to the result of every solver.
  Solvers(const Extended<T>& extended, std::vector<T> reference, std::vector<T> friction)
      : data_(extended.data()),
        doubles_(extended.doubles()),
        reference_(std::move(reference)),
        friction_(std::move(friction)) {}

  template <class Solver>
  void add(const Solver& solver, const std::string& name, json& j) const {
    DiracData<double> shape;
    shape.dimension = data_.dimension;
    shape.count = data_.count;
    shape.symmetry = data_.symmetry;
    shape.gram = doubles_;
    if (!solver.applies(shape)) return;
    std::vector<T> result(data_.dimension);
    typename Solver::template Work<T> work(solver, data_.dimension, data_.count);
    const Status status = solver(data_, result, work);
    if (status != Status::converged) {
      j[name] = {{"rhs", nullptr}, {"difference", nullptr}, {"status", to_string(status)}};
      return;
    }
    result.resize(reference_.size());
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = result[k] + friction_[k];
    j[name] = {{"rhs", list(result)},
               {"difference", number(largest_difference(result, reference_))},
               {"status", to_string(status)}};
  }

 private:
  DiracData<T> data_;
  std::vector<double> doubles_;
  std::vector<T> reference_, friction_;
};

}  // namespace

template <class T>
void add_dirac_bracket(Point<T>& at, json& j) {
  const Model& model = *at.model;
  if (!model.constrained() || model.constraint_names().size() > most_dense) return;
  const ConstraintBrackets<T> brackets = constraint_brackets(model, at.t, at.z);
  const std::size_t n = at.z.size(), count = brackets.values.size();
  j["dirac_bracket"] = rows(dirac_tensor(brackets));

  const FormulationPlugin& dirac = dirac_formulation();
  const auto raw = unformulated(model);
  Assignments friction_form;
  for (const auto& [key, value] : model.source().formulation_parameters)
    if (key == "friction-form") friction_form.emplace_back(key, value);
  const auto reference = at.values(dirac.apply(raw, friction_form), Formula::field);
  auto friction = reference;
  const auto ideal = at.values(dirac.apply(raw, {{"friction-form", "none"}}), Formula::field);
  for (std::size_t k = 0; k < n; ++k) friction[k] = friction[k] - ideal[k];

  const Extended<T> extended(at, brackets);
  const Solvers<T> solvers(extended, reference, friction);
  json& found = j["solvers"] = json::object();
  const EliminationOrder order = pivoted_order(brackets.classes);
  const auto add = [&](const auto& solver) {
    solvers.add(solver, std::decay_t<decltype(solver)>::name, found);
  };
  add(DenseDirac{});
  if (model.holonomic())
    add(HolonomicDirac{
        std::make_shared<const SymmetricPattern>(model.holonomic_constraints<T>()->pattern())});
  SkewForestDirac forest;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i + 1; k < count; ++k)
      if (!(brackets.brackets(i, k) == T(0))) forest.edges.emplace_back(i, k);
  add(forest);
  add(RecursiveVectorsDirac{});
  solvers.add(RecursiveVectorsDirac{order}, std::string(RecursiveVectorsDirac::name) + "-pivoted", found);
  add(RecursiveTensorDirac{});
  solvers.add(RecursiveTensorDirac{order}, std::string(RecursiveTensorDirac::name) + "-pivoted", found);
  if (count > most_determinants) return;
  add(RecursiveLiteralDirac{});
  add(BorderedDirac{});
  add(PfaffianDirac{});
}

template void add_dirac_bracket(Point<double>&, json&);
template void add_dirac_bracket(Point<Quad>&, json&);

}  // namespace pfaff::evaluation_parts
