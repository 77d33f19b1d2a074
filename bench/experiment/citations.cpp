#include <pfaff/bench/experiment/citations.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>

#include <pfaff/bench/runner/files.hpp>

namespace pfaff {

namespace {
// Entries by key, in the order of the alphabet. An entry begins with '@' at the start of a line.
const std::map<std::string, std::string>& entries() {
  static const std::map<std::string, std::string> all = [] {
    std::map<std::string, std::string> result;
    namespace fs = std::filesystem;
    std::error_code error;
    if (!find_data_directory()) return result;
    const fs::path path = shipped_path("references.bib");
    if (!fs::exists(path, error)) return result;
    const std::string text = read_file(path);
    for (std::size_t begin = text.find('@'); begin != std::string::npos;) {
      const std::size_t next = text.find("\n@", begin);
      const std::size_t end = next == std::string::npos ? text.size() : next + 1;
      const std::string entry = text.substr(begin, end - begin);
      const std::size_t brace = entry.find('{'), comma = entry.find(',');
      if (brace != std::string::npos && comma != std::string::npos)
        result[entry.substr(brace + 1, comma - brace - 1)] =
            entry.substr(0, entry.find_last_not_of("\n ") + 1);
      begin = next == std::string::npos ? next : next + 1;
    }
    return result;
  }();
  return all;
}

std::string field(const std::string& entry, const std::string& name) {
  std::smatch match;
  const std::regex pattern("[\\s,]" + name + "\\s*=\\s*[{\"]((?:[^{}\"]|\\{[^{}]*\\})*)[}\"]",
                           std::regex::icase);
  if (!std::regex_search(entry, match, pattern)) return {};
  std::string value = std::regex_replace(match[1].str(), std::regex("[{}]"), "");
  value = std::regex_replace(value, std::regex("\\s+"), " ");
  return std::regex_replace(value, std::regex("--"), "\u2013");
}
}  // namespace

std::string bibtex(const std::string& key) {
  const auto found = entries().find(key);
  return found == entries().end() ? std::string() : found->second;
}

std::string citation(const std::string& key) {
  const std::string entry = bibtex(key);
  if (entry.empty()) return key;
  std::string line = field(entry, "author");
  line = std::regex_replace(line, std::regex(" and "), "; ");
  for (const char* name : {"title", "journal", "publisher"})
    if (const std::string value = field(entry, name); !value.empty())
      line += (line.empty() ? "" : ", ") + value;
  if (const std::string volume = field(entry, "volume"); !volume.empty()) line += " " + volume;
  if (const std::string year = field(entry, "year"); !year.empty()) line += " (" + year + ")";
  if (const std::string pages = field(entry, "pages"); !pages.empty()) line += " " + pages;
  return line;
}

std::vector<std::string> citation_keys() {
  std::vector<std::string> keys;
  for (const auto& [key, entry] : entries()) keys.push_back(key);
  return keys;
}

std::vector<std::string> keys_in(const std::string& reference) {
  std::vector<std::string> keys;
  for (const std::string& key : citation_keys())
    if (reference.find(key) != std::string::npos) keys.push_back(key);
  return keys;
}

}  // namespace pfaff
