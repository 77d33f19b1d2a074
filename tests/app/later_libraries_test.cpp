// The libraries of plug-ins and of studies: what needs none of them works without them, and one that is
// missing, damaged or of another build is refused in one line before it is loaded.
#include <link.h>

#include <algorithm>
#include <cstring>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

// The program with its libraries but one in a directory of their own, which is all but a build tree: the
// program finds the experiments of the source tree there.
class OneLibraryAway : public ::testing::Test {
 protected:
  explicit OneLibraryAway(const std::string& stem) {
    const fs::path built = built_program().parent_path();
    for (const auto& entry : fs::directory_iterator(built)) {
      const std::string name = entry.path().filename().string();
      if (name == "pfaff" || name.starts_with("libpfaff"))
        fs::copy(entry.path(), files_.path() / name, fs::copy_options::copy_symlinks);
      if (name.starts_with(stem + ".so.") && (name_.empty() || name.size() < name_.size())) name_ = name;
    }
    library_ = files_.path() / name_;
    whole_ = text_of(library_);
    fs::remove(fs::canonical(library_));
    fs::remove(library_);
  }

  [[nodiscard]] Outcome run(const Arguments& arguments) const {
    Circumstances here;
    here.directory = files_.path();
    here.program = files_.path() / "pfaff";
    return run_pfaff(arguments, here);
  }
  // Puts a file in the place of the library.
  void put(const std::string& bytes) const {
    fs::remove_all(library_);
    write(library_, bytes);
  }
  void say_that_it_is_a_build_tree(const fs::path& libraries) const {
    const std::string source = fs::path(PFAFF_GOLDEN).parent_path().parent_path().string();
    write(files_.path() / "CMakeCache.txt", "# cache\nCMAKE_HOME_DIRECTORY:INTERNAL=" + source +
                                                "\nPfaff_BINARY_DIR:STATIC=" + libraries.string() + "\n");
  }
  void expect_main_job() const {
    say_that_it_is_a_build_tree(directory());
    const Outcome outcome =
        run({"compare", "damped-oscillator", "--quick", "--no-report", "--timing", "0.001", "--out", "out"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(directory() / "out/results.csv"));
  }
  [[nodiscard]] const fs::path& directory() const { return files_.path(); }
  [[nodiscard]] const fs::path& library() const { return library_; }
  [[nodiscard]] const std::string& whole() const { return whole_; }

 private:
  TemporaryDirectory files_;
  std::string name_, whole_;
  fs::path library_;
};

class Studies : public OneLibraryAway {
 protected:
  Studies() : OneLibraryAway("libpfaff_studies") {}
  // A file in its place is refused, in one line that names it.
  void expect_refusal(const std::vector<std::string>& fragments, const std::string& what) const {
    expect_complaint(
        run({"derive", "damped-pendulum", "--method", "birkhoffian"}), 2,
        std::vector<std::string>{"library of studies '" + library().string() + "': "} + fragments, what);
  }
};

std::string example_table() {
  return fs::path(PFAFF_GOLDEN).parent_path().parent_path() / "examples/tables/pefrl.toml";
}

class ShippedPlugins : public OneLibraryAway {
 protected:
  ShippedPlugins() : OneLibraryAway("libpfaff_plugins") {}
  // What is there is listed, and one line says that it is not all.
  void expect_not_all(const std::vector<std::string>& fragments, const std::string& what) const {
    const Outcome outcome = run({"list", "--names", "systems"});
    EXPECT_EQ(outcome.status, 0) << what;
    EXPECT_EQ(outcome.out, "damped-oscillator\n") << what;
    for (const std::string& fragment : fragments)
      EXPECT_NE(outcome.err.find(fragment), std::string::npos) << what << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << what << ": " << outcome.err;
  }
};

TEST_F(Studies, NamesAndHelpNeedNoLibrary) {
  say_that_it_is_a_build_tree(directory());
  std::vector<Arguments> all{{"--help"},
                             {"--version"},
                             {"list"},
                             {"list", "--json"},
                             {"list", "--markdown"},
                             {"help", "--man"},
                             {"completion", "bash"},
                             {"completion", "zsh"}};
  for (const char* command : {"verify", "falsify", "reproduce", "derive", "tune", "compare", "list"}) {
    all.push_back({"help", command});
    all.push_back({command, "--help"});
  }
  for (const Arguments& arguments : all) {
    const Outcome with = run_pfaff(arguments), without = run(arguments);
    EXPECT_EQ(without.status, 0) << joined(arguments) << without.err;
    EXPECT_EQ(without.out, with.out) << joined(arguments);
  }
  // The control: what needs it does not go on without it.
  for (const Arguments& arguments :
       {Arguments{"verify", "pendulum"}, Arguments{"falsify", "rk4"}, Arguments{"reproduce", "--list"},
        Arguments{"derive", "pendulum", "--method", "birkhoffian"},
        Arguments{"tune", "pendulum", "--step", "1"}})
    expect_complaint(run(arguments), 2, {"is missing"}, joined(arguments));
}

TEST_F(Studies, ExperimentsNeedNoLibrary) {
  expect_main_job();
  // One of several experiments needs it, which is seen before any is run.
  const Arguments two{"compare", "damped-oscillator", "derive", "--quick", "--no-report", "--out", "both"};
  expect_complaint(run(two), 2, {"is missing"}, joined(two));
  EXPECT_FALSE(fs::exists(directory() / "both"));
}

TEST_F(Studies, AWholeLibraryIsLoaded) {
  put(whole());
  const Arguments derive{"derive", "damped-pendulum", "--method", "birkhoffian", "--emit", "cpp"};
  const Outcome outcome = run(derive);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, run_pfaff(derive).out);
  // A wrong use of a command is said without it.
  fs::remove(library());
  expect_complaint(run({"derive", "damped-pendulum", "--method", "birkhoffian", "--set", "nu"}), 2,
                   {"expected KEY=VALUE"}, "derive");
}

