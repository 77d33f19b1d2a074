// Any beads and rods, from a model file (systems/bead_rod/model_file.hpp). Without a file: a double pendulum
// with masses and rods of 1 and 1/2, at rest, bent.
#include <pfaff/systems/bead_rod/model_file.hpp>
#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

struct BeadRod : BeadRods<BeadRod> {
  std::string model;
  static std::vector<Parameter> parameters() {
    return {
        file_parameter(&BeadRod::model, "model", "TOML or JSON description; without one, a double pendulum")};
  }
  [[nodiscard]] BeadRodDescription describe() const {
    if (!model.empty()) return read_bead_rod_model(model);
    BeadRodDescription d;
    d.origin = "system bead-rod";
    d.masses = {1, 0.5_r};
    d.gravity = {0, -9.81_r};
    d.anchors = {{"origin", {0, 0}}};
    d.rods = {{0, 2, 1}, {1, 0, 0.5_r}};
    d.positions = {0.6_r, -0.8_r, 1.1_r, -0.8_r};
    d.momenta.assign(4, 0);
    return d;
  }
};

const System<BeadRod> registered{
    {.name = "bead-rod",
     .title = "point masses and rigid rods, from a model file",
     .reference = "nguyen-turski section 4",
     .description = "Point masses and rigid rods from a model file, joined in any way, with anchors, "
                    "friction and the usual forces. Take it for molecules, linkages and chains of your own; "
                    "S is solved in the structure that the graph of rods has, in linear time for chains, "
                    "trees and rings. Redundant rods make S singular and are refused."}};
}  // namespace
