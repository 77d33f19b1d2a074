#include <pfaff/systems/bead_rod/description.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/systems/bead_rod/graph.hpp>

namespace pfaff {

namespace {
[[noreturn]] void refuse_rods(const BeadRodDescription& d, const std::string& what) {
  throw InputError(d.origin + ": " + what);
}

std::string place(const char* list, std::size_t k) {
  return std::string(list) + "[" + std::to_string(k) + "]";
}

void require_count(const BeadRodDescription& d, const char* key, std::size_t count, std::size_t expected,
                   const char* of) {
  if (count != expected)
    refuse_rods(d, std::string(key) + ": expected " + std::to_string(expected) + " numbers, one " + of +
                       ", got " + std::to_string(count));
}

void require_positive(const BeadRodDescription& d, const std::string& where, const Real& x) {
  if (!(x > Real(0))) refuse_rods(d, where + ": expected a number > 0, got " + to_string(x));
}

void require_bead(const BeadRodDescription& d, const std::string& where, std::size_t bead) {
  if (bead >= d.beads())
    refuse_rods(d, where + ": expected a bead from 0 to " + std::to_string(d.beads() - 1) + ", got " +
                       std::to_string(bead));
}

bool same_place(const BeadRodDescription& d, std::size_t a, std::size_t b) {
  for (std::size_t x = 0; x < d.axes(); ++x)
    if (!(d.coordinate(a, x) == d.coordinate(b, x))) return false;
  return true;
}

void check_beads(const BeadRodDescription& d) {
  if (d.dimension != 2 && d.dimension != 3)
    refuse_rods(d, "dimension: expected 2 or 3, got " + std::to_string(d.dimension));
  if (d.masses.empty()) refuse_rods(d, "masses: expected at least one bead");
  for (std::size_t i = 0; i < d.beads(); ++i) require_positive(d, place("masses", i), d.masses[i]);
  if (!d.friction.empty()) require_count(d, "friction", d.friction.size(), d.beads(), "per bead");
  for (std::size_t i = 0; i < d.friction.size(); ++i)
    if (d.friction[i] < Real(0))
      refuse_rods(d, place("friction", i) + ": expected a number >= 0, got " + to_string(d.friction[i]));
  if (!d.charges.empty()) require_count(d, "charges", d.charges.size(), d.beads(), "per bead");
  if (!d.gravity.empty()) require_count(d, "gravity", d.gravity.size(), d.axes(), "per dimension");
  require_count(d, "positions", d.positions.size(), d.beads() * d.axes(), "per bead and dimension");
  require_count(d, "momenta", d.momenta.size(), d.beads() * d.axes(), "per bead and dimension");
}

void check_anchors(const BeadRodDescription& d) {
  std::vector<bool> used(d.points(), false);
  for (const Rod& rod : d.rods) used[rod.first] = used[rod.second] = true;
  for (std::size_t a = 0; a < d.anchors.size(); ++a) {
    require_count(d, ("anchors." + d.anchors[a].name).c_str(), d.anchors[a].position.size(), d.axes(),
                  "per dimension");
    if (!used[d.beads() + a])
      refuse_rods(d, "anchors." + d.anchors[a].name + ": no rod ends there; expected every anchor at a rod");
  }
}

void check_rods(const BeadRodDescription& d) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  for (std::size_t k = 0; k < d.rods.size(); ++k) {
    const Rod& rod = d.rods[k];
    const std::string where = place("rods", k);
    for (const std::size_t end : {rod.first, rod.second})
      if (end >= d.points())
        refuse_rods(d, where + ": there is no bead " + std::to_string(end) + "; expected 0 to " +
                           std::to_string(d.beads() - 1) + " or the name of an anchor");
    if (rod.first == rod.second)
      refuse_rods(d, where + ": expected two different points, got " + d.name_of(rod.first) + " twice");
    if (rod.first >= d.beads()) refuse_rods(d, where + ": joins two anchors; expected at least one bead");
    const auto [old, added] = known.emplace(std::minmax(rod.first, rod.second), k);
    if (!added)
      refuse_rods(d, where + ": joins the same points as rods[" + std::to_string(old->second) + "], " +
                         d.name_of(rod.first) + " and " + d.name_of(rod.second));
    if (same_place(d, rod.first, rod.second))
      refuse_rods(d, where + ": " + d.name_of(rod.first) + " and " + d.name_of(rod.second) +
                         " are at the same place; expected a distance > 0");
    require_positive(d, place("lengths", k), rod.length);
  }
}

void check_cutoff(const BeadRodDescription& d, const std::string& where, const PairPotential& p) {
  if (p.cutoff) require_positive(d, where + ".cutoff", *p.cutoff);
  if (p.exclude < 0 || p.exclude > 16)
    refuse_rods(d, where + ".exclude: expected 0 .. 16 rods, got " + std::to_string(p.exclude));
  if (p.kind == PairPotential::Kind::lennard_jones) {
    require_positive(d, where + ".sigma", p.sigma);
    if (p.epsilon < Real(0))
      refuse_rods(d, where + ".epsilon: expected a number >= 0, got " + to_string(p.epsilon));
  } else if (d.charges.empty()) {
    refuse_rods(d, where + ": acts on charges; expected the key charges");
  }
}

void check_potentials(const BeadRodDescription& d) {
  for (std::size_t k = 0; k < d.pairs.size(); ++k) check_cutoff(d, place("pair potentials", k), d.pairs[k]);
  for (const SpringPotential& s : d.springs)
    for (std::size_t k = 0; k < s.beads.size(); ++k) {
      const std::string where = "spring, " + place("beads", k);
      for (const std::size_t bead : s.beads[k]) require_bead(d, where, bead);
      if (s.beads[k][0] == s.beads[k][1]) refuse_rods(d, where + ": expected two different beads");
      if (same_place(d, s.beads[k][0], s.beads[k][1]))
        refuse_rods(d, where + ": beads at the same place; expected a distance > 0");
    }
  for (const AnglePotential& a : d.angles)
    for (std::size_t k = 0; k < a.beads.size(); ++k) {
      const std::string where = "harmonic-angle, " + place("beads", k);
      for (const std::size_t bead : a.beads[k]) require_bead(d, where, bead);
      if (a.beads[k][0] == a.beads[k][1] || a.beads[k][1] == a.beads[k][2] || a.beads[k][0] == a.beads[k][2])
        refuse_rods(d, where + ": expected three different beads");
      if (same_place(d, a.beads[k][0], a.beads[k][1]) || same_place(d, a.beads[k][1], a.beads[k][2]))
        refuse_rods(d, where + ": beads at the same place; expected a distance > 0");
    }
  for (const FieldPotential& e : d.fields) {
    require_count(d, "field, strength", e.strength.size(), d.axes(), "per dimension");
    if (d.charges.empty()) refuse_rods(d, "field: acts on charges; expected the key charges");
  }
  for (const TrapPotential& t : d.traps)
    require_count(d, "trap, center", t.center.size(), d.axes(), "per dimension");
}

// Beads that a pair potential pushes apart with infinite force where they start.
void check_pairs(const BeadRodDescription& d, const RodGraph& graph) {
  if (d.pairs.empty()) return;
  std::vector<std::size_t> order(d.beads());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto less = [&](std::size_t a, std::size_t b) {
    for (std::size_t x = 0; x < d.axes(); ++x) {
      if (d.coordinate(a, x) < d.coordinate(b, x)) return true;
      if (d.coordinate(b, x) < d.coordinate(a, x)) return false;
    }
    return a < b;
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    const std::size_t a = order[k], b = order[k + 1];
    if (!same_place(d, a, b)) continue;
    for (const PairPotential& p : d.pairs) {
      const auto near = graph.within(static_cast<std::uint32_t>(std::min(a, b)), p.exclude);
      if (std::find(near.begin(), near.end(), std::max(a, b)) == near.end())
        refuse_rods(d, "positions: " + d.name_of(std::min(a, b)) + " and " + d.name_of(std::max(a, b)) +
                           " are at the same place, where a pair potential is infinite");
    }
  }
}

void check_redundance(const BeadRodDescription& d, const RodGraph& graph) {
  const auto sets = redundant_rods(d, graph);
  if (sets.empty()) return;
  std::string which;
  for (const std::size_t k : sets.front()) which += (which.empty() ? "" : ", ") + std::to_string(k);
  refuse_rods(
      d, "rods: redundant, the constraints of rods " + (which.empty() ? "in a closed part" : which) +
             " depend on each other (S is singular)" +
             (sets.size() > 1 ? ", as do those of " + std::to_string(sets.size() - 1) + " more sets" : "") +
             "; expected independent rods");
}
}  // namespace

Real BeadRodDescription::distance(std::size_t a, std::size_t b) const {
  Real square = 0;
  for (std::size_t x = 0; x < axes(); ++x) {
    const Real along = coordinate(a, x) - coordinate(b, x);
    square = square + along * along;
  }
  return sqrt(square);
}

std::string BeadRodDescription::name_of(std::size_t point) const {
  return point < beads() ? "bead " + std::to_string(point) : "anchor '" + anchors[point - beads()].name + "'";
}

void BeadRodDescription::check() const {
  check_beads(*this);
  check_rods(*this);
  check_anchors(*this);
  check_potentials(*this);
  const RodGraph graph(*this);
  check_pairs(*this, graph);
  check_redundance(*this, graph);
}

}  // namespace pfaff
