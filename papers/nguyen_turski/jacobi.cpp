// Nguyen & Turski, Propositions 1, 2 and 6, (3.20), (3.21): Jacobi's identity. Exact, off the constraint
// surface.
#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/conformance/bracket_function.hpp>
#include <pfaff/brackets/conformance/polynomial_brackets.hpp>
#include <pfaff/brackets/reduction/almost_dirac.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>
#include <pfaff/papers/printed/jacobi.hpp>

namespace pfaff::nguyen_turski {

namespace {

template <class B, class C>
using Dirac = AlmostDiracReduction<B, C, DiracComplement<B>>;

void propositions(Rows& rows) {
  ExactSamples samples(10);
  constexpr std::size_t n = 6;
  const PolynomialConstraints constraints(2, n, samples.random());
  const auto z = samples.point(n);
  const auto residual = [&](const auto& bracket) {
    return static_cast<Quad>(jacobi_residual<Rational>(bracket, Rational(0), z).residual);
  };
  const Dirac<CanonicalBracket, PolynomialConstraints> dirac{{}, constraints, {}};
  const AlmostDiracReduction<CanonicalBracket, PolynomialConstraints, NormalComplement> almost{
      {}, constraints, {}};
  rows.reproduced("Proposition 1, Proposition 2", "Jacobi of the reduction along P(TN^0)", zeros(1),
                  {residual(dirac)});
  const auto left = static_cast<double>(residual(almost));
  rows.qualitative("after (2.1)", "almost Poisson only", {"Jacobi may not hold", "residual " + shown(left)},
                   {at_least(left, clearly)}, "Jacobi fails for the reduction along normals");
  // Two nested levels: rank 4 of constraints in seven dimensions with a bracket that depends on the point.
  const NambuCanonicalBracket poisson{Polynomial(3, samples.random())};
  const PolynomialConstraints four(4, 7, samples.random());
  const Dirac<NambuCanonicalBracket, PolynomialConstraints> deeper{poisson, four, {poisson}};
  const auto at = samples.point(7);
  rows.reproduced("Proposition 6", "Jacobi of a Dirac bracket off the surface", zeros(1),
                  {static_cast<Quad>(jacobi_residual<Rational>(deeper, Rational(0), at).residual)});
  const PolynomialBracket skew(Symmetry::skew, n, samples.random());
  const Dirac<PolynomialBracket, PolynomialConstraints> broken{skew, constraints, {skew}};
  const auto control = static_cast<double>(residual(broken));
  rows.qualitative("Proposition 6", "hypothesis", {"Lie or Poisson bracket", "residual " + shown(control)},
                   {at_least(control, clearly)}, "control: a skew bracket without Jacobi has none");
}

// A polynomial of the printed formulas as the engine's brackets take functions: a value for any scalar, and a
// gradient by dual numbers. Its coefficients are integers.
struct EngineFunction {
  printed::Polynomial polynomial;

