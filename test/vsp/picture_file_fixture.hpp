// Files of pictures in a folder of their own, with the refusals of damaged ones.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/recorded.hpp"

namespace mrroc::test {

/// A folder for pictures, and the receptor of the chessboard that looks at them.
class PictureFileTest : public testing::Test {
 protected:
  PictureFileTest()
      : folder_(std::filesystem::temp_directory_path() / ("mrroc_pictures_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~PictureFileTest() override { std::filesystem::remove_all(folder_); }

  static Image board_picture(double roll) {
    return web_plane_camera().render(facing(0.6, 0.3, 0.4, roll), chessboard_texture(9, 6, 0.025, 0.025));
  }
  static std::string refusal(const std::function<void()>& action, FaultCode code = FaultCode::bad_picture) {
    try {
      action();
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, code);
      EXPECT_EQ(exit_status(e.fault().code), code == FaultCode::cannot_write ? 3 : 2);
      return e.what();
    }
    return "";
  }
  std::filesystem::path camera_file() {
    std::filesystem::path file = folder_ / "camera.toml";
    std::ofstream(file) << "[cameras.web]\nfx = 600\ndistortion = [-0.28, 0.09, 0.0006, -0.0004, 0]\n";
    return file;
  }
  std::vector<nlohmann::json> run(const vsp::RecordedRun& order) {
    const std::filesystem::path out = folder_ / "out.txt";
    std::FILE* const file = std::fopen(out.c_str(), "w");
    try {
      vsp::run_recorded(vsp::chessboard_receptor(), order, file);
    } catch (...) {
      std::fclose(file);
      throw;
    }
    std::fclose(file);
    std::vector<nlohmann::json> lines;
    std::ifstream stream(out);
    for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }
  std::filesystem::path folder_;
};

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}
inline std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace mrroc::test
