// Two programs never write into one directory: neither while scripts draw its figures, nor in a part of it.
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>

#include <chrono>
#include <memory>
#include <thread>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;
using std::chrono::milliseconds;

Arguments run_of_a_spring(const std::string& out) {
  const std::string plugin = test_plugin("spring-1");
  return {"run",    "--out", out,      "--system", "test-spring", "--integrator", "verlet",
          "--step", "0.01",  "--time", "1",        "--json",      "--plugin",     plugin};
}
Arguments compare_test(const TemporaryDirectory& files) {
  return {"compare",     files / "test.toml", "--json",   "--out",
          files / "out", "--no-report",       "--timing", "0.001"};
}
constexpr const char* run_of_it = "out/runs/c-rk4-h0.1";

void make_experiment(const TemporaryDirectory& files) {
  write(files / "test.toml",
        "schema = 1\ntitle = \"A test\"\n[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n[[case]]\n"
        "name = \"c\"\nsystem = \"pendulum\"\ntime = 1\nsteps = [0.1, 0.05]\n");
  ASSERT_EQ(run_pfaff(compare_test(files)).status, 0);
}

// A lock that somebody else holds on a directory.
class Held {
 public:
  explicit Held(const fs::path& directory)
      : path_(directory / ".lock"), file_(open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) != 0 || pwrite(file_, "process 7", 9, 0) != 9)
      throw std::runtime_error("no lock");
  }
  ~Held() { close(file_); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  fs::path path_;
  int file_;
};

// Waits until the condition holds, or the program has ended; true where it holds.
template <class Condition>
bool holds_while_it_works(const Program& program, const Condition& condition) {
  while (!condition()) {
    if (program.ended()) return false;
    std::this_thread::sleep_for(milliseconds(1));
  }
  return true;
}

TEST(TwoWriters, PlotAndCompareRespectEachOther) {
  const TemporaryDirectory files;
  make_experiment(files);
  {
    const Held held(files.path() / "out");  // as by `pfaff compare`
    for (const Arguments& command :
         {Arguments{"plot", files / run_of_it}, compare_test(files), run_of_a_spring(files / run_of_it)})
      expect_complaint(run_pfaff(command), 2, {files / "out", "is in use by process 7"}, joined(command));
  }
  {
    const Held held(files.path() / run_of_it);
    expect_complaint(run_pfaff({"plot", files / run_of_it}), 2, {"is in use by process 7"}, "plot");
  }
  EXPECT_FALSE(fs::exists(files.path() / run_of_it / "plot"));
  Program plot({"plot", files / run_of_it, "--json"});
  ASSERT_TRUE(holds_while_it_works(plot, [&] { return fs::exists(files.path() / "out/.lock"); }));
  expect_complaint(run_pfaff(compare_test(files)), 2,
                   {files / "out", "is in use by process " + std::to_string(plot.id())}, "compare");
  EXPECT_EQ(plot.wait().status, 0);
  EXPECT_EQ(run_pfaff(compare_test(files)).status, 0);
  EXPECT_FALSE(fs::exists(files.path() / "out/.lock"));
  EXPECT_FALSE(fs::exists(files.path() / run_of_it / ".lock"));
}

TEST(TwoWriters, TheLockIsHeldUntilTheLastFigureIsThere) {
  const TemporaryDirectory files;
  make_experiment(files);
  Program figures(compare_test(files) + Arguments{"--figures", "svg"});
  ASSERT_TRUE(holds_while_it_works(figures, [&] { return fs::exists(files.path() / "out/figures/paper"); }));
  expect_complaint(run_pfaff(compare_test(files)), 2,
                   {"is in use by process " + std::to_string(figures.id())}, "compare");
  EXPECT_EQ(figures.wait().status, 0);
}

// The children of a process, by what the system says of all processes.
std::vector<int> children_of(int parent) {
  std::vector<int> children;
  DIR* processes = opendir("/proc");
  while (const dirent* entry = readdir(processes)) {
    if (std::atoi(entry->d_name) == 0) continue;
    std::ifstream status("/proc/" + std::string(entry->d_name) + "/stat");
    std::string text((std::istreambuf_iterator<char>(status)), {});
    int of = 0;
    char state = 0;
    const std::size_t end = text.rfind(')');
    if (end != std::string::npos && std::sscanf(text.c_str() + end, ") %c %d", &state, &of) == 2 &&
        of == parent && state != 'Z')
      children.push_back(std::atoi(entry->d_name));
  }
  closedir(processes);
  return children;
}
bool lives(int process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  std::string text((std::istreambuf_iterator<char>(status)), {});
  const std::size_t end = text.rfind(')');
  return end != std::string::npos && text.at(end + 2) != 'Z';
}

TEST(TwoWriters, AScriptEndsWithTheProgramThatIsKilled) {
  const TemporaryDirectory files;
  ASSERT_EQ(run_pfaff(run_of_a_spring(files / "run")).status, 0);
  make_experiment(files);
  for (const Arguments& command :
       {Arguments{"plot", files / "run"}, compare_test(files) + Arguments{"--figures", "svg"}}) {
    std::vector<int> children;
    {
      Program program(command);
      ASSERT_TRUE(
          holds_while_it_works(program, [&] { return !(children = children_of(program.id())).empty(); }));
      program.kill();
      (void)program.wait();
    }
    // It has its signal by now, and takes longer than this to draw anything.
    for (int k = 0; k < 200 && lives(children.front()); ++k) std::this_thread::sleep_for(milliseconds(1));
    EXPECT_FALSE(lives(children.front())) << joined(command);
  }
  EXPECT_FALSE(fs::exists(files.path() / "run/plot/plot.html"));
}

// Whoever loses the race for a new directory is told that it is in use, or finds the run of the winner.
TEST(TwoWriters, ALoserIsToldThatItIsInUse) {
  const TemporaryDirectory files;
  int in_use = 0;
  for (int round = 0; round < 12; ++round) {
    const std::string out = files / ("run-" + std::to_string(round));
    std::vector<std::unique_ptr<Program>> programs;
    for (int k = 0; k < 6; ++k) programs.push_back(std::make_unique<Program>(run_of_a_spring(out)));
    int done = 0;
    for (const auto& program : programs) {
      const Outcome outcome = program->wait();
      done += outcome.status == 0 ? 1 : 0;
      if (outcome.status == 0) continue;
      ++in_use;
      EXPECT_EQ(outcome.status, 2);
      EXPECT_NE(outcome.err.find("is in use by "), std::string::npos) << outcome.err;
    }
    EXPECT_GE(done, 1);
    EXPECT_FALSE(fs::exists(out + "/.lock"));
  }
  RecordProperty("in_use", in_use);
}

}  // namespace