  template <class T>
  T operator()(In<T> z) const {
    T sum(0);
    for (const auto& [powers, coefficient] : polynomial.terms()) {
      T term(static_cast<int>(static_cast<double>(coefficient)));
      for (std::size_t k = 0; k < powers.size(); ++k)
        for (int power = 0; power < powers[k]; ++power) term = term * z[k];
      sum = sum + term;
    }
    return sum;
  }
  template <class T>
  std::vector<T> gradient(In<T> z) const {
    return gradient_by_duals<T>(*this, z);
  }
};
struct EngineTensor {
  printed::PolynomialTensor entries;
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (std::size_t i = 0; i < z.size(); ++i) {
      vector[i] = T(0);
      for (std::size_t j = 0; j < z.size(); ++j)
        vector[i] = vector[i] + EngineFunction{entries[i][j]}.template operator()<T>(z) * covector[j];
    }
  }
};
struct EngineConstraints {
  std::vector<EngineFunction> functions;
  [[nodiscard]] std::size_t count() const { return functions.size(); }
  template <class T>
  void gradients(const T& /*t*/, In<T> z, Out<T> rows) const {
    for (std::size_t k = 0; k < functions.size(); ++k) {
      const auto slope = functions[k].gradient<T>(z);
      for (std::size_t i = 0; i < z.size(); ++i) rows[k * z.size() + i] = slope[i];
    }
  }
};

// A sum of every variable and some products of two or three, with coefficients from -3 to 3.
printed::Polynomial random_polynomial(ExactSamples& samples, std::size_t n, int products) {
  std::uniform_int_distribution<int> coefficient(-3, 3), degree(2, 3);
  std::uniform_int_distribution<std::size_t> variable(0, n - 1);
  auto& random = samples.random();
  printed::Polynomial sum;
  const auto factor = [&](std::size_t k) { return printed::Polynomial::variable(k); };
  for (std::size_t k = 0; k < n; ++k)
    sum = sum + printed::Polynomial(Rational(coefficient(random))) * factor(k);
  for (int k = 0; k < products; ++k) {
    printed::Polynomial term(Rational(coefficient(random)));
    for (int power = degree(random); power > 0; --power) term = term * factor(variable(random));
    sum = sum + term;
  }
  return sum;
}

// {f, {g, h}} + {g, {h, f}} + {h, {f, g}} of a bracket of the engine.
template <class B>
Rational jacobi_sum(const B& bracket, const std::vector<EngineFunction>& functions,
                    const std::vector<Rational>& z) {
  Rational sum(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const BracketFunction inner(bracket, functions[(k + 1) % 3], functions[(k + 2) % 3]);
    sum = sum + BracketFunction(bracket, functions[k], inner).template operator()<Rational>(z);
  }
  return sum;
}

// (3.20) by the engine's brackets, the nine sums of three functions and two constraints.
template <class B>
std::vector<Rational> sums(const B& bracket, const std::vector<EngineFunction>& functions,
                           const std::vector<EngineFunction>& phi, const std::vector<Rational>& z) {
  std::vector<Rational> list;
  for (std::size_t i = 0; i < 2; ++i)
    for (const auto& [left, right] : {std::pair{0U, 1U}, {0U, 2U}, {2U, 1U}})
      list.push_back(jacobi_sum(bracket, {functions[left], functions[right], phi[i]}, z));
  for (std::size_t k = 0; k < 3; ++k) list.push_back(jacobi_sum(bracket, {functions[k], phi[0], phi[1]}, z));
  return list;
}

void expansions(Rows& rows) {
  ExactSamples samples(11);
  // Five dimensions: on the level sets of two constraints in four, every skew bracket obeys Jacobi's
  // identity.
  constexpr std::size_t n = 5;
  std::vector<printed::Polynomial> printed_functions, printed_constraints;
  for (int k = 0; k < 3; ++k) printed_functions.push_back(random_polynomial(samples, n, 3));
  for (int k = 0; k < 2; ++k) printed_constraints.push_back(random_polynomial(samples, n, 2));
  printed::PolynomialTensor tensor(n, std::vector<printed::Polynomial>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      tensor[i][j] = random_polynomial(samples, n, 1);
      tensor[j][i] = printed::Polynomial() - tensor[i][j];
    }
  std::vector<Rational> z;
  for (std::size_t k = 0; k < n; ++k)
    z.push_back(Rational(static_cast<int>((3 * k * k + 2) % 7) - 2) / Rational(4));
  std::vector<EngineFunction> functions;
  for (const auto& f : printed_functions) functions.push_back({f});
  const EngineConstraints constraints{{{printed_constraints[0]}, {printed_constraints[1]}}};
  const EngineTensor skew{tensor};
  const Dirac<EngineTensor, EngineConstraints> dirac{skew, constraints, {skew}};
  const Rational jacobi = jacobi_sum(dirac, functions, z);
  rows.reproduced("(3.21)", "an identity for any skew bracket",
                  quads({printed::jacobi_expansion(tensor, printed_functions, printed_constraints, z)}),
                  quads({jacobi}));
  const auto size = std::abs(static_cast<double>(jacobi));
  rows.qualitative("(3.21)", "without Jacobi", {"-", "Jacobi " + shown(size)}, {at_least(size, clearly)},
                   "control: both sides above differ from 0");
  // The canonical bracket of six dimensions is Poisson.
  std::vector<EngineFunction> of_six;
  for (int k = 0; k < 5; ++k) of_six.push_back({random_polynomial(samples, 6, 4)});
  const std::vector<EngineFunction> first(of_six.begin(), of_six.begin() + 3),
      last(of_six.begin() + 3, of_six.end());
  rows.reproduced("(3.20)", "the sums of a Poisson bracket", zeros(9),
                  quads(sums(CanonicalBracket{}, first, last, samples.point(6))));
  const std::vector<Rational> broken = sums(skew, functions, constraints.functions, z);
  double largest_sum = 0;
  for (const Rational& x : broken) largest_sum = std::max(largest_sum, std::abs(static_cast<double>(x)));
  rows.qualitative("(3.20)", "without Jacobi", {"-", "up to " + shown(largest_sum)},
                   {at_least(largest_sum, clearly)}, "control: the sums of a skew bracket do not vanish");
}

}  // namespace

void jacobi_rows(Rows& rows) {
  propositions(rows);
  expansions(rows);
}

}  // namespace pfaff::nguyen_turski
