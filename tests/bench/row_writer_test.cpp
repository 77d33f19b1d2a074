// Rows are passed on whole, in order and once, whatever their length and however the table ends.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <pfaff/bench/runner/row_file.hpp>
#include <pfaff/bench/runner/row_writer.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/core/process/input_file.hpp>

#include "../temporary_directory.hpp"

namespace pfaff {
namespace {

TEST(RowWriter, PassesOnWholeRows) {
  std::vector<std::string> parts;
  std::string expected;
  {
    RowWriter rows([&](std::string_view part) { parts.emplace_back(part); });
    rows.text("t"), rows.text("x"), rows.end_row();
    EXPECT_EQ(parts.size(), 1U);  // the first row at once
    expected = "t,x\n";
    for (int k = 0; k < 30000; ++k) {
      rows.number(double(k)), rows.text(""), rows.end_row();
      expected += std::to_string(k) + ",\n";
    }
    rows.text("half a row");
    rows.flush();
    rows.text("and its end"), rows.end_row();
    expected += "half a row,and its end\n";
    // Longer than the buffer at first.
    const std::string wide(std::size_t{1} << 20U, 'x');
    rows.text(wide), rows.text(wide), rows.end_row();
    expected += wide + "," + wide + "\n";
    rows.text("never ended");
  }
  std::string all;
  for (const std::string& part : parts) {
    ASSERT_TRUE(part.ends_with('\n'));
    all += part;
  }
  EXPECT_TRUE(all == expected) << all.size() << " bytes, not " << expected.size();
}

TEST(RowWriter, WaitsNotLong) {
  std::string all;
  RowWriter rows([&](std::string_view part) { all += part; });
  rows.text("head"), rows.end_row();
  rows.text("1"), rows.end_row();
  std::this_thread::sleep_for(std::chrono::milliseconds(250));  // it waits for 200
  rows.text("2"), rows.end_row();
  EXPECT_EQ(all, "head\n1\n2\n");
}

// Rows that could not be written are not tried again when the table is left.
TEST(RowWriter, WhatTheDestinationThrowsIsPassedOnce) {
  int calls = 0;
  {
    RowWriter rows([&](std::string_view) {
      ++calls;
      throw std::runtime_error("full");
    });
    rows.text("head");
    EXPECT_THROW(rows.end_row(), std::runtime_error);
  }
  EXPECT_EQ(calls, 1);
}

TEST(RowFile, KeepsItsRowsAndKnowsTheirChecksum) {
  const testing::TemporaryDirectory files;
  const std::filesystem::path path = files.path() / "rows.csv";
  {
    RowFile file(path);
    file.take("head\n1\n");
    EXPECT_EQ(read_file(path), "head\n1\n");
    file.take("2\n");
    file.finish();
    EXPECT_EQ(file.checksum(), sha1_of("head\n1\n2\n"));
  }
  EXPECT_EQ(read_file(path), "head\n1\n2\n");
  RowFile file(path);
  file.take("head\n1\n");
  std::filesystem::remove(path);
  try {
    file.take("2\n3\n");
    ADD_FAILURE() << "wrote into a file that is not there";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("3 rows were written"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pfaff