// The end of what the loader maps; names of sections and symbols for debuggers may stand behind it.
std::size_t end_of_segments(const std::string& file) {
  ElfW(Ehdr) header;
  std::memcpy(&header, file.data(), sizeof header);
  std::size_t end = 0;
  for (std::size_t k = 0; k < header.e_phnum; ++k) {
    ElfW(Phdr) segment;
    std::memcpy(&segment, file.data() + header.e_phoff + k * sizeof segment, sizeof segment);
    if (segment.p_type == PT_LOAD) end = std::max<std::size_t>(end, segment.p_offset + segment.p_filesz);
  }
  return end;
}

// Cut off in the middle a file could be mapped into memory but not read, which would end the program by a
// signal.
TEST_F(Studies, ADamagedLibraryIsRefused) {
  const std::size_t end = end_of_segments(whole());
  for (std::size_t size = sizeof(ElfW(Ehdr)); size < end; size += end / 23) {
    put(whole().substr(0, size));
    expect_refusal({"is cut off or damaged"}, "cut off at " + std::to_string(size));
  }
  put(whole().substr(0, end - 1));
  expect_refusal({"is cut off or damaged"}, "without the last byte");
  for (const std::string& text :
       {std::string(), std::string("no library\n"), whole().substr(0, 40), std::string(100000, '\0')}) {
    put(text);
    expect_refusal({"is no shared object"}, text.substr(0, 10));
  }
  fs::remove(library());
  fs::create_directory(library());
  expect_refusal({"is no regular file"}, "a directory");
  // The loader's own words, of a library that it does not find.
  std::string other = whole();
  const std::size_t needed = other.find(std::string("\0libpfaff_bench.so.", 19));
  ASSERT_NE(needed, std::string::npos);
  other[needed + 1] = 'L';
  put(other);
  expect_refusal({"Libpfaff_bench.so"}, "a library that is not there");
}

TEST_F(Studies, ALibraryOfAnotherBuildIsRefused) {
  const std::string begin = "linked with ";
  const std::size_t note = whole().find(begin);
  ASSERT_NE(note, std::string::npos);
  const std::size_t first = note + begin.size(), second = whole().find(' ', first) + 1;
  for (const std::size_t at : {first, second}) {
    std::string other = whole();
    other[at] = other[at] == '0' ? '1' : '0';
    put(other);
    expect_refusal({"belongs to another build of Pfaff"}, "build " + other.substr(note, 100));
  }
  put(text_of(test_plugin("fits")));
  expect_refusal({"does not say which build"}, "a plug-in");
}

TEST_F(Studies, ARefusalNamesWhatMendsIt) {
  expect_refusal({"is missing", "installation"}, "no build tree");
  say_that_it_is_a_build_tree(directory() / "elsewhere");
  expect_refusal({"is missing", "installation"}, "installed into a build tree");
  say_that_it_is_a_build_tree(directory());
  const std::string build = "cmake --build '" + directory().string() + "' --target pfaff_studies";
  expect_refusal({"is missing", build}, "missing in a build tree");
  // A damaged file is newer than what it is made from, and a build would keep it.
  put("damaged");
  expect_refusal({"rm '" + fs::canonical(library()).string() + "'; " + build}, "damaged in a build tree");
}

