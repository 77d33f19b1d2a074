// The Dirac bracket as a decorator: a bracket of a bracket and constraints.
//
//   const auto bracket = dirac(CanonicalBracket{}, constraints);          // W factored densely
//   const auto bracket = dirac(base, constraints, RecursiveVectorsDirac{}, Symmetry::symmetric);
//
// eta_D(f, g) = eta(f, g) - eta(f, phi_i) (W^-1)_ij eta(phi_j, g), for every bilinear base bracket: skew,
// symmetric or neither (nguyen-turski (1.2), (3.5)). The result is a bracket like any other (it has sharp),
// so that Dirac brackets may be bases of further ones. It is applied to covectors: no n x n tensor is formed
// unless a solver asks for one. The constraints are Casimirs of it, off their surface too, and where the base
// obeys Jacobi's identity so does it (Prop. 6).
//
// Repeated evaluations use a DiracEvaluator, which owns every buffer and returns a status; sharp() makes one,
// and throws where the bracket does not exist.
#pragma once

#include <stdexcept>
#include <utility>

#include <pfaff/brackets/dirac/coefficient_solvers.hpp>
#include <pfaff/brackets/dirac/constraint_set.hpp>
#include <pfaff/brackets/dirac/determinant_solvers.hpp>
#include <pfaff/brackets/dirac/recursive_solvers.hpp>

namespace pfaff {

/// There is no Dirac bracket at a state; what() says which constraints are at fault.
class NoDiracBracket : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// Fills DiracData at a state, with buffers of its own.
template <class T, class Base, class Constraints>
class DiracGram {
 public:
  DiracGram(const Base& base, const Constraints& constraints, Symmetry symmetry, std::size_t dimension,
            bool with_tensor)
      : base_(base),
        constraints_(constraints),
        derived_(constraints, dimension),
        dimension_(dimension),
        count_(constraints.count()),
        symmetry_(symmetry),
        gradients_(count_ * dimension),
        sharps_(count_ * dimension),
        gram_(count_ * count_),
        vector_(dimension),
        brackets_(count_),
        unit_(with_tensor ? dimension : 0),
        column_(unit_.size()),
        tensor_(unit_.size() * unit_.size()) {}

  /// Computes everything that depends on the state alone.
  void place(const T& t, In<T> z) {
    const std::size_t n = dimension_;
    if constexpr (WritesGradients<Constraints, T>) {
      constraints_.gradients(t, z, Out<T>(gradients_));
    } else {
      derived_(constraints_, t, z, Out<T>(gradients_));
    }
    for (std::size_t i = 0; i < count_; ++i)
      base_.sharp(t, z, In<T>(gradients_).subspan(i * n, n), Out<T>(sharps_).subspan(i * n, n));
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < count_; ++j)
        gram_[i * count_ + j] = detail::dot<T>(n, gradients_.data() + i * n, sharps_.data() + j * n);
    for (std::size_t j = 0; j < unit_.size(); ++j) {
      for (std::size_t i = 0; i < n; ++i) unit_[i] = T(i == j ? 1 : 0);
      base_.sharp(t, z, In<T>(unit_), Out<T>(column_));
      for (std::size_t i = 0; i < n; ++i) tensor_[i * n + j] = column_[i];
    }
  }
  /// The data of the state last placed, with a covector.
  DiracData<T> with(const T& t, In<T> z, In<T> covector) {
    base_.sharp(t, z, covector, Out<T>(vector_));
    for (std::size_t i = 0; i < count_; ++i)
      brackets_[i] = detail::dot<T>(dimension_, gradients_.data() + i * dimension_, vector_.data());
    return {dimension_, count_, symmetry_, gradients_, sharps_, gram_, covector, vector_, brackets_, tensor_};
  }
  /// The classes of the constraints at the state last placed.
  [[nodiscard]] Classification<T> classification() const {
    return classify(Matrix<T>(count_, gram_), symmetry_, Matrix<T>(count_, gradients_));
  }

 private:
  const Base& base_;
  const Constraints& constraints_;
  DerivedGradients<Constraints, T> derived_;
  std::size_t dimension_, count_;
  Symmetry symmetry_;
  std::vector<T> gradients_, sharps_, gram_, vector_, brackets_, unit_, column_, tensor_;
};

/// Applies a Dirac bracket again and again without allocation (but for the literal recursion and the
/// determinants, which are references). It refers to the bracket, which must outlive it.
template <class T, class Bracket>
class DiracEvaluator {
 public:
  DiracEvaluator(const Bracket& bracket, std::size_t dimension)
      : bracket_(bracket),
        gram_(bracket.base, bracket.constraints, bracket.symmetry, dimension, Bracket::Solver::wants_tensor),
        work_(bracket.solver, dimension, bracket.constraints.count()) {}

