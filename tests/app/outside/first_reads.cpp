// The first reads of registries, which load the library of plug-ins: by several threads at once, one of which
// loads a shared object that reads them too; and where the program has a system of a name that ships.
//   first_reads SHARED-OBJECT
// Prints what is not as expected; the exit status is how many of these there are.
#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/constrained/lobatto_spark.hpp>
#include <pfaff/systems/canonical/harmonic_oscillator.hpp>

namespace {
using namespace pfaff;

const System<HarmonicOscillator> taken{{.name = "kepler",
                                        .title = "a system of a name that ships",
                                        .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                        .invariants = {conserved_quadratic("energy", "m^2/s^2")}}};

int faults = 0;
void expect(bool holds, const std::string& what) {
  if (holds) return;
  std::printf("%s\n", what.c_str());
  ++faults;
}

// What a process of its own ends with, since only one read of a process is the first.
template <class Work>
int status_of(const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // a lock that nobody gives back
    _exit(work() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

bool all_are_there() {
  return systems().find("pendulum") != nullptr && integrators().find("verlet") != nullptr;
}

bool read_at_once(const char* shared_object) {
  bool loaded = false;
  std::vector<int> found(4);
  std::vector<std::thread> threads;
  threads.emplace_back([&] { loaded = dlopen(shared_object, RTLD_NOW | RTLD_LOCAL) != nullptr; });
  for (int& one : found) threads.emplace_back([&one] { one = all_are_there() ? 1 : 0; });
  for (std::thread& thread : threads) thread.join();
  for (const int one : found)
    if (one == 0) return false;
  return loaded;
}
}  // namespace

int main(int count, char** words) {
  if (count != 2) return 100;
  for (int k = 0; k < 20; ++k)
    expect(status_of([&] { return read_at_once(words[1]); }) == 0, "threads that read at once");
  const std::string file = systems().get("kepler", "system").file();
  expect(file.find("systems/canonical/kepler.cpp") != std::string::npos, "kepler is that of " + file);
  const std::vector<std::string> twice = registered_twice();
  expect(twice.size() == 1 && twice[0].find("first_reads.cpp") != std::string::npos,
         "kepler is no duplicate");
  // Headers for authors call what libpfaff has.
  LobattoSpark method;
  method.stages = 4;
  method.validate();
  return faults;
}