TEST_F(ShippedPlugins, TheMainJobNeedsNoneOfThem) {
  expect_main_job();
  // Its runs are the same with the library, which made nothing of them.
  const Arguments kept{"run", "damped-oscillator", "gauss", "--step", "0.1", "--time", "1", "--out", "kept"};
  EXPECT_EQ(run(kept).status, 0);
  const std::string before = text_of(directory() / "kept/config.toml");
  put(whole());
  const Outcome again = run(kept);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(text_of(directory() / "kept/config.toml"), before);
  EXPECT_EQ(before.find("libpfaff_plugins"), std::string::npos);
  // The control: what is made by the library names its build, and so do tables, whose methods are the
  // library's.
  for (const std::string& method : {std::string("verlet"), example_table()}) {
    EXPECT_EQ(
        run({"run", "pendulum", method, "--step", "0.1", "--time", "1", "--force", "--out", "made"}).status,
        0);
    EXPECT_NE(text_of(directory() / "made/config.toml").find("\"" + library().filename().string() + "\" = "),
              std::string::npos)
        << method;
  }
}

TEST_F(ShippedPlugins, WhatNeedsThemSaysWhatMakesThem) {
  say_that_it_is_a_build_tree(directory());
  const std::string build = "cmake --build '" + directory().string() + "' --target pfaff_studies";
  const std::string name = "library of plug-ins '" + library().string() + "': is missing";
  expect_not_all({"not all systems and methods are shown", name, build}, "missing");
  for (const Arguments& arguments :
       {Arguments{"run", "kepler", "rk4", "--step", "0.1", "--time", "1", "--out", "-"},
        Arguments{"run", "damped-oscillator", "verlet", "--step", "0.1", "--time", "1", "--out", "-"},
        Arguments{"describe", "kepler-in-plane"}, Arguments{"evaluate", "kepler"},
        Arguments{"compare", "kepler", "--quick", "--out", "out"}, Arguments{"verify"},
        Arguments{"falsify", "rk4"}})
    expect_complaint(run(arguments), 2, {name, build}, joined(arguments));
  EXPECT_FALSE(fs::exists(directory() / "out"));
  // Of two experiments the second needs it, which is seen before the first is run.
  const Arguments two{"compare", "damped-oscillator", "kepler", "--quick", "--no-report", "--out", "two"};
  expect_complaint(run(two), 2, {"unknown system 'kepler'", name, build}, joined(two));
  EXPECT_FALSE(fs::exists(directory() / "two"));
  // What takes every method does not take those alone that are there.
  write(directory() / "all.toml",
        "schema = 1\ntitle = \"All\"\nmethods = \"all\"\n[[case]]\nname = \"one\"\n"
        "system = \"damped-oscillator\"\ntime = \"1\"\nsteps = [\"0.1\"]\n");
  expect_complaint(run({"compare", "all.toml", "--no-report", "--out", "all"}), 2, {name, build},
                   "methods = all");
  expect_complaint(run({"list", "--markdown"}), 2, {name, build}, "list --markdown");
  // What a plug-in fits is among others; kinds that are there whole are listed without a word.
  EXPECT_NE(run({"describe", "rk4"}).err.find("not all systems and methods are shown"), std::string::npos);
  EXPECT_EQ(run({"list", "measures"}).err, "");
  // A complaint about a file shows its line too.
  const Outcome of_table =
      run({"run", "damped-oscillator", example_table(), "--step", "0.1", "--time", "1", "--out", "-"});
  EXPECT_EQ(of_table.status, 2);
  for (const std::string& fragment : {std::string("unknown kind 'splitting'"), name, build})
    EXPECT_NE(of_table.err.find(fragment), std::string::npos) << of_table.err;
}

TEST_F(ShippedPlugins, DamagedAndOtherOnesAreNotLoaded) {
  const std::size_t end = end_of_segments(whole());
  for (std::size_t size = sizeof(ElfW(Ehdr)); size < end; size += end / 5) {
    put(whole().substr(0, size));
    expect_not_all({"is cut off or damaged"}, "cut off at " + std::to_string(size));
  }
  put("no library\n");
  expect_not_all({"is no shared object"}, "text");
  std::string other = whole();
  const std::size_t build = other.find("linked with ") + 12;
  ASSERT_LT(build, other.size());
  other[build] = other[build] == '0' ? '1' : '0';
  put(other);
  expect_not_all({"belongs to another build of Pfaff"}, "another build");
  put(text_of(test_plugin("fits")));
  expect_not_all({"does not say which build"}, "a plug-in");
}

}  // namespace
