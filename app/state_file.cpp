#include <pfaff/app/state_file.hpp>

#include <nlohmann/json.hpp>

#include <pfaff/bench/runner/files.hpp>

namespace pfaff::app {

namespace {
// Numbers keep the digits they are written with, which a double would not.
struct ExactNumbers : nlohmann::detail::json_sax_dom_parser<nlohmann::json> {
  explicit ExactNumbers(nlohmann::json& result) : json_sax_dom_parser(result, false) {}
  bool number_float(double /*rounded*/, const std::string& written) {
    std::string text = written;
    return string(text);
  }
};

std::string number_text(const nlohmann::json& value, const std::string& where) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  throw InputError(where + ": expected numbers or decimal strings");
}

}  // namespace

void read_state(const std::string& path, RunSettings& settings) {
  nlohmann::json j;
  ExactNumbers reader(j);
  if (!nlohmann::json::sax_parse(read_file(path), &reader) || !j.is_object())
    throw InputError(path + ": expected a JSON object with t and z (or q and p)");
  for (const auto& [key, value] : j.items())
    if (key != "t" && key != "z" && key != "q" && key != "p" && key != "schema")
      throw InputError(path + ": " + unknown_name("key", key, {"t", "z", "q", "p"}));
  if (j.contains("t")) settings.t0 = number_text(j["t"], path);
  std::vector<nlohmann::json> parts;
  if (j.contains("z")) parts = {j["z"]};
  if (j.contains("q") != j.contains("p") || j.contains("q") == j.contains("z"))
    throw InputError(path + ": expected z, or q and p");
  if (j.contains("q")) parts = {j["q"], j["p"]};
  for (const nlohmann::json& part : parts) {
    if (!part.is_array()) throw InputError(path + ": expected a list of numbers");
    for (const nlohmann::json& x : part) settings.initial.push_back(number_text(x, path));
  }
  if (settings.initial.empty()) throw InputError(path + ": expected numbers, got an empty list");
}

}  // namespace pfaff::app
