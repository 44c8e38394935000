#include "base/build_id.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "base/program.hpp"

namespace mrroc {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class BuildId : public ::testing::Test {
 protected:
  BuildId() {
    std::string pattern = (fs::temp_directory_path() / "build-id-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~BuildId() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(BuildId, IsThatOfTheFileAndNotOfItsPlace) {
  const std::string id = build_id(this_program());
  EXPECT_GE(id.size(), 16U);
  EXPECT_TRUE(std::ranges::all_of(id, [](unsigned char c) { return std::isxdigit(c) != 0; })) << id;
  fs::copy_file(this_program(), folder_ / "copy");
  EXPECT_EQ(build_id(folder_ / "copy"), id);
}

TEST_F(BuildId, WhatIsNoProgramHasNone) {
  EXPECT_EQ(build_id(folder_ / "missing"), "");
  EXPECT_EQ(build_id(folder_), "");
  std::ofstream(folder_ / "text") << "#!/bin/sh\n";
  EXPECT_EQ(build_id(folder_ / "text"), "");
}

TEST_F(BuildId, AFileThatWasCutOffOrDamagedIsReadToItsEnd) {
  const std::string whole = bytes_of(this_program()).substr(0, 4096);
  for (std::size_t size = 0; size < 2048; size += 7) {
    std::ofstream(folder_ / "cut", std::ios::binary) << whole.substr(0, size);
    std::string damaged = whole;
    damaged[size] = static_cast<char>(~damaged[size]);
    std::ofstream(folder_ / "damaged", std::ios::binary) << damaged;
    std::ignore = build_id(folder_ / "cut");
    std::ignore = build_id(folder_ / "damaged");
  }
}

}  // namespace
}  // namespace mrroc
