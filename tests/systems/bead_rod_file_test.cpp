// Model files in TOML and JSON: what is read from them, and that anything wrong is refused in one line that
// says what, where and what was expected.
#include "bead_rod_files.hpp"

namespace {
using namespace pfaff;
using nlohmann::json;
using pfaff::testing::bead_rod;
using pfaff::testing::write_file;

json triangle() {  // two pendulums of different lengths, coupled by a rod
  return json::parse(R"({
    "dimension": 2, "masses": [1, "2.5"], "gravity": 9.81, "friction": [0.1, 0],
    "anchors": {"left": [0, 0], "right": [3, 0]},
    "rods": [["left", 0], [0, 1], [1, "right"]],
    "positions": [[0, -1], [3, -2]], "velocities": [[0.5, 0], [0.25, 0]],
    "charges": [1, -1],
    "potentials": [{"kind": "coulomb", "strength": 1, "cutoff": 2.5, "exclude": 1}]})");
}

std::string refusal(const json& model) {
  try {
    bead_rod("refused", model);
  } catch (const InputError& e) {
    return e.what();
  }
  return "not refused";
}

TEST(BeadRodFile, SaysWhatIsWrongAndWhere) {
  ASSERT_EQ(refusal(triangle()), "not refused");
  struct Case {
    const char *pointer, *value;  // replaces what is there
    const char* message;
  };
  for (const Case& c : {
           Case{"/dimension", "4", "dimension: expected 2 or 3, got '4'"},
           Case{"/masses/1", "0", "masses[1]: expected a number > 0, got 0"},
           Case{"/masses/0", "-1", "masses[0]: expected a number > 0, got -1"},
           Case{"/masses/0", "\"heavy\"", "masses[0]: expected a number, got 'heavy'"},
           Case{"/friction/0", "-0.5", "friction[0]: expected a number >= 0, got -0.5"},
           Case{"/friction", "[1]", "friction: expected 2 numbers, got 1"},
           Case{"/gravity", "[0, 0, 1]", "gravity: expected 2 numbers, got 3"},
           Case{"/rods/1", "[0, 5]",
                "rods[1][1]: there is no bead 5; expected 0 to 1 or the name of an anchor"},
           Case{"/rods/1", "[0, -1]", "rods[1][1]: expected the number of a bead, from 0, got '-1'"},
           Case{"/rods/1", "[0, 1, 1]", "rods[1]: expected two points, got 3"},
           Case{"/rods/1", "[0, 0]", "rods[1]: expected two different points, got bead 0 twice"},
           Case{"/rods/1", "[\"left\", \"right\"]", "rods[1]: joins two anchors; expected at least one bead"},
           Case{"/rods/1", "[0, \"left\"]",
                "rods[1]: joins the same points as rods[0], bead 0 and anchor 'left'"},
           Case{"/rods/2", "[1, \"rigth\"]", "rods[2][1]: unknown anchor 'rigth'; did you mean 'right'?"},
           Case{"/rods/2", "[1, \"left\"]",
                "anchors.right: no rod ends there; expected every anchor at a rod"},
           Case{"/lengths", "[1, 0, 1]", "lengths[1]: expected a number > 0, got 0"},
           Case{"/lengths", "[1, -2, 1]", "lengths[1]: expected a number > 0, got -2"},
           Case{"/lengths", "[1, 2]", "lengths: expected 3 numbers, got 2"},
           Case{"/positions/1", "[0, -1]",
                "rods[1]: bead 0 and bead 1 are at the same place; expected a distance > 0"},
           Case{"/positions/1", "[0]", "positions[1]: expected 2 numbers, got 1"},
           Case{"/positions", "[[0, 0]]", "positions: expected 2 lists, one per bead, got 1"},
           Case{"/momenta", "[[0, 0], [0, 0]]", "momenta: expected either velocities or momenta, not both"},
           Case{"/potentials/0/kind", "\"colomb\"",
                "potentials[0].kind: unknown potential 'colomb'; did you mean 'coulomb'?"},
           Case{"/potentials/0/cutoff", "0", "cutoff: expected a number > 0, got 0"},
           Case{"/potentials/0/exclude", "-1", "exclude: expected 0 .. 16 rods, got -1"},
           Case{"/potentials/0/range", "1", "potentials[0]: unknown key 'range'"},
           Case{"/mass", "[1, 1]", "unknown key 'mass'; did you mean 'masses'?"},
       }) {
    json model = triangle();
    model[json::json_pointer(c.pointer)] = json::parse(c.value);
    const std::string message = refusal(model);
    EXPECT_NE(message.find(c.message), std::string::npos) << c.pointer << " = " << c.value << ": " << message;
    EXPECT_NE(message.find("refused.json: "), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(BeadRodFile, NamesMissingKeys) {
  for (const char* key : {"dimension", "masses", "positions"}) {
    json model = triangle();
    model.erase(key);
    EXPECT_NE(refusal(model).find("key '" + std::string(key) + "' is missing"), std::string::npos)
        << refusal(model);
  }
  json model = triangle();
  model.erase("charges");
  EXPECT_NE(refusal(model).find("acts on charges; expected the key charges"), std::string::npos)
      << refusal(model);
}

TEST(BeadRodFile, NamesRedundantRods) {
  // A braced square: five rods for 8 - 3 inner degrees of freedom; a second diagonal is one too many.
  json square{{"dimension", 2},
              {"masses", {1, 1, 2, 1, 3}},
              {"positions", {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 2}}},
              {"rods", {{2, 4}, {0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}}};
  EXPECT_EQ(refusal(square), "not refused");
  square["rods"].push_back({1, 3});
  EXPECT_NE(
      refusal(square).find("the constraints of rods 1, 2, 3, 4, 5, 6 depend on each other (S is singular)"),
      std::string::npos)
      << refusal(square);
  // A stretched linkage: independent in general, but not there.
  json linkage = triangle();
  linkage["positions"] = {{1, 0}, {2, 0}};
  EXPECT_NE(refusal(linkage).find("the constraints of rods 0, 1, 2 depend on each other"), std::string::npos);
}

TEST(BeadRodFile, NamesPairsAtTheSamePlace) {
  json model{{"dimension", 3},
             {"masses", {1, 1, 1}},
             {"positions", {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}},
             {"rods", {{0, 1}, {1, 2}}},
             {"potentials", {{{"kind", "lennard-jones"}, {"epsilon", 1}, {"sigma", 1}, {"exclude", 1}}}}};
  EXPECT_NE(refusal(model).find("positions: bead 0 and bead 2 are at the same place"), std::string::npos);
  model["potentials"][0]["exclude"] = 2;
  EXPECT_EQ(refusal(model), "not refused");
}

TEST(BeadRodFile, SaysTheLineWhereItIsNoFileOfItsKind) {
  const auto message = [](const std::string& name, const std::string& text) -> std::string {
    try {
      systems().get("bead-rod", "system").make({{"model", write_file(name, text)}});
    } catch (const InputError& e) {
      return e.what();
    }
    return "not refused";
  };
  EXPECT_NE(message("broken.json", "{\n\"dimension\": 2,\n]").find("broken.json:3:1: expected JSON, got '"),
            std::string::npos);
  EXPECT_NE(message("broken.toml", "dimension = 2\nmasses = [1,\n").find("broken.toml:"), std::string::npos);
  EXPECT_NE(message("double.json", "{\"masses\": [1], \"masses\": [2]}").find("key 'masses' is there twice"),
            std::string::npos);
  try {
    systems().get("bead-rod", "system").make({{"model", "no-such-file.toml"}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "cannot read no-such-file.toml: No such file or directory");
  }
}

// Decimals of either format keep their digits: 0.1 is a tenth in quad precision.
TEST(BeadRodFile, KeepsDigitsAndDefaults) {
  const std::string toml = write_file("exact.toml", R"(
dimension = 2
masses    = [0.1, "1/3"]
gravity   = 9.81
anchors   = { origin = [0.0, 0.25] }
rods      = [["origin", 0], [0, 1]]
positions = [[0.3, 0.65], [0.3, 0.85]]
velocities = [[0.4, -0.3], [0.7, -0.3]]
)");
  const auto from_toml = systems().get("bead-rod", "system").make({{"model", toml}});
  const auto from_json =
      bead_rod("exact", json::parse(R"({"dimension": 2, "masses": [0.1, "1/3"], "gravity": 9.81,
    "anchors": {"origin": [0.0, 0.25]}, "rods": [["origin", 0], [0, 1]], "positions": [[0.3, 0.65], [0.3, 0.85]],
    "momenta": [[0.04, -0.03], ["0.7/3", -0.1]]})"));
  for (const auto& model : {from_toml, from_json}) {
    ASSERT_EQ(model->initial().size(), 8U);
    EXPECT_EQ(model->initial()[0], 0.3_r);
    EXPECT_EQ(model->initial()[4], 0.04_r);
    EXPECT_EQ(model->initial()[6], Real::fraction(7, 30));
    EXPECT_EQ(model->coordinates()[1].name, "y0");
    EXPECT_EQ(model->coordinates()[6].name, "px1");
    // Lengths are those of the positions, 0.5 and 0.2: the constraints hold to the last digit in quad.
    const auto constraints = model->holonomic_constraints<Quad>();
    std::vector<Quad> q, phi(2);
    for (std::size_t k = 0; k < 4; ++k) q.push_back(model->initial()[k].quad());
    constraints->values(Quad(0), q, phi);
    for (const Quad x : phi) EXPECT_LE(abs(x), Quad(1e-34));
  }
}

}  // namespace
