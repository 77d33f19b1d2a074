// The ABI stamp as the loader sees it: notes found and compared, damaged files refused, arithmetic left
// alone.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cfloat>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <pfaff/core/registry/abi.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace {
using namespace pfaff;

std::string plugin(const std::string& name) { return std::string(PFAFF_TEST_PLUGINS) + "/" + name + ".so"; }

std::string refusal(const std::string& path) {
  try {
    require_same_abi(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(AbiStamp, EveryTranslationUnitLeavesOne) {
  EXPECT_EQ(abi_stamps(plugin("fits")), std::vector<std::string>{PFAFF_ABI_STAMP});
  EXPECT_EQ(abi_stamps(plugin("two-stamps")).size(), 2U);
  EXPECT_GE(abi_stamps(plugin("templates")).size(), 3U);
  EXPECT_TRUE(abi_stamps(plugin("no-stamp")).empty());
}

TEST(AbiStamp, ARefusalNamesWhatDiffersAndNothingElse) {
  const std::string text = refusal(plugin("fast-math"));
  EXPECT_NE(text.find("built for arithmetic=fast; expected arithmetic=strict"), std::string::npos) << text;
  EXPECT_EQ(text.find("compiler="), std::string::npos) << text;
}

// Neither a crash nor acceptance of half a file: every prefix through the headers and notes, then with bytes
// changed.
TEST(AbiStamp, DamagedFilesAreRefused) {
  std::ifstream file(plugin("other-version"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ASSERT_GT(bytes.size(), 2048U);
  const auto path =
      std::filesystem::temp_directory_path() / ("pfaff-damaged-" + std::to_string(getpid()) + ".so");
  const auto written = [&](const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  };
  for (std::size_t size = 0; size < 2048; size += 7)
    EXPECT_NE(refusal(written(bytes.substr(0, size))), "") << size;
  for (std::size_t at = 16; at < 1024; ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    EXPECT_NE(refusal(written(damaged)), "") << at;
  }
  std::filesystem::remove(path);
}

// A library linked with -ffast-math sets the processor to flush subnormals when it is loaded.
TEST(AbiStamp, LoadingLeavesTheArithmeticAlone) {
  load_plugin(plugin("starts-fast"));
  volatile double tiny = DBL_MIN;
  tiny = tiny / 4;
  EXPECT_GT(tiny, 0);
}

}  // namespace
