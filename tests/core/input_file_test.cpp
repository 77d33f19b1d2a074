// Input files: whole where they are regular, and refused before they are opened where they are not.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/input_file.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// What is said of a file that is refused; empty where it is read.
std::string input_refusal(const std::string& path, std::uint64_t longest = longest_input) {
  try {
    (void)read_file(path, longest);
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("cannot read " + path + ": ")) << error.what();
    return error.what();
  }
  return {};
}
bool says(const std::string& refusal, const char* words) { return refusal.find(words) != std::string::npos; }

TEST(InputFile, IsReadWhole) {
  const TemporaryDirectory files;
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 300000U}) {
    std::string bytes(size, '\0');
    for (std::size_t k = 0; k < size; ++k) bytes[k] = static_cast<char>(k * 7);
    std::ofstream(files.path() / "bytes", std::ios::binary) << bytes;
    EXPECT_EQ(read_file(files.path() / "bytes"), bytes);
  }
  fs::create_symlink("bytes", files.path() / "link");
  EXPECT_EQ(read_file(files.path() / "link").size(), 300000U);
  // Files of /proc have no size.
  EXPECT_NE(read_file("/proc/self/status").find("Name:"), std::string::npos);
}

// Nobody ever writes to the pipe: whoever opens it waits for ever.
TEST(InputFile, WhatIsNoRegularFileIsRefused) {
  const TemporaryDirectory files;
  ASSERT_EQ(mkfifo((files / "pipe").c_str(), 0600), 0);
  const int listening = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (files / "socket").c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  fs::create_symlink("pipe", files.path() / "link");
  EXPECT_TRUE(says(input_refusal(files / "pipe"), "it is a pipe; expected a regular file"));
  EXPECT_TRUE(says(input_refusal(files / "link"), "it is a pipe"));
  EXPECT_TRUE(says(input_refusal(files / "socket"), "it is a socket"));
  EXPECT_TRUE(says(input_refusal(files.path().string()), "it is a directory"));
  EXPECT_TRUE(says(input_refusal("/dev/zero"), "it is a device"));
  EXPECT_TRUE(says(input_refusal(files / "missing"), "No such file"));
  close(listening);
}

// A file may have more bytes than the disk has room for.
TEST(InputFile, WhatIsTooLongIsRefused) {
  const TemporaryDirectory files;
  std::ofstream(files.path() / "long") << "x";
  ASSERT_EQ(truncate((files / "long").c_str(), off_t{1} << 40U), 0);
  EXPECT_TRUE(says(input_refusal(files / "long"), "more than 268435456 bytes"));
  std::ofstream(files.path() / "short") << "1234";
  EXPECT_EQ(input_refusal(files / "short", 4), "");
  EXPECT_TRUE(says(input_refusal(files / "short", 3), "more than 3 bytes"));
}

}  // namespace