  /// vector = sharp_D(covector); `singular` where a pivot of the solver vanishes, and for an odd number of
  /// constraints of a skew bracket, whose determinant is zero but for rounding.
  Status operator()(const T& t, In<T> z, In<T> covector, Out<T> vector) {
    if (bracket_.symmetry == Symmetry::skew && bracket_.constraints.count() % 2 != 0) return Status::singular;
    gram_.place(t, z);
    const DiracData<T> data = gram_.with(t, z, covector);
    const Status status = bracket_.solver(data, vector, work_);
    if constexpr (detail::has_numbers<T>)
      if (status == Status::converged)
        for (const T& x : vector)
          if (!isfinite(value_of(x))) return Status::non_finite;
    return status;
  }

 private:
  const Bracket& bracket_;
  DiracGram<T, typename Bracket::Base, typename Bracket::Constraints> gram_;
  typename Bracket::Solver::template Work<T> work_;
};

template <class BaseBracket, class ConstraintsOf, class SolverOf>
struct DiracBracket {
  using Base = BaseBracket;
  using Constraints = ConstraintsOf;
  using Solver = SolverOf;
  Base base;
  Constraints constraints;
  Solver solver;
  Symmetry symmetry = Symmetry::skew;  // of the base, and so of this bracket

  /// vector = sharp_D(covector). NoDiracBracket, with the reason, where the solver breaks down; in double and
  /// quad also where W is singular to working precision (pivots made of rounding do not vanish) and where the
  /// solver is not one for these constraints.
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Quad>) refuse_where_none(t, z, covector);
    DiracEvaluator<T, DiracBracket> evaluator(*this, z.size());
    if (evaluator(t, z, covector, vector) != Status::converged) throw NoDiracBracket(why_not(t, z));
  }

  /// The classes of the constraints at a state: second class where the bracket exists, and what is wrong
  /// where it does not. T is double, Quad or an exact rational.
  template <class T>
  [[nodiscard]] Classification<T> classes(const T& t, In<T> z) const {
    DiracGram<T, Base, Constraints> gram(base, constraints, symmetry, z.size(), false);
    gram.place(t, z);
    return gram.classification();
  }

 private:
  [[nodiscard]] std::vector<std::string> constraint_names() const {
    if constexpr (requires { constraints.names(); }) {
      return constraints.names();
    } else {
      std::vector<std::string> names;
      for (std::size_t i = 1; i <= constraints.count(); ++i) names.push_back("phi" + std::to_string(i));
      return names;
    }
  }
  template <class T>
  void refuse_where_none(const T& t, In<T> z, In<T> covector) const {
    DiracGram<T, Base, Constraints> gram(base, constraints, symmetry, z.size(), false);
    gram.place(t, z);
    const DiracData<T> data = gram.with(t, z, covector);
    // Numbers that are not finite are the evaluation's to report.
    for (const T& w : data.gram)
      if (!isfinite(w)) return;
    const Classification<T> found = gram.classification();
    if (!found.regular()) throw NoDiracBracket(describe(found, constraint_names()));
    std::vector<double> rounded;
    for (const T& w : data.gram) rounded.push_back(static_cast<double>(w));
    DiracData<double> shape;
    shape.dimension = data.dimension;
    shape.count = data.count;
    shape.symmetry = symmetry;
    shape.gram = rounded;
    if (!solver.applies(shape))
      throw NoDiracBracket(
          std::string(Solver::name) + ": not a solver for the brackets of these constraints, " +
          std::string(to_string(symmetry)) + "; expected the structure it is for, or the " + "dense solver");
  }
  template <class T>
  [[nodiscard]] std::string why_not(const T& t, In<T> z) const {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Quad>) {
      const Classification<T> found = classes<T>(t, z);
      if (!found.regular()) return describe(found, constraint_names());
      return std::string(Solver::name) + ": a pivot vanishes in the order of elimination; expected " +
             "another order, or the dense solver";
    } else {
      return std::string(Solver::name) + ": the matrix of the constraints' brackets is singular";
    }
  }
};

/// The Dirac bracket of `base` and `constraints`; `symmetry` is the base's.
template <class Base, class Constraints, class Solver = DenseDirac>
DiracBracket<Base, Constraints, Solver> dirac(Base base, Constraints constraints, Solver solver = {},
                                              Symmetry symmetry = Symmetry::skew) {
  return {std::move(base), std::move(constraints), std::move(solver), symmetry};
}

}  // namespace pfaff
