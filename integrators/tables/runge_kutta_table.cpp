// Tables of the kind "runge-kutta": a (rows; what is missing at the end of a row is zero), b, and c, which
// must be the row sums of a. Methods whose a is strictly lower triangular are explicit; the others solve
// their stages as Gauss collocation does, for which their nodes have to differ.
#include <algorithm>

#include <pfaff/integrators/order_conditions/rooted_trees.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace {
using namespace pfaff;

/// An explicit method of any number of stages.
struct ExplicitTable {
  static constexpr bool fixed_sizes = false;
  RungeKuttaTableau<Quad> tableau;
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&ExplicitTable::compensated, "compensated", "compensated summation")};
  }
  /// The weights b: changing one of them breaks consistency.
  std::span<Quad> coefficients() { return tableau.b; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> a, b, c, rate;  // rate: [stage][component]
    State<P> point, carry;
    Work(const ExplicitTable& method, const P& p) : point(p.make_state()), carry(p.make_state()) {
      const std::size_t s = method.tableau.stages();
      for (const Quad& x : method.tableau.a) a.push_back(T(Real(x)));
      for (const Quad& x : method.tableau.b) b.push_back(T(Real(x)));
      for (std::size_t i = 0; i < s; ++i) {
        Quad sum(0);
        for (std::size_t j = 0; j < i; ++j) sum += method.tableau.a[i * s + j];
        c.push_back(T(Real(sum)));
      }
      rate.resize(s * p.size(), T(0));
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t s = w.b.size(), n = z.size();
    for (std::size_t i = 0; i < s; ++i) {
      for (std::size_t k = 0; k < n; ++k) w.point[k] = z[k] + h * sum(w, w.a.data() + i * s, i, k, n);
      p.field(t + w.c[i] * h, w.point, Out<T>(w.rate.data() + i * n, n));
    }
    for (std::size_t k = 0; k < n; ++k)
      add_to(z[k], w.carry[k], h * sum(w, w.b.data(), s, k, n), compensated);
    return Status::converged;
  }

 private:
  // sum over j < count of weights_j rate_j, component k of n
  template <class W, class T>
  static T sum(const W& w, const T* weights, std::size_t count, std::size_t k, std::size_t n) {
    T total(0);
    for (std::size_t j = 0; j < count; ++j) total = total + weights[j] * w.rate[j * n + k];
    return total;
  }
};

/// An implicit one, with different nodes.
struct ImplicitTable : Collocation<> {
  static constexpr bool fixed_sizes = false;
  static std::vector<Parameter> parameters() {
    return {parameter<ImplicitTable>(static_cast<bool ImplicitTable::*>(&ImplicitTable::compensated),
                                     "compensated", "compensated summation")};
  }
};

RungeKuttaTableau<Quad> read_tableau(TableDocument& document, const TableHead& head,
                                     std::vector<Quad>& nodes) {
  RungeKuttaTableau<Quad> tableau{{}, document.numbers("b")};
  const std::size_t s = tableau.stages();
  constexpr std::size_t most_stages = 64;
  if (s > most_stages) document.refuse("b", "expected at most 64 stages, got " + std::to_string(s));
  const auto rows = document.rows("a");
  if (rows.size() != s)
    document.refuse("a", "expected " + std::to_string(s) + " rows, as b has that many numbers, got " +
                             std::to_string(rows.size()));
  tableau.a.assign(s * s, Quad(0));
  for (std::size_t i = 0; i < s; ++i) {
    if (rows[i].size() > s)
      document.refuse("a", "row " + std::to_string(i + 1) + " has " + std::to_string(rows[i].size()) +
                               " numbers; expected at most " + std::to_string(s));
    std::copy(rows[i].begin(), rows[i].end(), tableau.a.begin() + static_cast<std::ptrdiff_t>(i * s));
    Quad sum(0);
    for (const Quad& x : rows[i]) sum += x;
    nodes.push_back(sum);
  }
  if (!document.has("c")) return tableau;
  const std::vector<Quad> c = document.numbers("c");
  if (c.size() != s) document.refuse("c", "expected " + std::to_string(s) + " numbers");
  for (std::size_t i = 0; i < s; ++i) {
    const OrderCondition row_sum{"", 1, nodes[i] - c[i], std::max(Quad(1), abs(c[i]))};
    if (!(relative_residual(row_sum) <= head.precision))
      document.refuse("c", "the sum of row " + std::to_string(i + 1) + " of a less c" +
                               std::to_string(i + 1) + " " + residual_in_words(row_sum, head.precision));
  }
  return tableau;
}

bool is_explicit(const RungeKuttaTableau<Quad>& tableau) {
  const std::size_t s = tableau.stages();
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = i; j < s; ++j)
      if (!(tableau.a[i * s + j] == Quad(0))) return false;
  return true;
}

// What the numbers keep, and for a claim what speaks against it.
std::vector<Claim> claims_of(TableDocument& document, const RungeKuttaTableau<Quad>& tableau,
                             const Quad& precision) {
  const auto symplecticity = symplecticity_conditions(tableau), symmetry = symmetry_conditions(tableau);
  const OrderCondition* not_symplectic = first_violated(symplecticity, 0, precision);
  const OrderCondition* not_symmetric = first_violated(symmetry, 0, precision);
  std::vector<Claim> kept;
  if (not_symmetric == nullptr) kept = {Claim::symmetric, Claim::reversible};
  if (not_symplectic == nullptr) {
    kept.push_back(Claim::symplectic);
    kept.push_back(Claim::quadratic_invariants);
  }
  return kept_claims(document, kept, [&](Claim claim) {
    const OrderCondition* against = claim == Claim::symmetric || claim == Claim::reversible ? not_symmetric
                                    : claim == Claim::symplectic || claim == Claim::quadratic_invariants
                                        ? not_symplectic
                                        : nullptr;
    return against == nullptr ? std::string("Runge-Kutta methods are not tested for it")
                              : against->name + " " + residual_in_words(*against, precision);
  });
}

std::unique_ptr<const MethodTable> read_runge_kutta_table(TableDocument& document, TableHead head) {
  std::vector<Quad> nodes;
  RungeKuttaTableau<Quad> tableau = read_tableau(document, head, nodes);
  const int order = head.descriptor.order;
  if (order > largest_tree)
    document.refuse("order", "expected at most " + std::to_string(largest_tree) +
                                 ", the order up to which trees are listed");
  head.descriptor.preserves = claims_of(document, tableau, head.precision);
  document.finish();
  require_order(document, head, tree_conditions(tableau, std::min(order + 1, largest_tree)));
  OrderTheory theory = tree_theory(tableau, order, is_explicit(tableau));
  theory.precision = head.precision;
  if (is_explicit(tableau)) {
    ExplicitTable method;
    method.tableau = std::move(tableau);
    head.descriptor.family = "explicit";
    return std::make_unique<TableOf<ExplicitTable>>(head.descriptor, document, std::move(theory),
                                                    std::move(method));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (abs(nodes[i] - nodes[j]) < Quad(1e-10))
        document.refuse("a",
                        "the rows " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
                            " have the same sum; an implicit method is expected to have different nodes");
  ImplicitTable method;
  method.tableau = {static_cast<int>(nodes.size()), nodes, tableau.b, tableau.a};
  return std::make_unique<TableOf<ImplicitTable>>(head.descriptor, document, std::move(theory),
                                                  std::move(method));
}

const TableKind<ExplicitTable, ImplicitTable> runge_kutta_kind{{"runge-kutta"}, read_runge_kutta_table};
}  // namespace
