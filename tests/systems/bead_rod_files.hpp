// Model files for tests, in a directory of each process.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <pfaff/bench/runner/json.hpp>
#include <string>

#include <pfaff/core/system.hpp>

#include "../golden_numbers.hpp"
#include "../temporary_directory.hpp"

namespace pfaff::testing {

inline std::string write_file(const std::string& name, const std::string& text) {
  static const TemporaryDirectory directory;  // of the process
  std::string path = directory / name;
  std::ofstream(path) << text;
  return path;
}

inline std::shared_ptr<const Model> bead_rod(const std::string& name, const nlohmann::json& model) {
  return systems().get("bead-rod", "system").make({{"model", write_file(name + ".json", model.dump())}});
}

/// The model file of a golden system in one of its states; numbers stay decimal strings.
inline nlohmann::json golden_model(const nlohmann::json& source, const nlohmann::json& state) {
  const std::size_t axes = source["dim"];
  nlohmann::json model{{"dimension", axes},
                       {"masses", source["masses"]},
                       {"friction", source["Lambda"]},
                       {"gravity", source["g"]},
                       {"lengths", source["lengths"]}};
  for (const auto& rod : source["rods"]) {
    if (!rod[0].is_null()) model["rods"].push_back(rod);
    if (rod[1].is_null()) {
      model["rods"].back()[1] = "origin";
      model["anchors"]["origin"] = std::vector<int>(axes, 0);
    }
  }
  for (std::size_t k = 0; k < state["q"].size(); ++k) {
    if (k % axes == 0) {
      model["positions"].push_back(nlohmann::json::array());
      model["momenta"].push_back(nlohmann::json::array());
    }
    model["positions"].back().push_back(state["q"][k]);
    model["momenta"].back().push_back(state["p"][k]);
  }
  if (source.contains("pair")) {
    model["charges"] = source["pair"]["charges"];
    const Real epsilon =
        *Real::parse(source["pair"]["eps"].get<std::string>()) / 4;  // the file's form has a 4
    model["potentials"] = {{{"kind", "lennard-jones"},
                            {"epsilon", to_string(epsilon)},
                            {"sigma", source["pair"]["sigma"]},
                            {"exclude", 1}},
                           {{"kind", "coulomb"}, {"strength", source["pair"]["a"]}, {"exclude", 1}}};
  }
  return model;
}

}  // namespace pfaff::testing
