// The generating-function schemes as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/generating/generating_function.hpp>

namespace {
using namespace pfaff;

struct GeneratingFunction : pfaff::GeneratingFunction {
  /// Every order up to the highest in the variant and with the degrees that it takes by default, and without
  /// degrees beyond m; besides, even orders in variant P, the other forms, and other degrees beyond m.
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list;
    const int highest = full ? 14 : 12;  // beyond, quad has too few digits to see a slope on every system
    for (int m = 1; m <= highest; ++m) {
      const std::string order = std::to_string(m);
      list.push_back({{"order", order}});
      if (cheapest_extra_degrees(m) > 0) list.push_back({{"order", order}, {"extra", "0"}});
    }
    for (int m = 2; m <= highest; m += 2) list.push_back({{"order", std::to_string(m)}, {"variant", "P"}});
    for (int m = 1; m <= (full ? 12 : 6); ++m)
      for (const char* mixed : {"qhat-p", "q-phat"})
        list.push_back({{"order", std::to_string(m)}, {"form", mixed}});
    for (int m = 1; m <= (full ? 12 : 4); ++m)
      list.push_back({{"order", std::to_string(m)}, {"form", "normal"}, {"normal", "0.2,0.1,-0.3,-0.2"}});
    for (int m = 1; m <= 8; ++m)
      list.push_back({{"order", std::to_string(m)}, {"extra", m % 4 < 2 ? "2" : "4"}});
    return list;
  }
};

const Method<GeneratingFunction> registered{
    {.name = "generating-function",
     .title = "K(z,t)-symplectic generating-function scheme of order m",
     .family = "generating",
     .reference = "su-qin (87)-(88)",
     .description =
         "Schemes of any order m from the truncated generating function of a Darboux chart, su-qin "
         "(87)-(88). Take them for damped and other Birkhoffian systems with a chart: the time-dependent "
         "structure is kept exactly at every step size, and high orders come at moderate extra cost. They "
         "need the chart and series of the field in it, and an implicit solve at each step."}};
}  // namespace
