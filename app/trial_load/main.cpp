// pfaff-trial-load FILE: loads a plug-in before a program does (core/registry/trial_load.hpp).
#include <pfaff/core/registry/trial_load.hpp>

int main(int argc, char** argv) {
  if (argc == 2) pfaff::load_on_trial(argv[1]);
  return 2;
}
