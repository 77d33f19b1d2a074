#include <pfaff/brackets/dirac/classification.hpp>

#include <algorithm>
#include <numeric>

#include <pfaff/brackets/dirac/elimination.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace pfaff {

namespace {

template <class T>
Matrix<T> submatrix(const Matrix<T>& w, const std::vector<std::size_t>& rows,
                    const std::vector<std::size_t>& columns) {
  Matrix<T> part(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) part(i, j) = w(rows[i], columns[j]);
  return part;
}

template <class T>
double one_norm(const Matrix<T>& a) {
  T worst(0);
  for (std::size_t j = 0; j < a.columns(); ++j) {
    T sum(0);
    for (std::size_t i = 0; i < a.rows(); ++i) sum = sum + abs(a(i, j));
    if (sum > worst) worst = sum;
  }
  return static_cast<double>(worst);
}

template <class T>
LU<T> factored(const Matrix<T>& a, bool& regular) {
  LU<T> lu(a.rows());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j) lu(i, j) = a(i, j);
  regular = lu.factor();
  return lu;
}

/// For each j of `free`, the combination e_j - sum_C x_C e_C of constraints that W[rows, :] takes to zero.
template <class T>
std::vector<Combination<T>> null_combinations(const Matrix<T>& w, const std::vector<std::size_t>& rows,
                                              const std::vector<std::size_t>& columns,
                                              const std::vector<std::size_t>& free) {
  std::vector<Combination<T>> all;
  bool regular = true;
  const LU<T> lu = factored(submatrix(w, rows, columns), regular);
  std::vector<T> right(rows.size()), x(rows.size());
  for (const std::size_t j : free) {
    Combination<T> combination(w.rows());
    combination[j] = T(1);
    for (std::size_t i = 0; i < rows.size(); ++i) right[i] = w(rows[i], j);
    if (!rows.empty()) lu.solve(right.data(), x.data());
    for (std::size_t i = 0; i < columns.size(); ++i) combination[columns[i]] = -x[i];
    all.push_back(std::move(combination));
  }
  return all;
}

template <class T>
void check(const Matrix<T>& w, const Matrix<T>& gradients, const Matrix<T>& sizes) {
  if (w.rows() != w.columns())
    throw InputError("classification: the matrix of brackets is " + std::to_string(w.rows()) + " x " +
                     std::to_string(w.columns()) + "; expected a square one");
  if (gradients.rows() > 0 && gradients.rows() != w.rows())
    throw InputError("classification: " + std::to_string(gradients.rows()) + " gradients of " +
                     std::to_string(w.rows()) + " constraints");
  if (sizes.rows() > 0 && (sizes.rows() != w.rows() || sizes.columns() != w.columns()))
    throw InputError("classification: sizes of terms must have the shape of the matrix of brackets");
  for (const Matrix<T>* m : {&w, &gradients, &sizes})
    for (const T& x : m->entries())
      if (!isfinite(x))
        throw InputError("classification: a bracket or a gradient is not finite at this point");
}

std::vector<std::size_t> sorted(std::vector<std::size_t> x) {
  std::sort(x.begin(), x.end());
  return x;
}

}  // namespace

template <class T>
std::size_t Classification<T>::rank() const {
  std::size_t sum = 0;
  for (const Pivot<T>& p : pivots) sum += p.rows.size();
  return sum;
}
template <class T>
bool Classification<T>::regular() const {
  return std::all_of(classes.begin(), classes.end(),
                     [](ConstraintClass c) { return c == ConstraintClass::second; });
}
template <class T>
std::vector<std::size_t> Classification<T>::members(ConstraintClass c) const {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < classes.size(); ++k)
    if (classes[k] == c) found.push_back(k);
  return found;
}
template <class T>
std::vector<std::size_t> Classification<T>::order() const {
  std::vector<std::size_t> all;
  for (const Pivot<T>& p : pivots) all.insert(all.end(), p.rows.begin(), p.rows.end());
  return all;
}

template <class T>
IndependentRows<T> independent_rows(const Matrix<T>& rows, double tolerance, const std::vector<T>& sizes) {
  // Orthogonalised rows, and each as a combination of the rows given. No roots: exact scalars have none.
  std::vector<std::vector<T>> basis, expressions;
  std::vector<T> lengths;  // squared
  IndependentRows<T> result;
  const std::size_t n = rows.columns();
  const auto product = [n](const std::vector<T>& a, const std::vector<T>& b) {
    T sum(0);
    for (std::size_t i = 0; i < n; ++i) sum = sum + a[i] * b[i];
    return sum;
  };
  const T accepted = std::numeric_limits<T>::is_exact ? T(0) : T(Real(Quad(tolerance)));
  for (std::size_t k = 0; k < rows.rows(); ++k) {
    std::vector<T> left(n), expression(rows.rows());
    for (std::size_t i = 0; i < n; ++i) left[i] = rows(k, i);
    expression[k] = T(1);
    T size = sizes.empty() ? T(0) : sizes[k];
    const T length = product(left, left);
    size = size * size > length ? size * size : length;
    for (int pass = 0; pass < 2; ++pass)  // twice is enough for orthogonality to round-off
      for (std::size_t b = 0; b < basis.size(); ++b) {
        const T share = product(left, basis[b]) / lengths[b];
        for (std::size_t i = 0; i < n; ++i) left[i] = left[i] - share * basis[b][i];
        for (std::size_t i = 0; i < rows.rows(); ++i)
          expression[i] = expression[i] - share * expressions[b][i];
      }
    const T rest = product(left, left);
    if (rest > accepted * accepted * size) {
      result.independent.push_back(k);
      basis.push_back(left);
      expressions.push_back(expression);
      lengths.push_back(rest);
    } else {
      result.dependent.push_back(k);
      result.combinations.push_back(expression);
    }
  }
  return result;
}

