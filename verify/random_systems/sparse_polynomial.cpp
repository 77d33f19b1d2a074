#include <pfaff/verify/random_systems/sparse_polynomial.hpp>

#include <algorithm>
#include <numeric>

namespace pfaff {

SparsePolynomial SparsePolynomial::constant(std::size_t variables, const Real& value) {
  SparsePolynomial p(variables);
  p.add(Powers(variables + 1), value);
  return p;
}

SparsePolynomial SparsePolynomial::variable(std::size_t variables, std::size_t index) {
  SparsePolynomial p(variables);
  Powers powers(variables + 1);
  powers[index] = 1;
  p.add(powers, 1);
  return p;
}

int SparsePolynomial::degree() const {
  int largest = 0;
  for (const auto& [powers, c] : terms_)
    largest = std::max(largest, std::accumulate(powers.begin(), powers.end(), 0));
  return largest;
}

bool SparsePolynomial::homogeneous(int degree) const {
  return std::all_of(terms_.begin(), terms_.end(), [&](const auto& term) {
    const Powers& powers = term.first;
    return powers.back() == 0 && std::accumulate(powers.begin(), powers.end(), 0) == degree;
  });
}

bool SparsePolynomial::depends_on(std::size_t index) const {
  return std::any_of(terms_.begin(), terms_.end(), [&](const auto& term) { return term.first[index] != 0; });
}

void SparsePolynomial::add(const Powers& powers, const Real& c) {
  const auto [place, added] = terms_.try_emplace(powers, c);
  if (!added) place->second = place->second + c;
  if (place->second.is(0)) terms_.erase(place);
}

SparsePolynomial operator+(SparsePolynomial a, const SparsePolynomial& b) {
  for (const auto& [powers, c] : b.terms_) a.add(powers, c);
  return a;
}

SparsePolynomial operator-(SparsePolynomial a, const SparsePolynomial& b) {
  for (const auto& [powers, c] : b.terms_) a.add(powers, -c);
  return a;
}

SparsePolynomial operator*(const SparsePolynomial& a, const SparsePolynomial& b) {
  SparsePolynomial product(a.variables_);
  for (const auto& [left, c] : a.terms_)
    for (const auto& [right, d] : b.terms_) {
      Powers powers = left;
      for (std::size_t k = 0; k < powers.size(); ++k) powers[k] += right[k];
      product.add(powers, c * d);
    }
  return product;
}

SparsePolynomial operator*(const Real& c, const SparsePolynomial& a) {
  SparsePolynomial product(a.variables_);
  for (const auto& [powers, d] : a.terms_) product.add(powers, c * d);
  return product;
}

SparsePolynomial SparsePolynomial::derivative(std::size_t index) const {
  SparsePolynomial slope(variables_);
  for (const auto& [powers, c] : terms_) {
    if (powers[index] == 0) continue;
    Powers lower = powers;
    --lower[index];
    slope.add(lower, Real(powers[index]) * c);
  }
  return slope;
}

SparsePolynomial SparsePolynomial::at(const std::vector<SparsePolynomial>& values) const {
  const std::size_t n = values.front().variables_;
  const SparsePolynomial time = variable(n, n);
  SparsePolynomial sum(n);
  for (const auto& [powers, c] : terms_) {
    SparsePolynomial product = constant(n, c);
    for (std::size_t k = 0; k < powers.size(); ++k)
      for (int power = 0; power < powers[k]; ++power) product = product * (k < variables_ ? values[k] : time);
    sum = sum + product;
  }
  return sum;
}

Real SparsePolynomial::exactly(const Real& t, const std::vector<Real>& z) const {
  return (*this)(t, In<Real>(z));
}

std::string SparsePolynomial::text(const std::function<std::string(std::size_t index)>& name) const {
  std::string text;
  for (const auto& [powers, c] : terms_) {
    const bool negative = c < Real(0);
    const Real size = negative ? -c : c;
    // A fraction is written as a factor before and a divisor behind the product.
    const std::string number = to_string(size);
    const std::size_t bar = number.find('/');
    std::string product;
    for (std::size_t k = 0; k < powers.size(); ++k)
      if (powers[k] > 0)
        product +=
            (product.empty() ? "" : "*") + name(k) + (powers[k] > 1 ? "^" + std::to_string(powers[k]) : "");
    const std::string factor = number.substr(0, bar);
    if (product.empty()) {
      product = factor;
    } else if (factor != "1") {
      product.insert(0, factor + "*");
    }
    if (bar != std::string::npos) product += number.substr(bar);
    text += text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    text += product;
  }
  return text.empty() ? "0" : text;
}

}  // namespace pfaff
