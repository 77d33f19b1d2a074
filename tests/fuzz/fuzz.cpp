// Reads many random inputs, or those of a corpus, by the parsers and checks of the program.
//
//   pfaff_fuzz random LANGUAGE COUNT SEED [DIRECTORY]   until COUNT inputs have passed the parser; with a
//   DIRECTORY, the
//                                                       first inputs of each end are kept there
//   pfaff_fuzz replay DIRECTORY                         the files DIRECTORY/LANGUAGE/END-NUMBER.EXTENSION,
//   each of which
//                                                       must come to the end of its name
//   pfaff_fuzz faults COUNT SEED                        the control: every fault planted among random inputs
//   is found
//
// LANGUAGE is state, configuration, experiment, model, text, bracket or table; the ends are refused, parsed
// and resolved. The exit status is 0 where nothing is wrong and 1 where a fault was found, which is printed
// with its input; what ends the process by a signal leaves its input in the file that is named first.
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

#include <pfaff/core/errors/errors.hpp>

#include "../temporary_directory.hpp"
#include "targets.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::fuzz;
using pfaff::testing::TemporaryDirectory;
namespace fs = std::filesystem;

constexpr std::array languages{"state", "configuration", "experiment", "model", "text", "bracket", "table"};
constexpr std::array<const char*, 3> ends{"refused", "parsed", "resolved"};

Language language_named(const std::string& name) {
  for (std::size_t k = 0; k < languages.size(); ++k)
    if (name == languages[k]) return static_cast<Language>(k);
  throw InputError(unknown_name("language", name, {languages.begin(), languages.end()}));
}
const char* name_of(Reached reached) { return ends[static_cast<std::size_t>(reached)]; }

// Reads one file; a fault is printed with the input, and false is returned.
template <class Target>
bool read_one(const fs::path& file, const Target& target, Reached& reached) {
  constexpr unsigned most_seconds = 60;  // what takes longer hangs; the signal ends the process
  alarm(most_seconds);
  try {
    reached = target(file);
    return true;
  } catch (...) {
    std::ifstream input(file);
    std::cerr << "FAULT " << words_of_current_exception() << "\n--- input\n" << input.rdbuf() << "\n---\n";
    return false;
  }
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text)) throw RunError("cannot write " + file.string());
}

int random(const std::string& name, long count, std::uint64_t seed, const fs::path& kept) {
  const Language language = language_named(name);
  const TemporaryDirectory directory;
  std::cerr << "inputs in " << directory.path() << '\n';
  Choices choices(seed);
  std::map<std::string, long> totals;
  long passed = 0, faults = 0;
  constexpr long kept_of_each = 8;
  while (passed < count && faults < 10) {
    const Input input = random_input(language, choices);
    const fs::path file = directory.path() / input.file;
    write(file, input.text);
    Reached reached = Reached::refused;
    if (!read_one(
            file, [&](const fs::path& f) { return read_and_resolve(language, f); }, reached)) {
      ++faults;
      continue;
    }
    passed += reached == Reached::refused ? 0 : 1;
    const long number = ++totals[name_of(reached)];
    if (!kept.empty() && number <= kept_of_each) {
      fs::create_directories(kept / name);
      write(kept / name / (name_of(reached) + ("-" + std::to_string(number)) + file.extension().string()),
            input.text);
    }
  }
  std::cout << name << ": " << passed << " passed the parser";
  for (const char* end : ends) std::cout << ", " << totals[end] << ' ' << end;
  std::cout << ", " << faults << " faults\n";
  return faults == 0 ? 0 : 1;
}

int replay(const fs::path& corpus) {
  long files = 0, faults = 0;
  for (const char* name : languages)
    for (const auto& entry : fs::directory_iterator(corpus / name)) {
      const std::string stem = entry.path().stem().string(), expected = stem.substr(0, stem.find('-'));
      Reached reached = Reached::refused;
      ++files;
      if (!read_one(
              entry.path(), [&](const fs::path& f) { return read_and_resolve(language_named(name), f); },
              reached)) {
        ++faults;
      } else if (expected != name_of(reached)) {
        std::cerr << "FAULT " << entry.path().string() << " is " << name_of(reached) << ", not " << expected
                  << '\n';
        ++faults;
      }
    }
  std::cout << files << " files, " << faults << " faults\n";
  return files > 0 && faults == 0 ? 0 : 1;
}

// A parser with a fault: it throws what is no InputError where the text has a 7.
int find_planted(long count, std::uint64_t seed) {
  const TemporaryDirectory directory;
  Choices choices(seed);
  long planted = 0, found = 0;
  for (long k = 0; k < count; ++k) {
    const Input input = random_input(Language::state, choices);
    const fs::path file = directory.path() / input.file;
    write(file, input.text);
    const bool faulty = input.text.find('7') != std::string::npos;
    planted += faulty ? 1 : 0;
    Reached reached = Reached::refused;
    const bool good = read_one(
        file,
        [&](const fs::path&) {
          if (faulty) throw std::logic_error("a seven");
          return Reached::parsed;
        },
        reached);
    found += !good && faulty ? 1 : 0;
    if (!good && !faulty) return 1;
  }
  std::cout << planted << " faults planted, " << found << " found\n";
  return planted > 0 && planted == found ? 0 : 1;
}

int run(const std::vector<std::string>& arguments) {
  const std::string what = arguments.empty() ? "" : arguments[0];
  if (what == "random" && (arguments.size() == 4 || arguments.size() == 5))
    return random(arguments[1], std::stol(arguments[2]), std::stoull(arguments[3]),
                  arguments.size() == 5 ? arguments[4] : "");
  if (what == "replay" && arguments.size() == 2) return replay(arguments[1]);
  if (what == "faults" && arguments.size() == 3)
    return find_planted(std::stol(arguments[1]), std::stoull(arguments[2]));
  throw InputError("expected random LANGUAGE COUNT SEED [DIRECTORY], replay DIRECTORY, or faults COUNT SEED");
}
}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "pfaff_fuzz: " << error.what() << '\n';
    return 2;
  }
}
