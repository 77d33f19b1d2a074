#include <pfaff/brackets/birkhoffian/birkhoffian_form.hpp>

#include <array>
#include <stdexcept>

#include <pfaff/core/linear/singular_values.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

std::string_view to_string(BirkhoffianClass kind) {
  constexpr std::array<std::string_view, 3> names{"autonomous", "semi-autonomous", "nonautonomous"};
  return names[static_cast<std::size_t>(kind)];
}

BirkhoffianClass birkhoffian_class(const Model& model) {
  const bool action = model.facets().has(Facet::birkhoffian);
  const auto form = model.tape(action ? Formula::one_form : Formula::structure);
  const auto function = model.tape(action ? Formula::birkhoffian : Formula::covector);
  if (!form->autonomous()) return BirkhoffianClass::nonautonomous;
  return function->autonomous() ? BirkhoffianClass::autonomous : BirkhoffianClass::semi_autonomous;
}

namespace {
// Scales d with which the largest |d_i k_ij d_j| of every row is about 1. A row of zeros keeps the scale 1.
template <class T>
std::vector<T> balance(const Matrix<T>& k) {
  const std::size_t n = k.rows();
  std::vector<T> d(n, T(1)), next(n, T(1));
  // Each round halves the binary exponent of every row's largest entry. Doubles span 2048 exponents, so that
  // 16 rounds bring it close to 0.
  for (int round = 0; round < 16; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      T largest(0);
      for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, T(abs(d[i] * k(i, j) * d[j])));
      next[i] = largest > T(0) ? d[i] / sqrt(largest) : d[i];
    }
    d = next;
  }
  return d;
}

// Brings rows to reduced echelon form, each time with the largest entry that is left as pivot, and divides
// each row by its largest component.
template <class T>
void reduce(std::vector<std::vector<T>>& rows) {
  if (rows.empty()) return;
  const std::size_t n = rows.front().size();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::size_t from = r, pivot = 0;
    for (std::size_t i = r; i < rows.size(); ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (abs(rows[i][j]) > abs(rows[from][pivot])) from = i, pivot = j;
    std::swap(rows[r], rows[from]);
    const T value = rows[r][pivot];
    for (T& x : rows[r]) x = x / value;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == r) continue;
      const T factor = rows[i][pivot];
      for (std::size_t j = 0; j < n; ++j) rows[i][j] = rows[i][j] - factor * rows[r][j];
    }
  }
  for (auto& row : rows) {
    T largest(0);
    for (const T& x : row)
      if (abs(x) > abs(largest)) largest = x;
    for (T& x : row) {
      x = x / largest;
      // The round-off that elimination leaves in place of a zero.
      if (abs(x) < T(8 * static_cast<int>(n)) * std::numeric_limits<T>::epsilon()) x = T(0);
    }
  }
}

template <class T>
T ratio(const std::vector<T>& values) {
  const T largest = *std::max_element(values.begin(), values.end());
  const T smallest = *std::min_element(values.begin(), values.end());
  return smallest > T(0) ? largest / smallest : std::numeric_limits<T>::infinity();
}
}  // namespace

template <class T>
Degeneracy<T> degeneracy(const Matrix<T>& k) {
  const std::size_t n = k.rows();
  Degeneracy<T> result;
  for (const T& x : k.entries())
    if (!isfinite(x)) {
      result.condition = std::numeric_limits<T>::quiet_NaN();
      return result;
    }
  result.condition = ratio(singular_values(k).values);
  const std::vector<T> d = balance(k);
  Matrix<T> balanced(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) balanced(i, j) = d[i] * k(i, j) * d[j];
  const auto singular = singular_values(balanced);
  const T largest = *std::max_element(singular.values.begin(), singular.values.end());
  const T smallest = T(static_cast<int>(n)) * std::numeric_limits<T>::epsilon() * largest;
  for (std::size_t c = 0; c < n; ++c) {
    if (singular.values[c] > smallest) continue;
    result.kernel.emplace_back();
    for (std::size_t i = 0; i < n; ++i) result.kernel.back().push_back(singular.vectors(i, c));
  }
  reduce(result.kernel);  // among coordinates of like size
  for (auto& vector : result.kernel)
    for (std::size_t i = 0; i < n; ++i) vector[i] = d[i] * vector[i];
  reduce(result.kernel);
  result.regular = result.kernel.empty();
  return result;
}

template <class T>
BirkhoffianForm<T> birkhoffian_form(const Model& model, const std::optional<std::vector<Real>>& centre,
                                    const T& t, In<T> z) {
  const auto structure = model.tape(Formula::structure), covector = model.tape(Formula::covector);
  std::shared_ptr<const Tape> form, function;
  if (model.facets().has(Facet::birkhoffian) && !centre) {
    form = model.tape(Formula::one_form);
    function = model.tape(Formula::birkhoffian);
  } else {
    if (!centre) throw std::invalid_argument("birkhoffian_form: a model without F and B needs a centre");
    ActionForm action = inverse_problem(*structure, *covector, *centre);
    form = std::make_shared<const Tape>(std::move(action.one_form));
    function = std::make_shared<const Tape>(std::move(action.birkhoffian));
  }
  const auto rate = std::make_shared<const Tape>(
      record(model.dimension(), model.dimension(),
             [&](const Recorded& s, std::span<const Recorded> x, std::span<Recorded> out) {
               const auto timed = time_derivative(*form, s, x);
               std::copy(timed.begin(), timed.end(), out.begin());
             }));
  const auto values = [&](const std::shared_ptr<const Tape>& tape) {
    std::vector<T> out(tape->outputs.size());
    Replay<T> replay(tape);
    replay(t, z.data(), out.data());
    return out;
  };
  const std::vector<T> k = values(structure);
  const Matrix<T> matrix(z.size(), k);
  return {matrix,
          values(covector),
          values(form),
          values(rate),
          values(function)[0],
          degeneracy(matrix),
          self_adjointness<T>(structure, *covector, t, z)};
}

template Degeneracy<double> degeneracy(const Matrix<double>&);
template Degeneracy<Quad> degeneracy(const Matrix<Quad>&);
template BirkhoffianForm<double> birkhoffian_form(const Model&, const std::optional<std::vector<Real>>&,
                                                  const double&, In<double>);
template BirkhoffianForm<Quad> birkhoffian_form(const Model&, const std::optional<std::vector<Real>>&,
                                                const Quad&, In<Quad>);

}  // namespace pfaff
