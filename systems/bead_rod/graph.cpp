#include <pfaff/systems/bead_rod/graph.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/core/linear/structured_ldlt.hpp>

namespace pfaff {

namespace {
// The rods at each bead, those of bead i from start[i] on; bit 0 tells a rod's second end from its first.
struct Incidence {
  std::vector<std::uint32_t> start, ends;
};

Incidence incidence_of(const BeadRodDescription& description) {
  const std::size_t beads = description.beads();
  Incidence result{std::vector<std::uint32_t>(beads + 2), {}};
  const auto each = [&](auto&& use) {
    for (std::size_t k = 0; k < description.rods.size(); ++k) {
      const Rod& rod = description.rods[k];
      if (rod.first < beads) use(rod.first, static_cast<std::uint32_t>(2 * k));
      if (rod.second < beads) use(rod.second, static_cast<std::uint32_t>(2 * k + 1));
    }
  };
  each([&](std::size_t bead, std::uint32_t /*end*/) { ++result.start[bead + 2]; });
  for (std::size_t i = 2; i < result.start.size(); ++i) result.start[i] += result.start[i - 1];
  result.ends.resize(result.start.back());
  each([&](std::size_t bead, std::uint32_t end) { result.ends[result.start[bead + 1]++] = end; });
  return result;
}

// All rods as paths and rings; none where a bead has three rods.
struct PathsAndRings {
  std::vector<RodPath> paths, rings;
};
PathsAndRings paths_and_rings(const BeadRodDescription& d, const Incidence& rods) {
  const auto degree = [&](std::size_t bead) { return rods.start[bead + 1] - rods.start[bead]; };
  PathsAndRings found;
  for (std::size_t bead = 0; bead < d.beads(); ++bead)
    if (degree(bead) > 2) return found;
  std::vector<bool> walked(d.rods.size(), false);
  // From `point` along `rod` until there is no other rod, or none that is new.
  const auto walk = [&](std::size_t point, std::size_t rod) {
    RodPath path{{point}};
    for (bool more = true; more;) {
      walked[rod] = true;
      point = d.rods[rod].first == point ? d.rods[rod].second : d.rods[rod].first;
      path.points.push_back(point);
      more = false;
      if (point >= d.beads()) break;
      for (std::uint32_t k = rods.start[point]; k < rods.start[point + 1] && !more; ++k) {
        more = !walked[rods.ends[k] / 2];
        if (more) rod = rods.ends[k] / 2;
      }
    }
    return path;
  };
  for (std::size_t rod = 0; rod < d.rods.size(); ++rod)
    for (const std::size_t point : {d.rods[rod].first, d.rods[rod].second})
      if (!walked[rod] && (point >= d.beads() || degree(point) == 1)) found.paths.push_back(walk(point, rod));
  for (std::size_t rod = 0; rod < d.rods.size(); ++rod)
    if (!walked[rod]) {
      found.rings.push_back(walk(d.rods[rod].first, rod));
      found.rings.back().points.pop_back();  // where it began
    }
  return found;
}

// The dense S with a diagonal of ones.
std::vector<double> scaled_matrix(const StructuredLDLT<double>& s) {
  const std::size_t rows = s.pattern().rows();
  std::vector<double> matrix(rows * rows, 0.0);
  for (std::size_t i = 0; i < rows; ++i) matrix[i * rows + i] = 1;
  const auto& couplings = s.pattern().couplings();
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const auto [i, j] = couplings[c];
    const double scaled = s.couplings()[c] / std::sqrt(s.diagonal()[i] * s.diagonal()[j]);
    matrix[i * rows + j] = matrix[j * rows + i] = scaled;
  }
  return matrix;
}

// Rows of a semidefinite matrix that depend on earlier ones, each with those it depends on.
std::vector<std::vector<std::size_t>> dependent_rows(std::vector<double> a, std::size_t rows) {
  constexpr double negligible = 1e-12;  // of entries of size 1, in double
  std::vector<std::vector<std::size_t>> sets;
  // Gauss-Jordan: column k of what is left of a dependent row holds its combination of the pivot rows.
  std::vector<bool> is_pivot(rows, false);
  for (std::size_t k = 0; k < rows; ++k) {
    const double pivot = a[k * rows + k];
    if (pivot <= negligible) {
      std::vector<std::size_t> set;
      for (std::size_t i = 0; i < k; ++i)
        if (is_pivot[i] && std::abs(a[i * rows + k]) > negligible) set.push_back(i);
      set.push_back(k);
      sets.push_back(std::move(set));
      continue;
    }
    is_pivot[k] = true;
    for (std::size_t j = k; j < rows; ++j) a[k * rows + j] /= pivot;
    for (std::size_t i = 0; i < rows; ++i) {
      const double factor = a[i * rows + k];
      if (i == k || factor == 0) continue;
      for (std::size_t j = k; j < rows; ++j) a[i * rows + j] -= factor * a[k * rows + j];
    }
  }
  return sets;
}
}  // namespace

