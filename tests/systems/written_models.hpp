// Text models that a test writes, and what is said of those that make no sense.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>

#include <pfaff/core/text/source.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../temporary_directory.hpp"

namespace pfaff::testing {

/// The model of a text in the file model.toml.
inline std::shared_ptr<const Model> model_written(const std::string& text, const Assignments& set = {}) {
  const TemporaryDirectory directory;
  const std::string file = directory / "model.toml";
  std::ofstream(file) << text;
  return system_named(file).make(set);
}

/// The message for a text, one line without its folder; "accepted" where there is none.
inline std::string refusal_written(const std::string& text, const Assignments& set = {}) {
  try {
    (void)model_written(text, set);
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    const auto at = what.find("model.toml");
    return at == std::string::npos ? what : what.substr(at);
  }
  return "accepted";
}

}  // namespace pfaff::testing
