#include <pfaff/app/state_file.hpp>

#include <set>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/json.hpp>
#include <pfaff/core/text/source.hpp>

namespace pfaff::app {

namespace {
constexpr const char* expected_state = "expected a JSON object with t and z (or q and p, or q and v)";

// A JSON parser that keeps numbers as the text they are written as, because a double would lose digits.
struct ExactNumbers : nlohmann::detail::json_sax_dom_parser<nlohmann::json> {
  ExactNumbers(nlohmann::json& result, const std::string& path, const std::string& contents)
      : json_sax_dom_parser(result, false), path_(path), contents_(contents) {}
  // Of a key that is there twice the parser keeps the last; which one was meant, nobody knows.
  bool key(std::string& name) {
    if (depth_ == 1 && !keys_.insert(name).second)
      throw InputError(path_ + ": key '" + name + "' is there twice");
    return json_sax_dom_parser::key(name);
  }
  bool start_object(std::size_t size) {
    open();
    return json_sax_dom_parser::start_object(size);
  }
  bool end_object() {
    --depth_;
    return json_sax_dom_parser::end_object();
  }
  bool start_array(std::size_t size) {
    open();
    return json_sax_dom_parser::start_array(size);
  }
  bool end_array() {
    --depth_;
    return json_sax_dom_parser::end_array();
  }
  bool number_float(double /*rounded*/, const std::string& written) {
    std::string text = written;
    return string(text);
  }
  bool parse_error(std::size_t read, const std::string& last, const nlohmann::detail::exception& /*error*/) {
    text::refuse_json({contents_, path_}, read, last, expected_state);
  }

 private:
  // Values are copied by a function that calls itself for each level, so there is a limit to these.
  void open() {
    constexpr int deepest = 8;
    if (++depth_ > deepest)
      throw InputError(path_ + ": expected lists of numbers, got lists inside one another");
  }

  const std::string &path_, &contents_;
  int depth_ = 0;
  std::set<std::string> keys_;
};

std::string number_text(const nlohmann::json& value, const std::string& where) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  throw InputError(where + ": expected numbers or decimal strings");
}

}  // namespace

void read_state(const std::string& path, RunSettings& settings) {
  nlohmann::json j;
  const std::string contents = read_file(path);
  ExactNumbers reader(j, path, contents);
  if (!nlohmann::json::sax_parse(contents, &reader) || !j.is_object())
    throw InputError(path + ": " + expected_state);
  for (const auto& [key, value] : j.items())
    if (key != "t" && key != "z" && key != "q" && key != "p" && key != "v" && key != "schema")
      throw InputError(path + ": " + unknown_name("key", key, {"t", "z", "q", "p", "v"}));
  if (j.contains("t")) settings.t0 = number_text(j["t"], path);
  const auto numbers = [&](const char* key) {
    std::vector<std::string> list;
    if (!j[key].is_array()) throw InputError(path + ": expected a list of numbers");
    for (const nlohmann::json& x : j[key]) list.push_back(number_text(x, path));
    return list;
  };
  const bool z = j.contains("z"), q = j.contains("q"), p = j.contains("p"), v = j.contains("v");
  if (z == q || q != (p != v) || (p && v)) throw InputError(path + ": expected z, q and p, or q and v");
  settings.initial = numbers(z ? "z" : "q");
  if (z && settings.initial.empty()) throw InputError(path + ": expected numbers, got an empty list");
  if (z) return;
  const std::string second = p ? "p" : "v";
  const std::vector<std::string> rest = numbers(second.c_str());
  if (settings.initial.size() != rest.size())
    throw InputError(path + ": expected as many numbers in q as in " + second + ", got " +
                     std::to_string(settings.initial.size()) + " and " + std::to_string(rest.size()));
  if (p)
    settings.initial.insert(settings.initial.end(), rest.begin(), rest.end());
  else
    settings.initial_velocities = rest;
}

}  // namespace pfaff::app
