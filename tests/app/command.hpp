// Running the program as a user does: exit status, standard output, standard error, in a directory of its
// own.
#pragma once

#include <gtest/gtest.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include "../built.hpp"
#include "../temporary_directory.hpp"

namespace pfaff::testing {

namespace fs = std::filesystem;

inline std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << "cannot read " << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}
inline void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
inline nlohmann::json json_of(const std::string& text) {
  const auto j = nlohmann::json::parse(text, nullptr, false);
  EXPECT_FALSE(j.is_discarded()) << "not JSON: " << text.substr(0, 200);
  return j;
}

/// What a command left.
struct Outcome {
  int status = -1;  // exit status; 128 + the signal it died of
  std::string out, err;
};

/// How a command is started.
struct Circumstances {
  fs::path directory;                  // where it works; empty: where the test does
  fs::path program;                    // empty: the one that was built
  std::optional<rlim_t> largest_file;  // bytes; longer files fail to be written, as on a full disk
  std::optional<rlim_t> memory;        // bytes of address space
  std::string standard_output;         // a file instead of a pipe, such as /dev/full
  bool nobody_reads = false;           // standard output is a pipe whose reader has gone
};

/// The program under way.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments, const Circumstances& circumstances = {}) {
    if (pipe2(out_.data(), O_CLOEXEC) != 0 || pipe2(err_.data(), O_CLOEXEC) != 0)
      throw std::runtime_error("pipe failed");
    if (circumstances.nobody_reads) close(out_[0]), out_[0] = -1;
    const std::string program =
        (circumstances.program.empty() ? built_program() : circumstances.program).string();
    std::vector<const char*> argv{program.c_str()};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    argv.push_back(nullptr);
    id_ = fork();
    if (id_ < 0) throw std::runtime_error("fork failed");
    if (id_ == 0) {
      if (!circumstances.directory.empty() && chdir(circumstances.directory.c_str()) != 0) _exit(126);
      if (circumstances.largest_file) {
        const rlimit limit{*circumstances.largest_file, *circumstances.largest_file};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
        std::signal(SIGXFSZ, SIG_IGN);
      }
      if (circumstances.memory) {
        const rlimit limit{*circumstances.memory, *circumstances.memory};
        if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
      }
      // Tests that run in the background of a script inherit interrupts that are ignored.
      for (const int signal : {SIGINT, SIGPIPE}) std::signal(signal, SIG_DFL);
      alarm(600);  // what never ends is a failure
      int out = out_[1];
      if (!circumstances.standard_output.empty())
        out = open(circumstances.standard_output.c_str(), O_WRONLY | O_CLOEXEC);
      if (out < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(err_[1], STDERR_FILENO) < 0) _exit(126);
      execv(program.c_str(), const_cast<char* const*>(argv.data()));
      _exit(127);
    }
    close(out_[1]), close(err_[1]);
  }
  ~Program() {
    if (id_ > 0) kill(), wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// What `kill -9` does.
  void kill() const { send(SIGKILL); }
  void send(int signal) const { ::kill(id_, signal); }
  [[nodiscard]] pid_t id() const { return id_; }
  /// True once it has ended; it must still be waited for.
  [[nodiscard]] bool ended() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == id_;
  }

  Outcome wait() {
    Outcome outcome;
    std::array<pollfd, 2> streams{{{out_[0], POLLIN, 0}, {err_[0], POLLIN, 0}}};
    std::array<std::string*, 2> texts{&outcome.out, &outcome.err};
    std::array<char, 65536> buffer{};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
      if (poll(streams.data(), streams.size(), -1) < 0) {
        if (errno == EINTR)
          continue;  // stopped and continued meanwhile, as by a debugger or a machine that sleeps
        break;
      }
      for (std::size_t k = 0; k < streams.size(); ++k) {
        if (streams[k].fd < 0 || streams[k].revents == 0) continue;
        const ssize_t count = read(streams[k].fd, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count > 0) {
          texts[k]->append(buffer.data(), static_cast<std::size_t>(count));
        } else {
          close(streams[k].fd);
          streams[k].fd = -1;
        }
      }
    }
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
  }

 private:
  std::array<int, 2> out_{}, err_{};
  pid_t id_ = -1;
};

inline Outcome run_pfaff(const std::vector<std::string>& arguments, const Circumstances& circumstances = {}) {
  return Program(arguments, circumstances).wait();
}

inline std::string joined(const std::vector<std::string>& arguments) {
  std::string text = "pfaff";
  for (const std::string& argument : arguments) text += " '" + argument + "'";
  return text;
}
inline std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// What `evaluate` says of a system, with arguments after its name. The exit status is 1 where the state is
/// singular.
inline nlohmann::json evaluated(const std::vector<std::string>& more, int status = 0) {
  const Outcome outcome = run_pfaff(std::vector<std::string>{"evaluate", "--json", "--system"} + more);
  EXPECT_EQ(outcome.status, status) << joined(more) << outcome.err;
  EXPECT_EQ(outcome.err.empty(), status == 0) << outcome.err;
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["schema"], 1);
  return j;
}
inline std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

/// One line on stderr that begins with "pfaff: " and holds every fragment; nothing on stdout.
inline void expect_complaint(const Outcome& outcome, int status, const std::vector<std::string>& fragments,
                             const std::string& command) {
  SCOPED_TRACE(command + "\n  said: " + outcome.err);
  EXPECT_EQ(outcome.status, status);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("pfaff: "));
  EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << "not exactly one line";
  EXPECT_LT(outcome.err.size(), 400U);
  for (const std::string& fragment : fragments)
    EXPECT_NE(outcome.err.find(fragment), std::string::npos) << "does not say: " << fragment;
}

/// The command is refused, in one line that holds every fragment, and leaves nothing behind.
inline void expect_refused(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& fragments, int status = 2) {
  const TemporaryDirectory directory;
  Circumstances here;
  here.directory = directory.path();
  expect_complaint(run_pfaff(arguments, here), status, fragments, joined(arguments));
  EXPECT_TRUE(fs::is_empty(directory.path())) << joined(arguments) << " left files";
}

/// The fields of a table of comma-separated values without quotes.
inline std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ',');
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

}  // namespace pfaff::testing
