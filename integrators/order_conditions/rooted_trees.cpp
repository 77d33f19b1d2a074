#include <pfaff/integrators/order_conditions/rooted_trees.hpp>

#include <algorithm>

namespace pfaff {

namespace {

// Appends the trees of `order` nodes whose root has the children so far and others that follow: children
// stand in decreasing order of their places, so that every set of them is met once.
void append_trees(int order, RootedTree& begun, std::vector<RootedTree>& trees, std::size_t known) {
  const int left = order - begun.order;
  if (left == 0) {
    trees.push_back(begun);
    trees.back().density *= order;
    return;
  }
  const std::size_t end = begun.children.empty() ? known : begun.children.back() + 1;
  for (std::size_t child = 0; child < end; ++child) {
    const int nodes = trees[child].order;
    const std::int64_t density = trees[child].density;
    if (nodes > left) break;
    begun.children.push_back(child);
    begun.order += nodes;
    begun.density *= density;
    append_trees(order, begun, trees, known);
    begun.children.pop_back();
    begun.order -= nodes;
    begun.density /= density;
  }
}

RungeKuttaTableau<Quad> magnitudes(const RungeKuttaTableau<Quad>& tableau) {
  RungeKuttaTableau<Quad> positive = tableau;
  for (auto* list : {&positive.a, &positive.b})
    for (Quad& x : *list) x = abs(x);
  return positive;
}

std::string entry(const char* name, std::size_t i) { return name + std::to_string(i + 1); }
std::string entry(const char* name, std::size_t i, std::size_t j) {
  return name + std::to_string(i + 1) + "," + std::to_string(j + 1);
}

}  // namespace

const std::vector<RootedTree>& rooted_trees() {
  static const std::vector<RootedTree> list = [] {
    std::vector<RootedTree> trees;
    for (int order = 1; order <= largest_tree; ++order) {
      RootedTree root;
      append_trees(order, root, trees, trees.size());
    }
    return trees;
  }();
  return list;
}

std::string to_string(const RootedTree& tree) {
  if (tree.children.empty()) return "t";
  std::string text;
  for (const std::size_t child : tree.children)
    text += (text.empty() ? "[" : ",") + to_string(rooted_trees()[child]);
  return text + "]";
}

std::vector<OrderCondition> tree_conditions(const RungeKuttaTableau<Quad>& tableau, int order) {
  const std::vector<Quad> weights = elementary_weights(tableau, order);
  const std::vector<Quad> sizes = elementary_weights(magnitudes(tableau), order);
  std::vector<OrderCondition> conditions;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const RootedTree& tree = rooted_trees()[k];
    conditions.push_back({"the tree " + to_string(tree) + ", Phi = 1/" + std::to_string(tree.density),
                          tree.order, weights[k] - Quad(1) / Quad(static_cast<double>(tree.density)),
                          std::max(Quad(1), sizes[k])});
  }
  return conditions;
}

OrderTheory tree_theory(const RungeKuttaTableau<Quad>& tableau, int order, bool is_explicit) {
  const std::size_t s = tableau.stages();
  const std::vector<Quad> weights = elementary_weights(tableau, order);
  const Quad amount(1e-9), least_change(1e-13);
  std::vector<std::size_t> entries;  // of a, that are coefficients
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < (is_explicit ? i : s); ++j) {
      RungeKuttaTableau<Quad> other = tableau;
      other.a[i * s + j] += amount;
      const std::vector<Quad> changed = elementary_weights(other, order);
      Quad change(0);
      for (std::size_t k = 0; k < weights.size(); ++k)
        change = std::max(change, abs(changed[k] - weights[k]));
      if (change > least_change) entries.push_back(i * s + j);
    }
  OrderTheory theory{"trees", order, tableau.b, {}};
  theory.sums.assign(s, 0);
  for (const std::size_t entry : entries) {
    theory.coefficients.push_back(tableau.a[entry]);
    theory.sums.push_back(OrderTheory::in_no_sum);
  }
  theory.conditions = [tableau, entries, order](const std::vector<Quad>& numbers) {
    RungeKuttaTableau<Quad> other = tableau;
    const auto end_of_b = numbers.begin() + static_cast<std::ptrdiff_t>(other.stages());
    std::copy(numbers.begin(), end_of_b, other.b.begin());
    for (std::size_t k = 0; k < entries.size(); ++k) other.a[entries[k]] = numbers[other.stages() + k];
    return tree_conditions(other, order);
  };
  return theory;
}

std::vector<OrderCondition> symplecticity_conditions(const RungeKuttaTableau<Quad>& tableau) {
  const std::size_t s = tableau.stages();
  const auto& [a, b] = tableau;
  std::vector<OrderCondition> conditions;
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = i; j < s; ++j) {
      const Quad left = b[i] * a[i * s + j], right = b[j] * a[j * s + i], product = b[i] * b[j];
      conditions.push_back({entry("b", i) + " " + entry("a", i, j) + " + " + entry("b", j) + " " +
                                entry("a", j, i) + " = " + entry("b", i) + " " + entry("b", j),
                            0, left + right - product,
                            std::max(Quad(1), abs(left) + abs(right) + abs(product))});
    }
  return conditions;
}

std::vector<OrderCondition> symmetry_conditions(const RungeKuttaTableau<Quad>& tableau) {
  const std::size_t s = tableau.stages();
  const auto& [a, b] = tableau;
  std::vector<OrderCondition> conditions;
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < s; ++j) {
      const std::size_t k = s - 1 - i, l = s - 1 - j;
      const Quad sum = a[k * s + l] + a[i * s + j];
      conditions.push_back({entry("a", k, l) + " + " + entry("a", i, j) + " = " + entry("b", j), 0,
                            sum - b[j],
                            std::max(Quad(1), abs(a[k * s + l]) + abs(a[i * s + j]) + abs(b[j]))});
    }
  return conditions;
}

}  // namespace pfaff
