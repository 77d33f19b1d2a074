// The cache of compiled formulas: what is damaged is made anew before it is loaded, what a killed program
// left is removed, and what another program is making is left alone.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cfloat>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/native/compiler.hpp>
#include <pfaff/core/native/library_cache.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

constexpr const char* code = "extern \"C\" double pfaff_test() { return 0.5; }\n";

class LibraryCache : public ::testing::Test {
 protected:
  LibraryCache() { setenv("XDG_CACHE_HOME", (files_ / "cache").c_str(), 1); }
  ~LibraryCache() override {
    unsetenv("XDG_CACHE_HOME");
    unsetenv("CXX");
  }
  [[nodiscard]] fs::path folder() const { return files_.path() / "cache/pfaff-native"; }
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder())) all.insert(entry.path().extension().string());
    return all;
  }
  [[nodiscard]] fs::path kept(const char* extension) const {
    for (const auto& entry : fs::directory_iterator(folder()))
      if (entry.path().extension() == extension) return entry.path();
    return {};
  }

 private:
  TemporaryDirectory files_;
};

double value_of(const std::string& text) {
  const auto library = native::library_of(text, "a test");
  return reinterpret_cast<double (*)()>(library->symbol("pfaff_test"))();
}
std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
ino_t number_of(const fs::path& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

// A bit of every part of the file, among them the code itself; and the file cut anywhere.
TEST_F(LibraryCache, WhatIsDamagedIsMadeAnewBeforeItIsLoaded) {
  ASSERT_EQ(value_of(code), 0.5);
  const fs::path library = kept(".so");
  const std::string whole = bytes_of(library);
  const auto damaged = [&](const std::string& bytes) {
    // In place, as a disk does it, and in the file that is kept.
    std::ofstream(library, std::ios::binary | std::ios::trunc) << bytes;
    const ino_t before = number_of(library);
    EXPECT_EQ(value_of(code), 0.5);
    EXPECT_NE(number_of(library), before) << "loaded as it was";
    EXPECT_EQ(bytes_of(library), whole);
  };
  for (const std::size_t at : {std::size_t{5}, whole.size() / 4, whole.size() / 2, whole.size() - 1}) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    damaged(bytes);
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1})
    damaged(whole.substr(0, size));
  // The control: what is whole is kept.
  const ino_t before = number_of(library);
  EXPECT_EQ(value_of(code), 0.5);
  EXPECT_EQ(number_of(library), before);
}

TEST_F(LibraryCache, ALibraryWithoutItsTextIsNotTrusted) {
  ASSERT_EQ(value_of(code), 0.5);
  const std::string text = bytes_of(kept(".cpp"));
  // A text whose last line, the checksum, is missing, as one of a former version or a cut one.
  for (const std::string& other : {std::string(), text.substr(0, text.rfind("//")), text + "\n"}) {
    std::ofstream(kept(".cpp"), std::ios::binary | std::ios::trunc) << other;
    // A library and the next one exist side by side until the one takes the place of the other, so that their
    // numbers differ. The number of the first may be given again to the third.
    const ino_t before = number_of(kept(".so"));
    EXPECT_EQ(value_of(code), 0.5);
    EXPECT_EQ(bytes_of(kept(".cpp")), text);
    EXPECT_NE(number_of(kept(".so")), before) << "loaded as it was";
  }
}

TEST_F(LibraryCache, WhatAKilledProgramLeftIsRemoved) {
  ASSERT_EQ(value_of(code), 0.5);
  for (const char* name : {"making-abandoned", "making-in-use"}) {
    fs::create_directory(folder() / name);
    std::ofstream(folder() / name / "formulas.so") << "half a library";
  }
  const int in_use = open((folder() / "making-in-use").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(in_use, LOCK_EX), 0);
  EXPECT_EQ(value_of(code), 0.5);
  EXPECT_FALSE(fs::exists(folder() / "making-abandoned"));
  EXPECT_TRUE(fs::exists(folder() / "making-in-use/formulas.so"));
  close(in_use);
  EXPECT_EQ(value_of(code), 0.5);
  EXPECT_EQ(names(), (std::set<std::string>{".cpp", ".so"}));
}

// A compiler that fails leaves its messages, and they go when it succeeds.
TEST_F(LibraryCache, OnlyMessagesAreLeftOfAFailure) {
  setenv("CXX", "false", 1);
  EXPECT_THROW((void)value_of(code), RunError);
  EXPECT_EQ(names(), std::set<std::string>{".log"});
  unsetenv("CXX");
  EXPECT_EQ(value_of(code), 0.5);
}

// The start-up code of -ffast-math flushes subnormals in the whole process, and its arithmetic is another
// one.
TEST_F(LibraryCache, TheUsersWordsForTheCompilerDoNotChangeTheArithmetic) {
  for (const char* words : {"c++ -ffast-math", "c++ -Ofast", "c++ -funsafe-math-optimizations"}) {
    setenv("CXX", words, 1);
    // (x + y) - x is y only where it is reordered.
    const auto library = native::library_of(
        "extern \"C\" double pfaff_test(double x, double y) { return (x + y) - x; }\n", words);
    const auto function = reinterpret_cast<double (*)(double, double)>(library->symbol("pfaff_test"));
    EXPECT_EQ(function(1, 1e-17), 0) << words;
    volatile double tiny = DBL_MIN;
    tiny = tiny / 4;
    EXPECT_GT(tiny, 0) << words;
  }
}

}  // namespace