template <class T>
Classification<T> classify(const Matrix<T>& w, Symmetry symmetry, const Matrix<T>& gradients,
                           const Matrix<T>& sizes) {
  check(w, gradients, sizes);
  const std::size_t n = w.rows();
  Classification<T> result;
  result.symmetry = symmetry;
  result.classes.assign(n, ConstraintClass::first);
  std::vector<std::size_t> active(n);
  std::iota(active.begin(), active.end(), std::size_t{0});
  if (gradients.rows() > 0) {
    const double round_off =
        16 * static_cast<double>(std::max(n, gradients.columns())) * static_cast<double>(unit_roundoff<T>());
    IndependentRows<T> rows = independent_rows(gradients, round_off);
    for (const std::size_t k : rows.dependent) result.classes[k] = ConstraintClass::redundant;
    result.dependent = std::move(rows.combinations);
    active = rows.independent;
  }
  Elimination<T> left(w, symmetry, sizes, active);
  result.scale = left.scale();
  for (Pivot<T> pivot = left.best(); !pivot.rows.empty(); pivot = left.best()) {
    left.eliminate(pivot);
    result.pivots.push_back(std::move(pivot));
  }
  std::vector<std::size_t> rows = result.order(), columns;
  for (const Pivot<T>& p : result.pivots) columns.insert(columns.end(), p.columns.begin(), p.columns.end());
  if (sorted(rows) != sorted(columns)) {
    result.principal = false;
    for (const auto& candidate : {rows, columns}) {
      const Classification<T> part = classify(submatrix(w, candidate, candidate), symmetry);
      if (part.rank() != candidate.size()) continue;
      result.principal = true;
      rows = columns = candidate;
      break;
    }
  }
  std::vector<std::size_t> free;
  for (const std::size_t k : active)
    if (std::find(columns.begin(), columns.end(), k) == columns.end()) free.push_back(k);
  result.null = null_combinations(w, rows, columns, free);
  if (!result.principal) return result;
  result.null_on_left =
      symmetry == Symmetry::none ? null_combinations(w.transposed(), columns, rows, free) : result.null;
  for (const std::size_t k : rows) result.classes[k] = ConstraintClass::second;
  if (!rows.empty()) {
    const Matrix<T> second = submatrix(w, rows, rows);
    result.condition = one_norm(second) * one_norm(inverse(second));
  }
  return result;
}

template <class T>
PlainRecursion<T> plain_recursion(const Matrix<T>& w, Symmetry symmetry, std::span<const std::size_t> order) {
  const std::size_t step = symmetry == Symmetry::skew ? 2 : 1;
  if (order.size() % step != 0)
    throw InputError("recursion: a skew bracket eliminates constraints in pairs, and " +
                     std::to_string(order.size()) + " is odd");
  PlainRecursion<T> result;
  Elimination<T> left(w, symmetry, Matrix<T>(0, 0), {order.begin(), order.end()});
  for (std::size_t k = 0; k < order.size(); k += step) {
    Pivot<T> pivot{{order.begin() + static_cast<std::ptrdiff_t>(k),
                    order.begin() + static_cast<std::ptrdiff_t>(k + step)},
                   {},
                   {}};
    pivot.columns = pivot.rows;
    if (left.magnitude(pivot) == 0) {
      result.works = false;
      result.at = pivot.rows;
      break;
    }
    result.pivots.push_back(left.value(pivot));
    left.eliminate(pivot);
  }
  return result;
}

template <class T>
OrderElsewhere order_elsewhere(const Classification<T>& chosen, const Matrix<T>& w, double accepted) {
  if (w.rows() != chosen.classes.size())
    throw InputError("classification: the matrix of brackets has another size than the one classified");
  OrderElsewhere result;
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < chosen.classes.size(); ++k)
    if (chosen.classes[k] != ConstraintClass::redundant) active.push_back(k);
  Elimination<T> left(w, chosen.symmetry, Matrix<T>(0, 0), active);
  left.set_scale(chosen.scale);
  for (std::size_t step = 0; step < chosen.pivots.size(); ++step) {
    const Pivot<T>& pivot = chosen.pivots[step];
    const Pivot<T> best = left.best();
    const double available = best.rows.empty() ? 0 : left.magnitude(best), size = left.magnitude(pivot);
    const double ratio = available > 0 ? size / available : 0;
    if (ratio < result.ratio) {
      result.ratio = ratio;
      result.step = step;
    }
    if (size == 0) break;
    left.eliminate(pivot);
  }
  const bool more = result.ratio > 0 && !left.best().rows.empty();
  if (more) {
    result.ratio = 0;
    result.step = chosen.pivots.size();
  }
  result.good = result.ratio >= accepted;
  return result;
}

#define PFAFF_INSTANTIATE(T)                                                                            \
  template struct Classification<T>;                                                                    \
  template IndependentRows<T> independent_rows(const Matrix<T>&, double, const std::vector<T>&);        \
  template Classification<T> classify(const Matrix<T>&, Symmetry, const Matrix<T>&, const Matrix<T>&);  \
  template PlainRecursion<T> plain_recursion(const Matrix<T>&, Symmetry, std::span<const std::size_t>); \
  template OrderElsewhere order_elsewhere(const Classification<T>&, const Matrix<T>&, double);
PFAFF_INSTANTIATE(double)
PFAFF_INSTANTIATE(Quad)
PFAFF_INSTANTIATE(Rational)
#undef PFAFF_INSTANTIATE

}  // namespace pfaff