RodGraph::RodGraph(const BeadRodDescription& description) : beads_(description.beads()), start_(beads_ + 1) {
  const Incidence rods = incidence_of(description);
  for (std::size_t bead = 0; bead < beads_; ++bead)
    for (std::uint32_t a = rods.start[bead]; a < rods.start[bead + 1]; ++a)
      for (std::uint32_t b = a + 1; b < rods.start[bead + 1]; ++b) {
        const std::uint32_t x = rods.ends[a], y = rods.ends[b];
        couplings_.push_back(
            {std::min(x, y) / 2, std::max(x, y) / 2, static_cast<std::uint32_t>(bead), x % 2 == y % 2});
      }
  std::sort(couplings_.begin(), couplings_.end(),
            [](const RodCoupling& a, const RodCoupling& b) { return a.k != b.k ? a.k < b.k : a.l < b.l; });
  std::vector<SymmetricPattern::Coupling> pairs;
  pairs.reserve(couplings_.size());
  for (const RodCoupling& c : couplings_) pairs.emplace_back(c.k, c.l);
  pattern_ = std::make_shared<const SymmetricPattern>(description.rods.size(), std::move(pairs));

  PathsAndRings found = paths_and_rings(description, rods);
  paths_ = std::move(found.paths);
  rings_ = std::move(found.rings);

  for (std::size_t bead = 0; bead < beads_; ++bead) {
    for (std::uint32_t a = rods.start[bead]; a < rods.start[bead + 1]; ++a) {
      const Rod& rod = description.rods[rods.ends[a] / 2];
      const std::size_t other = rods.ends[a] % 2 == 0 ? rod.second : rod.first;
      if (other < beads_) neighbour_.push_back(static_cast<std::uint32_t>(other));
    }
    start_[bead + 1] = static_cast<std::uint32_t>(neighbour_.size());
  }
}

std::vector<std::uint32_t> RodGraph::within(std::uint32_t bead, int distance) const {
  std::vector<std::uint32_t> reached{bead};
  std::size_t begin = 0;
  for (int step = 0; step < distance; ++step) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin)
      for (std::uint32_t a = start_[reached[begin]]; a < start_[reached[begin] + 1]; ++a)
        if (std::find(reached.begin(), reached.end(), neighbour_[a]) == reached.end())
          reached.push_back(neighbour_[a]);
  }
  reached.erase(std::remove_if(reached.begin(), reached.end(), [&](std::uint32_t i) { return i <= bead; }),
                reached.end());
  std::sort(reached.begin(), reached.end());
  return reached;
}

std::vector<std::vector<std::size_t>> redundant_rods(const BeadRodDescription& description,
                                                     const RodGraph& graph) {
  const std::size_t axes = description.axes(), count = description.rods.size();
  const auto along = [&](std::size_t k, std::size_t axis) {
    const Rod& rod = description.rods[k];
    return description.coordinate(rod.first, axis).value() - description.coordinate(rod.second, axis).value();
  };
  const auto inverse_mass = [&](std::size_t point) {
    return point < description.beads() ? 1 / description.masses[point].value() : 0.0;
  };
  StructuredLDLT<double> s(graph.pattern());
  for (std::size_t k = 0; k < count; ++k) {
    double square = 0;
    for (std::size_t d = 0; d < axes; ++d) square += along(k, d) * along(k, d);
    s.diagonal()[k] =
        square * (inverse_mass(description.rods[k].first) + inverse_mass(description.rods[k].second));
  }
  for (std::size_t c = 0; c < graph.couplings().size(); ++c) {
    const RodCoupling& coupling = graph.couplings()[c];
    double product = 0;
    for (std::size_t d = 0; d < axes; ++d) product += along(coupling.k, d) * along(coupling.l, d);
    s.couplings()[c] = (coupling.same_side ? 1 : -1) * inverse_mass(coupling.bead) * product;
  }
  if (s.factor_semidefinite() == Status::converged && s.dropped() == 0) return {};
  constexpr std::size_t largest = 2000;  // whose dense matrix is still looked at
  if (count > largest) return {{}};
  return dependent_rows(scaled_matrix(s), count);
}

}  // namespace pfaff
