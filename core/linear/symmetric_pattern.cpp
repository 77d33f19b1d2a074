#include <pfaff/core/linear/symmetric_pattern.hpp>

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <stdexcept>
#include <string>

namespace pfaff {

namespace {

using PlanIndex = EliminationPlan::Index;
using Coupling = SymmetricPattern::Coupling;

PlanIndex narrow(std::size_t i) { return static_cast<PlanIndex>(i); }

/// The neighbours of every row, each with the coupling that leads to it.
struct Graph {
  struct Neighbour {
    PlanIndex row, coupling;
  };
  std::vector<std::size_t> start;
  std::vector<Neighbour> neighbours;

  Graph(std::size_t rows, const std::vector<Coupling>& couplings)
      : start(rows + 1), neighbours(2 * couplings.size()) {
    for (const auto& [i, j] : couplings) ++start[i + 1], ++start[j + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t c = 0; c < couplings.size(); ++c) {
      const auto& [i, j] = couplings[c];
      neighbours[next[i]++] = {narrow(j), narrow(c)};
      neighbours[next[j]++] = {narrow(i), narrow(c)};
    }
  }
  [[nodiscard]] std::size_t degree(std::size_t i) const { return start[i + 1] - start[i]; }
  [[nodiscard]] std::span<const Neighbour> of(std::size_t i) const {
    return {neighbours.data() + start[i], degree(i)};
  }
};

/// Follows couplings from `row` until they end or close, appending rows and links; true where they close.
bool follow(const Graph& graph, std::size_t row, std::size_t none, std::vector<char>& seen,
            EliminationPlan& plan) {
  const std::size_t first = row;
  PlanIndex arrived_by = narrow(none);
  for (;;) {
    seen[row] = 1;
    plan.order.push_back(narrow(row));
    const auto neighbours = graph.of(row);
    const auto onward = std::find_if(neighbours.begin(), neighbours.end(), [&](const Graph::Neighbour& n) {
      return n.coupling != arrived_by && (seen[n.row] == 0 || n.row == first);
    });
    if (onward == neighbours.end()) {
      plan.link.push_back(narrow(none));
      return false;
    }
    plan.link.push_back(onward->coupling);
    if (onward->row == first) return true;
    arrived_by = onward->coupling;
    row = onward->row;
  }
}

/// Paths one after the other, or one ring; false where the graph is neither.
bool plan_paths_or_ring(const Graph& graph, std::size_t rows, std::size_t couplings, bool& ring,
                        EliminationPlan& plan) {
  for (std::size_t i = 0; i < rows; ++i)
    if (graph.degree(i) > 2) return false;
  std::vector<char> seen(rows);
  for (std::size_t i = 0; i < rows; ++i)
    if (seen[i] == 0 && graph.degree(i) < 2) follow(graph, i, couplings, seen, plan);
  ring = plan.order.empty() && rows > 0;
  if (!ring) return plan.order.size() == rows;
  follow(graph, 0, couplings, seen, plan);
  return plan.order.size() == rows;
}

/// Rows in the order of a maximum cardinality search, last found first. It has no fill if any order has
/// none (tarjan-yannakakis1984).
std::vector<PlanIndex> leaf_first(const Graph& graph, std::size_t rows) {
  // Rows not yet found, in lists by the number of their found neighbours.
  const PlanIndex none = narrow(rows);
  std::vector<PlanIndex> head(rows + 1, none), next(rows, none), previous(rows, none), found_neighbours(rows);
  std::vector<char> found(rows);
  const auto insert = [&](PlanIndex i) {
    PlanIndex& first = head[found_neighbours[i]];
    next[i] = first;
    previous[i] = none;
    if (first != none) previous[first] = i;
    first = i;
  };
  const auto remove = [&](PlanIndex i) {
    if (next[i] != none) previous[next[i]] = previous[i];
    if (previous[i] != none)
      next[previous[i]] = next[i];
    else
      head[found_neighbours[i]] = next[i];
  };
  for (std::size_t i = rows; i-- > 0;) insert(narrow(i));
  std::vector<PlanIndex> order(rows);
  std::size_t most = 0;
  for (std::size_t k = rows; k-- > 0;) {
    while (head[most] == none) --most;
    const PlanIndex i = head[most];
    remove(i);
    found[i] = 1;
    order[k] = i;
    for (const auto& n : graph.of(i))
      if (found[n.row] == 0) {
        remove(n.row);
        ++found_neighbours[n.row];
        insert(n.row);
      }
    ++most;
  }
  return order;
}

std::vector<PlanIndex> positions_of(const std::vector<PlanIndex>& order) {
  std::vector<PlanIndex> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = narrow(k);
  return position;
}

/// True where elimination in this order couples no rows that are not coupled already, that is, where all
/// later neighbours of a row are neighbours of the first of them. That first one is asked about the others
/// when its turn comes.
bool without_fill(const Graph& graph, const std::vector<PlanIndex>& order) {
  const std::vector<PlanIndex> position = positions_of(order);
  const std::size_t rows = order.size();
  std::vector<std::vector<PlanIndex>> asked(rows);
  std::vector<PlanIndex> mark(rows, narrow(rows));
  for (std::size_t k = 0; k < rows; ++k) {
    const PlanIndex i = order[k];
    // The questions asked of row i come from rows before it, so that they are complete by now.
    for (const auto& n : graph.of(i)) mark[n.row] = i;
    for (const PlanIndex row : asked[i])
      if (mark[row] != i) return false;
    PlanIndex first = narrow(rows);
    for (const auto& n : graph.of(i))
      if (position[n.row] > k && (first == rows || position[n.row] < position[first])) first = n.row;
    if (first == rows) continue;
    for (const auto& n : graph.of(i))
      if (position[n.row] > k && n.row != first) asked[first].push_back(n.row);
    asked[i] = {};
  }
  return true;
}

/// An order of minimum degree: the next row is always one with the fewest couplings left, fill included (of
/// equal ones, the row with the lower number).
std::vector<PlanIndex> minimum_degree(const Graph& graph, std::size_t rows) {
  std::vector<std::set<PlanIndex>> left(rows);
  for (std::size_t i = 0; i < rows; ++i)
    for (const auto& n : graph.of(i)) left[i].insert(n.row);
  std::set<std::pair<std::size_t, PlanIndex>> queue;
  for (std::size_t i = 0; i < rows; ++i) queue.emplace(left[i].size(), narrow(i));
  std::vector<PlanIndex> order;
  while (!queue.empty()) {
    const PlanIndex i = queue.begin()->second;
    queue.erase(queue.begin());
    order.push_back(i);
    for (const PlanIndex j : left[i]) queue.erase({left[j].size(), j});
    for (const PlanIndex j : left[i]) {
      left[j].erase(i);
      for (const PlanIndex k : left[i])
        if (k != j) left[j].insert(k);
    }
    for (const PlanIndex j : left[i]) queue.emplace(left[j].size(), j);
    left[i].clear();
  }
  return order;
}

/// For every k, the positions of the later rows that the k-th row is coupled with in the factor, sorted.
/// They come from its own couplings and from its children, the earlier rows whose first later row it is:
/// their other later rows are coupled with it by fill.
std::vector<std::vector<PlanIndex>> factor_rows(const Graph& graph, const std::vector<PlanIndex>& order) {
  const std::size_t rows = order.size();
  const std::vector<PlanIndex> position = positions_of(order);
  std::vector<std::vector<PlanIndex>> entries(rows);  // positions
  std::vector<std::vector<PlanIndex>> children(rows);
  std::vector<PlanIndex> mark(rows, narrow(rows));
  for (std::size_t k = 0; k < rows; ++k) {
    auto& mine = entries[k];
    const auto add = [&](PlanIndex p) {
      if (p > k && mark[p] != k) {
        mark[p] = narrow(k);
        mine.push_back(p);
      }
    };
    for (const auto& n : graph.of(order[k])) add(position[n.row]);
    for (const PlanIndex child : children[k])
      for (const PlanIndex p : entries[child]) add(p);
    std::sort(mine.begin(), mine.end());
    if (!mine.empty()) children[mine.front()].push_back(narrow(k));
  }
  return entries;
}

/// An order with the same fill in which rows that do not wait for each other are neighbours: first the rows
/// that wait for none, then those that wait for these only, and so on. Independent branches of a tree are
/// then eliminated side by side.
std::vector<PlanIndex> by_levels(const std::vector<PlanIndex>& order,
                                 const std::vector<std::vector<PlanIndex>>& entries) {
  const std::size_t rows = order.size();
  std::vector<PlanIndex> level(rows), at(rows), result(rows);
  for (std::size_t k = 0; k < rows; ++k)
    if (!entries[k].empty()) level[entries[k].front()] = std::max(level[entries[k].front()], level[k] + 1);
  std::iota(at.begin(), at.end(), PlanIndex(0));
  std::stable_sort(at.begin(), at.end(), [&](PlanIndex a, PlanIndex b) { return level[a] < level[b]; });
  for (std::size_t k = 0; k < rows; ++k) result[k] = order[at[k]];
  return result;
}

/// Entries, their couplings and the targets of the updates, for plan.order.
void plan_entries(const Graph& graph, const std::vector<std::vector<PlanIndex>>& entries,
                  std::size_t couplings, EliminationPlan& plan) {
  const std::size_t rows = plan.order.size();
  plan.start.assign(1, 0);
  for (std::size_t k = 0; k < rows; ++k) plan.start.push_back(plan.start.back() + narrow(entries[k].size()));
  plan.row.reserve(plan.start.back());
  plan.coupling.reserve(plan.start.back());
  std::vector<PlanIndex> known(rows, narrow(couplings)), place(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    const auto neighbours = graph.of(plan.order[k]);
    for (const auto& n : neighbours) known[n.row] = n.coupling;
    for (const PlanIndex p : entries[k]) {
      plan.row.push_back(plan.order[p]);
      plan.coupling.push_back(known[plan.order[p]]);
    }
    for (const auto& n : neighbours) known[n.row] = narrow(couplings);
  }
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t b = 0; b < entries[k].size(); ++b) {
      const PlanIndex column = entries[k][b];
      // All later rows of k beyond `column` are later rows of `column`.
      auto at = entries[column].begin();
      for (std::size_t a = b + 1; a < entries[k].size(); ++a) {
        at = std::lower_bound(at, entries[column].end(), entries[k][a]);
        plan.target.push_back(plan.start[column] +
                              narrow(static_cast<std::size_t>(at - entries[column].begin())));
      }
    }
}

}  // namespace

