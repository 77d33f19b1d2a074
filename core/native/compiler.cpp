#include <pfaff/core/native/compiler.hpp>

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/native/library_cache.hpp>
#include <pfaff/core/process/child_program.hpp>
#include <pfaff/core/process/shared_object.hpp>

namespace pfaff::native {

namespace {
// Values are those of IEEE arithmetic in the order of the text, whatever the user's words for the compiler
// are: no contraction, no reordering. Without errno a square root is one instruction. The compiler may not
// know what an arc tangent is, or it takes cos(atan(x)) for 1/sqrt(1 + x^2) in the code for doubles, where it
// sees it, and not in that for packs. The instructions are those that the library itself needs.
constexpr const char* flags =
    "-std=c++17 -O2 -shared -fPIC -fno-fast-math -fno-unsafe-math-optimizations -ffp-contract=off "
    "-fno-math-errno -fno-builtin-atan -fno-tree-slp-vectorize "
    "-w" PFAFF_INSTRUCTIONS;

std::vector<std::string> words_of(const char* text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> compiler() {
  const char* named = std::getenv("CXX");
  std::vector<std::string> words = words_of(named != nullptr ? named : "");
  if (words.empty()) words.emplace_back("c++");
  return words;
}

// The compiler's words and the flags, each after a space.
std::string command_line() {
  std::string line;
  for (const std::string& word : compiler()) line += " " + word;
  return line + " " + flags;
}

std::shared_ptr<const Library> loaded(const std::string& path, const std::string& what) {
  void* handle = load_shared_object(path, "the compiled formulas of " + what);
  return handle != nullptr ? std::make_shared<const Library>(handle) : nullptr;
}

std::string version_of(std::vector<std::string> words) {
  words.emplace_back("--version");
  const ChildEnding ending = run_program({.words = std::move(words)});
  if (!ending.succeeded()) return "";
  const std::string line = ending.output.substr(0, ending.output.find('\n'));
  return line.empty() ? "unknown version" : line;
}
}  // namespace

Library::~Library() { dlclose(handle_); }
void* Library::symbol(const std::string& name) const { return dlsym(handle_, name.c_str()); }

std::string compiler_version() {
  // Asked once of each compiler: the process may set CXX anew.
  static std::mutex mutex;
  static std::map<std::vector<std::string>, std::string> versions;
  const std::vector<std::string> words = compiler();
  const std::lock_guard lock(mutex);
  const auto known = versions.find(words);
  return known != versions.end() ? known->second : versions.emplace(words, version_of(words)).first->second;
}

std::string compiler_identity() {
  if (compiler_version().empty()) return "interpreted: no compiler";
  return compiler_version() + ":" + command_line();
}

std::shared_ptr<const Library> library_of(const std::string& code, const std::string& what) {
  const std::string text = "//" + command_line() + "\n// " + compiler_version() + "\n" + code;
  const LibraryCache cache;
  if (cache.holds(text))
    if (auto found = loaded(cache.library(text), what)) return found;

  const Workshop workshop(cache);
  const std::filesystem::path source = workshop.path() / "formulas.cpp",
                              made = workshop.path() / "formulas.so";
  write_durably(source, text);
  std::vector<std::string> command = compiler();
  const std::vector<std::string> options = words_of(flags);
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"-o", made.string(), source.string()});
  // What the compiler puts aside goes with the workshop, also where it is killed.
  const ChildEnding ending = run_program({.words = command, .with = {"TMPDIR=" + workshop.path().string()}});
  if (!ending.succeeded())
    throw RunError("compiling the formulas of " + what + ": " + command.front() + " " + ending.in_words() +
                   "; its messages are in '" + cache.keep_messages(text, ending.output).string() + "'");
  cache.keep(text, made);
  if (auto found = loaded(cache.library(text), what)) return found;
  throw RunError("the compiled formulas of " + what + " cannot be loaded: " + dlerror());
}

}  // namespace pfaff::native
