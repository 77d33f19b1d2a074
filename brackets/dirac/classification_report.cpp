// What a classification says, in words.
#include <cmath>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace pfaff {

namespace {

std::string number(double x) { return to_string(Quad(x), 4); }

std::string bracket(Symmetry symmetry, const std::string& a, const std::string& b) {
  if (symmetry == Symmetry::skew) return "{" + a + ", " + b + "}";
  return "<" + a + ", " + b + ">";
}

/// "a", "a and b", "a, b and c".
std::string list(const std::vector<std::size_t>& members, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < members.size(); ++k)
    text += (k == 0 ? "" : k + 1 == members.size() ? " and " : ", ") + names[members[k]];
  return text;
}
std::string are(std::size_t count) { return count == 1 ? " is " : " are "; }

template <class T>
std::string pivot_text(const Pivot<T>& p, Symmetry symmetry, const std::vector<std::string>& names) {
  const std::string value = number(static_cast<double>(p.value));
  if (p.rows.size() == 1) return bracket(symmetry, names[p.rows[0]], names[p.columns[0]]) + " = " + value;
  if (symmetry == Symmetry::skew)
    return bracket(symmetry, names[p.rows[0]], names[p.rows[1]]) + " = " + value;
  return names[p.rows[0]] + " with " + names[p.rows[1]] + ", determinant " + value;
}

std::string level(std::size_t k) { return k == 0 ? "" : "^(" + std::to_string(k) + ")"; }

}  // namespace

template <class T>
std::string describe(const Combination<T>& combination, std::size_t first,
                     const std::vector<std::string>& names) {
  // What is left of a cancellation is not worth printing.
  const double negligible =
      64 * static_cast<double>(combination.size()) * static_cast<double>(unit_roundoff<T>());
  std::string text = names[first];
  for (std::size_t k = 0; k < combination.size(); ++k) {
    const auto c = static_cast<double>(combination[k]);
    if (k == first || std::abs(c) <= negligible) continue;
    text += c < 0 ? " - " : " + ";
    if (std::abs(c) != 1) text += number(std::abs(c)) + " ";
    text += names[k];
  }
  return text;
}

template <class T>
std::string describe(const Classification<T>& classification, const std::vector<std::string>& names) {
  std::string text;
  const auto second = classification.members(ConstraintClass::second);
  const auto first = classification.members(ConstraintClass::first);
  const auto redundant = classification.members(ConstraintClass::redundant);
  if (!second.empty())
    text += list(second, names) + are(second.size()) + "second class (rank " + std::to_string(second.size()) +
            ", condition of their brackets " + number(classification.condition) + ")\n";
  if (!classification.principal)
    text += "the brackets have rank " + std::to_string(classification.rank()) +
            ", but no set of that many constraints has regular brackets: there is no Dirac bracket\n";
  if (!classification.pivots.empty()) {
    text += "pivots: ";
    for (std::size_t k = 0; k < classification.pivots.size(); ++k)
      text += (k == 0 ? "" : "; ") + pivot_text(classification.pivots[k], classification.symmetry, names) +
              level(k);
    text += "\n";
  }
  if (!first.empty() && classification.principal) {
    text += list(first, names) + are(first.size()) + "first class: ";
    for (std::size_t k = 0; k < first.size(); ++k) {
      const auto own = classification.null.begin() + static_cast<std::ptrdiff_t>(k);
      // The member that the combination has coefficient 1 on.
      text += (k == 0 ? "" : "; ") + describe(*own, first[k], names);
    }
    text += first.size() == 1 ? " has" : " have";
    text += " vanishing brackets with every constraint\n";
  }
  for (std::size_t k = 0; k < redundant.size(); ++k)
    text += names[redundant[k]] + " is redundant: the gradient of " +
            describe(classification.dependent[k], redundant[k], names) + " vanishes\n";
  if (!text.empty()) text.pop_back();
  return text;
}

template <class T>
std::string describe(const PlainRecursion<T>& recursion, Symmetry symmetry,
                     std::span<const std::size_t> order, const std::vector<std::string>& names) {
  std::string text = "order ";
  for (std::size_t k = 0; k < order.size(); ++k) text += (k == 0 ? "" : ", ") + names[order[k]];
  if (recursion.works) {
    text += ": works, pivots";
    for (const T& p : recursion.pivots) text += " " + number(static_cast<double>(p));
    return text;
  }
  const std::size_t step = recursion.pivots.size(), taken = (step + 1) * recursion.at.size();
  text += ": breaks down at step " + std::to_string(step + 1) + ", " +
          bracket(symmetry, names[recursion.at.front()], names[recursion.at.back()]) + level(step) +
          " = 0: the leading minor of size " + std::to_string(taken) + " vanishes";
  return text;
}

#define PFAFF_INSTANTIATE(T)                                                                          \
  template std::string describe(const Combination<T>&, std::size_t, const std::vector<std::string>&); \
  template std::string describe(const Classification<T>&, const std::vector<std::string>&);           \
  template std::string describe(const PlainRecursion<T>&, Symmetry, std::span<const std::size_t>,     \
                                const std::vector<std::string>&);
PFAFF_INSTANTIATE(double)
PFAFF_INSTANTIATE(Quad)
PFAFF_INSTANTIATE(Rational)
#undef PFAFF_INSTANTIATE

}  // namespace pfaff
