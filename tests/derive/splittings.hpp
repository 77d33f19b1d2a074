// Splittings and their steps, by formulas of a model.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace pfaff::testing {

inline std::shared_ptr<const Model> system(const std::string& name) {
  return systems().get(name, "system").make({});
}

inline std::vector<PartialFlow> strang() {
  return {{0, Quad(1) / Quad(2)}, {1, Quad(1)}, {0, Quad(1) / Quad(2)}};
}
// Yoshida's triple jump over it.
inline std::vector<PartialFlow> triple_jump() {
  const Quad root = pow(Quad(2), Real::fraction(1, 3)), outer = Quad(1) / (Quad(2) - root),
             inner = Quad(1) - Quad(2) * outer;
  return {{0, outer / Quad(2)},
          {1, outer},
          {0, (outer + inner) / Quad(2)},
          {1, inner},
          {0, (outer + inner) / Quad(2)},
          {1, outer},
          {0, outer / Quad(2)}};
}

// One step of a splitting, by formulas of the model.
inline std::vector<Quad> step(const Model& model, const std::vector<PartialFlow>& flows, Quad h,
                              std::vector<Quad> z) {
  Replay<Quad> velocity(model.tape(Formula::velocity)), force(model.tape(Formula::force));
  const std::size_t half = z.size() / 2;
  std::vector<Quad> slope(half);
  for (const PartialFlow& flow : flows) {
    const std::size_t moved = flow.part == 0 ? 0 : half;
    (flow.part == 0 ? velocity : force)(Quad(0), z.data() + (half - moved), slope.data());
    for (std::size_t i = 0; i < half; ++i) z[moved + i] += flow.length * h * slope[i];
  }
  return z;
}

}  // namespace pfaff::testing
