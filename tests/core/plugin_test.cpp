// The ABI stamp as the plug-in loader reads it: stamps are found and compared, and damaged files are refused.
// Loading does not change the floating-point arithmetic of the program.
#include <gtest/gtest.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cfloat>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <pfaff/core/registry/abi.hpp>
#include <pfaff/core/registry/registry.hpp>

#include "../built.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::test_plugin;

std::string abi_refusal(const std::string& path) {
  try {
    require_same_abi(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(AbiStamp, EveryTranslationUnitLeavesOne) {
  EXPECT_EQ(abi_stamps(test_plugin("fits")), std::vector<std::string>{own_abi_stamp()});
  EXPECT_EQ(abi_stamps(test_plugin("two-stamps")).size(), 2U);
  EXPECT_GE(abi_stamps(test_plugin("templates")).size(), 3U);
  EXPECT_TRUE(abi_stamps(test_plugin("no-stamp")).empty());
}

TEST(AbiStamp, ARefusalNamesWhatDiffersAndNothingElse) {
  const std::string text = abi_refusal(test_plugin("fast-math"));
  EXPECT_NE(text.find("built for arithmetic=fast; expected arithmetic=strict"), std::string::npos) << text;
  EXPECT_EQ(text.find("compiler="), std::string::npos) << text;
}

// Neither a crash nor acceptance of half a file: every prefix through the headers and notes, then with bytes
// changed.
TEST(AbiStamp, DamagedFilesAreRefused) {
  std::ifstream file(test_plugin("other-version"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ASSERT_GT(bytes.size(), 2048U);
  const auto path =
      std::filesystem::temp_directory_path() / ("pfaff-damaged-" + std::to_string(getpid()) + ".so");
  const auto written = [&](const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  };
  for (std::size_t size = 0; size < 2048; size += 7)
    EXPECT_NE(abi_refusal(written(bytes.substr(0, size))), "") << size;
  for (std::size_t at = 16; at < 1024; ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    EXPECT_NE(abi_refusal(written(damaged)), "") << at;
  }
  std::filesystem::remove(path);
}

// A segment behind the end of the file can be mapped and not read: the loader, or the first call, would die
// of it.
TEST(AbiStamp, FilesThatAreCutOffAreRefused) {
  std::ifstream file(test_plugin("fits"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::uint64_t segments_end = 0;
  ElfW(Ehdr) header;
  std::memcpy(&header, bytes.data(), sizeof header);
  for (std::size_t k = 0; k < header.e_phnum; ++k) {
    ElfW(Phdr) segment;
    std::memcpy(&segment, bytes.data() + header.e_phoff + k * sizeof segment, sizeof segment);
    if (segment.p_type == PT_LOAD)
      segments_end = std::max<std::uint64_t>(segments_end, segment.p_offset + segment.p_filesz);
  }
  ASSERT_GT(segments_end, 2048U);
  ASSERT_LT(segments_end, bytes.size());
  const auto path =
      std::filesystem::temp_directory_path() / ("pfaff-cut-off-" + std::to_string(getpid()) + ".so");
  const auto cut = [&](std::size_t size) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, size);
    return abi_refusal(path.string());
  };
  for (std::size_t size = 64; size < segments_end; size += 509) EXPECT_NE(cut(size), "") << size;
  EXPECT_NE(cut(segments_end - 1).find("is cut off or damaged"), std::string::npos);
  // The controls: with all of its segments, and whole, it is accepted.
  EXPECT_EQ(cut(segments_end), "");
  EXPECT_EQ(cut(bytes.size()), "");
  // Sizes that overflow when they are added.
  std::string damaged = bytes;
  ElfW(Phdr) segment;
  std::memcpy(&segment, damaged.data() + header.e_phoff, sizeof segment);
  segment.p_offset = ~std::uint64_t{0} - 8;
  segment.p_filesz = 16;
  std::memcpy(damaged.data() + header.e_phoff, &segment, sizeof segment);
  std::ofstream(path, std::ios::binary) << damaged;
  EXPECT_NE(abi_refusal(path.string()).find("is cut off or damaged"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(AbiStamp, OnlyFilesAreOpened) {
  EXPECT_NE(abi_refusal("/dev/zero").find("is no regular file"), std::string::npos);
  EXPECT_NE(abi_refusal("/tmp").find("is no regular file"), std::string::npos);
  EXPECT_NE(abi_refusal("/missing.so").find("cannot be read"), std::string::npos);
}

// The words by which the flags -fshort-enums, -fpack-struct and -funsigned-char show.
TEST(AbiStamp, SaysHowTypesAreLaidOut) {
  const std::string stamp = own_abi_stamp();
  for (const char* word : {" char=", " enum=4", " packing=8"})
    EXPECT_NE(stamp.find(word), std::string::npos) << stamp;
  EXPECT_EQ(stamp.find('?'), std::string::npos) << stamp;
}

// A library linked with -ffast-math sets the processor to flush subnormals when it is loaded.
TEST(AbiStamp, LoadingLeavesTheArithmeticAlone) {
  load_plugin(test_plugin("starts-fast"));
  volatile double tiny = DBL_MIN;
  tiny = tiny / 4;
  EXPECT_GT(tiny, 0);
}

}  // namespace
