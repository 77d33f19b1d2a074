#include <pfaff/papers/evidence.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

bool Condition::holds() const {
  if (!std::isfinite(value)) return false;
  return relation == Relation::at_most ? value <= bound : value >= bound;
}

double distance(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return INFINITY;
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto difference = static_cast<double>(abs(a[k] - b[k]));
    if (!std::isfinite(difference)) return INFINITY;
    worst = std::max(worst, difference);
  }
  return worst;
}

std::string judge(const Evidence& e) {
  if (!std::all_of(e.conditions.begin(), e.conditions.end(), [](const Condition& c) { return c.holds(); }))
    return "failed";
  const double apart = distance(e.printed, e.ours);
  const bool numbers = !e.printed.empty(), conditions = !e.conditions.empty();
  switch (e.kind) {
    case Evidence::Kind::value:
      return numbers && apart <= e.tolerance ? "reproduced" : "failed";
    case Evidence::Kind::order: {
      if (!numbers || !std::isfinite(apart)) return "failed";
      if (apart <= e.tolerance) return "reproduced";
      return static_cast<double>(e.ours.front() - e.printed.front()) >= 1 - e.tolerance ? "improved"
                                                                                        : "failed";
    }
    case Evidence::Kind::misprint:
      return numbers && apart > clearly && std::isfinite(apart) &&
                     distance(e.corrected, e.ours) <= e.tolerance
                 ? "erratum"
                 : "failed";
    case Evidence::Kind::claim:
      return conditions ? "erratum" : "failed";
    case Evidence::Kind::property:
      return conditions ? "qualitative" : "failed";
  }
  return "failed";
}

}  // namespace pfaff
