#include <pfaff/core/native/compiler.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff::native {

namespace fs = std::filesystem;

namespace {
// Values are those of IEEE arithmetic in the order of the text: no contraction, no reordering. Without errno
// a square root is one instruction. The instructions are those that the library itself needs.
constexpr const char* flags =
    "-std=c++17 -O2 -shared -fPIC -ffp-contract=off -fno-math-errno -fno-tree-slp-vectorize "
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

// Starts a program with its output in `output`, a file, and waits for it; the exit status, or -1 where it
// cannot be started or dies.
int run(const std::vector<std::string>& words, const std::string& output) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));  // NOLINT
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions) != 0) return -1;
  bool ready = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0) == 0;
  ready = ready && posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                                    O_WRONLY | O_CREAT | O_TRUNC, 0600) == 0;
  ready = ready && posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO) == 0;
  pid_t child = -1;
  ready = ready && posix_spawnp(&child, arguments.front(), &actions, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  if (!ready) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// The directory of the libraries: the user's own, and closed to everybody else. Code is loaded from it.
fs::path cache() {
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  fs::path parent;
  if (xdg != nullptr && xdg[0] == '/') {
    parent = xdg;
  } else if (home != nullptr && home[0] == '/') {
    parent = fs::path(home) / ".cache";
  } else {
    throw RunError(
        "compiled formulas are kept in $XDG_CACHE_HOME or ~/.cache; expected one of them to be set");
  }
  std::error_code ignored;
  fs::create_directories(parent, ignored);
  fs::path directory = parent / "pfaff-native";
  if (mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST)
    throw RunError("cannot make the directory '" + directory.string() + "': " + std::strerror(errno));
  struct stat status {};
  if (lstat(directory.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
      (status.st_mode & 0077U) != 0)
    throw RunError("compiled formulas are loaded from '" + directory.string() +
                   "'; expected a directory of the user's own that is closed to others (chmod 700)");
  return directory;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// 128 bits that tell texts apart; what is found under the name is compared with the text itself.
std::string name_of(const std::string& text) {
  std::array<std::uint64_t, 2> hash{14695981039346656037U, 0x9e3779b97f4a7c15U};
  for (const char c : text)
    for (std::uint64_t& h : hash) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211U;
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "%016llx%016llx", static_cast<unsigned long long>(hash[0]),
                static_cast<unsigned long long>(hash[1]));
  return name.data();
}

std::shared_ptr<const Library> loaded(const fs::path& path) {
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  return handle != nullptr ? std::make_shared<const Library>(handle) : nullptr;
}

// Names of files that no other process or thread has.
fs::path temporary(const fs::path& directory, const std::string& name) {
  static std::atomic<int> count{0};
  return directory / (name + "." + std::to_string(getpid()) + "." + std::to_string(++count));
}

std::string version_of(const std::vector<std::string>& words) {
  std::vector<std::string> command = words;
  command.emplace_back("--version");
  const fs::path said = temporary(cache(), "version");
  const bool there = run(command, said) == 0;
  std::string line = content(said);
  std::error_code ignored;
  fs::remove(said, ignored);
  line = line.substr(0, line.find('\n'));
  return there ? (line.empty() ? "unknown version" : line) : "";
}
}  // namespace

Library::~Library() { dlclose(handle_); }
void* Library::symbol(const std::string& name) const { return dlsym(handle_, name.c_str()); }

const std::string& compiler_version() {
  static const std::string version = version_of(compiler());
  return version;
}

std::string compiler_identity() {
  if (compiler_version().empty()) return "interpreted: no compiler";
  return compiler_version() + ":" + command_line();
}

std::shared_ptr<const Library> library_of(const std::string& code, const std::string& what) {
  const std::vector<std::string> words = compiler();
  const std::string text = "//" + command_line() + "\n// " + compiler_version() + "\n" + code;

  const fs::path directory = cache();
  const std::string name = name_of(text);
  const fs::path library = directory / (name + ".so"), source = directory / (name + ".cpp");
  if (content(source) == text)
    if (auto found = loaded(library)) return found;

  const fs::path made = temporary(directory, name);
  const fs::path made_source = made.string() + ".cpp", made_library = made.string() + ".so",
                 log = made.string() + ".log";
  std::ofstream(made_source, std::ios::binary) << text;
  if (content(made_source) != text) throw RunError("cannot write '" + made_source.string() + "'");
  std::vector<std::string> command = words;
  const std::vector<std::string> options = words_of(flags);
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"-o", made_library.string(), made_source.string()});
  if (const int status = run(command, log); status != 0)
    throw RunError("compiling the formulas of " + what + ": " + words.front() +
                   (status < 0 ? " could not be run" : " ended with status " + std::to_string(status)) +
                   "; its messages are in '" + log.string() + "'");
  fs::rename(made_library, library);
  fs::rename(made_source, source);
  std::error_code ignored;
  fs::remove(log, ignored);
  if (auto found = loaded(library)) return found;
  throw RunError("the compiled formulas of " + what + " cannot be loaded: " + dlerror());
}

}  // namespace pfaff::native
