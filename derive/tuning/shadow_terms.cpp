#include <pfaff/derive/tuning/shadow_terms.hpp>

#include <cmath>
#include <map>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {

using SharedTape = std::shared_ptr<const Tape>;

// {f, g} = f_q.g_p - f_p.g_q
SharedTape poisson_bracket(const Tape& f, const Tape& g, std::size_t n) {
  return std::make_shared<const Tape>(
      record(static_cast<int>(n), 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        const std::vector<Recorded> one{Recorded(1)}, state(z.begin(), z.end());
        const auto of_f = gradient(f, t, state, one), of_g = gradient(g, t, state, one);
        for (std::size_t i = 0; i < n / 2; ++i)
          out[0] += of_f[i] * of_g[n / 2 + i] - of_f[n / 2 + i] * of_g[i];
      }));
}

// The brackets of the two energies by words, each made once.
class Brackets {
 public:
  Brackets(const Model& model, const Words& words)
      : words_(words), n_(static_cast<std::size_t>(model.dimension())) {
    for (const std::size_t part : {0U, 1U}) {
      const SharedTape energy = model.tape(part == 0 ? Formula::kinetic : Formula::potential);
      const std::size_t first = part == 0 ? n_ / 2 : 0;
      made_[words.extended(0, part)] = std::make_shared<const Tape>(
          record(static_cast<int>(n_), 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
            out[0] = evaluate(*energy, t, z.subspan(first, n_ / 2)).front();
          }));
    }
  }
  // That of a Lyndon word.
  SharedTape of(std::size_t word) {
    if (const auto found = made_.find(word); found != made_.end()) return found->second;
    const auto [beginning, ending] = words_.factors(word);
    const SharedTape before = of(beginning), after = of(ending);
    return made_[word] = poisson_bracket(*before, *after, n_);
  }

 private:
  const Words& words_;
  std::size_t n_;
  std::map<std::size_t, SharedTape> made_;
};

// The gradient of one function, and so its vector field up to the order and the signs of its components.
SharedTape gradient_tape(const Tape& function, std::size_t n) {
  return std::make_shared<const Tape>(record(
      static_cast<int>(n), static_cast<int>(n), [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        const std::vector<Recorded> one{Recorded(1)}, state(z.begin(), z.end());
        const auto slopes = gradient(function, t, state, one);
        std::copy(slopes.begin(), slopes.end(), out.begin());
      }));
}

// The upper triangular R with R^T R = the matrix, which is positive semidefinite: where a pivot is rounding,
// the brackets before it are all that counts.
std::vector<double> root_of(std::vector<double> matrix, std::size_t n) {
  std::vector<double> root(n * n, 0.0);
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, matrix[k * n + k]);
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = matrix[k * n + k];
    if (!(pivot > 1e-14 * largest)) continue;
    for (std::size_t j = k; j < n; ++j) root[k * n + j] = matrix[k * n + j] / std::sqrt(pivot);
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j < n; ++j) matrix[i * n + j] -= root[k * n + i] * root[k * n + j];
  }
  return root;
}

}  // namespace

ShadowTerms::ShadowTerms(const Model& model, const SplittingLogarithm& logarithm, double step,
                         const std::vector<std::vector<double>>& states) {
  const auto n = static_cast<std::size_t>(model.dimension());
  const Words& words = logarithm.words();
  Brackets brackets(model, words);
  std::vector<Replay<double>> fields;
  std::vector<double> factors;  // h^(d - 1)
  for (const std::size_t word : logarithm.lyndon()) {
    fields.emplace_back(gradient_tape(*brackets.of(word), n));
    factors.push_back(std::pow(step, words.degree(word) - 1));
  }
  size_ = fields.size();
  Replay<double> kinetic(gradient_tape(*brackets.of(words.extended(0, 0)), n)),
      potential(gradient_tape(*brackets.of(words.extended(0, 1)), n));

  double positions = 0, momenta = 0;
  for (const auto& z : states)
    for (std::size_t i = 0; i < n; ++i) (i < n / 2 ? positions : momenta) += z[i] * z[i];
  // The gradient in q moves p and the other way round.
  const auto weight = [&](std::size_t i) { return i < n / 2 ? 1 / momenta : 1 / positions; };

  std::vector<double> gram(size_ * size_, 0.0), other(n);
  std::vector<std::vector<double>> field(size_, std::vector<double>(n));
  double own = 0;
  for (const auto& z : states) {
    for (std::size_t k = 0; k < size_; ++k) {
      fields[k](0, z.data(), field[k].data());
      for (double& x : field[k]) x *= factors[k];
    }
    for (Replay<double>* part : {&kinetic, &potential}) {
      (*part)(0, z.data(), other.data());
      for (std::size_t i = 0; i < n; ++i) own += weight(i) * other[i] * other[i];
    }
    for (std::size_t k = 0; k < size_; ++k)
      for (std::size_t j = 0; j < size_; ++j)
        for (std::size_t i = 0; i < n; ++i) gram[k * size_ + j] += weight(i) * field[k][i] * field[j][i];
  }
  for (double& x : gram) x /= own;
  root_ = root_of(std::move(gram), size_);
}

std::vector<double> ShadowTerms::weighted(const std::vector<double>& c) const {
  std::vector<double> result(size_, 0.0);
  for (std::size_t k = 0; k < size_; ++k)
    for (std::size_t j = k; j < size_; ++j) result[k] += root_[k * size_ + j] * c[j];
  return result;
}

double ShadowTerms::of(const std::vector<double>& c) const {
  double sum = 0;
  for (const double x : weighted(c)) sum += x * x;
  return std::sqrt(sum);
}

}  // namespace pfaff