SymmetricPattern::SymmetricPattern(std::size_t rows, std::vector<Coupling> couplings)
    : rows_(rows), couplings_(std::move(couplings)) {
  for (auto& [i, j] : couplings_) {
    if (i == j || i >= rows || j >= rows)
      throw std::invalid_argument("pattern of " + std::to_string(rows) + " rows: coupling (" +
                                  std::to_string(i) + ", " + std::to_string(j) +
                                  ") does not join two different rows of it");
    if (i > j) std::swap(i, j);
  }
  std::sort(couplings_.begin(), couplings_.end());
  couplings_.erase(std::unique(couplings_.begin(), couplings_.end()), couplings_.end());
  const std::size_t count = couplings_.size(), all = rows < 2 ? 0 : rows * (rows - 1) / 2;
  const auto set_natural_order = [&] {
    plan_.order.resize(rows);
    std::iota(plan_.order.begin(), plan_.order.end(), PlanIndex(0));
  };
  if (count == 0) {
    set_natural_order();
    return;
  }
  const Graph graph(rows, couplings_);
  if (bool ring = false; plan_paths_or_ring(graph, rows, count, ring, plan_)) {
    structure_ = ring ? MatrixStructure::cyclic : MatrixStructure::tridiagonal;
    fill_ = ring ? rows - 3 : 0;
    for (std::size_t k = 0; k < rows; ++k)
      plan_.natural = plan_.natural && plan_.order[k] == k && plan_.link[k] == k;
    return;
  }
  plan_ = {};
  structure_ = MatrixStructure::dense;
  if (count < all) {
    plan_.order = leaf_first(graph, rows);
    structure_ = MatrixStructure::tree;
    if (!without_fill(graph, plan_.order)) {
      plan_.order = minimum_degree(graph, rows);
      structure_ = MatrixStructure::sparse;
    }
    plan_.order = by_levels(plan_.order, factor_rows(graph, plan_.order));
    const auto entries = factor_rows(graph, plan_.order);
    const std::size_t total =
        std::accumulate(entries.begin(), entries.end(), std::size_t(0),
                        [](std::size_t sum, const auto& mine) { return sum + mine.size(); });
    fill_ = total - count;
    if (structure_ == MatrixStructure::tree || 4 * total < 3 * all) {
      plan_entries(graph, entries, count, plan_);
      return;
    }
  }
  structure_ = MatrixStructure::dense;
  fill_ = all - count;
  set_natural_order();
}

SymmetricPattern SymmetricPattern::path(std::size_t rows) {
  std::vector<Coupling> couplings;
  for (std::size_t k = 0; k + 1 < rows; ++k) couplings.emplace_back(k, k + 1);
  return {rows, std::move(couplings)};
}

std::size_t SymmetricPattern::coupling(std::size_t i, std::size_t j) const {
  const Coupling wanted = std::minmax(i, j);
  const auto found = std::lower_bound(couplings_.begin(), couplings_.end(), wanted);
  return found == couplings_.end() || *found != wanted ? npos
                                                       : static_cast<std::size_t>(found - couplings_.begin());
}

}  // namespace pfaff
