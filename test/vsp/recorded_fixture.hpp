// A receptor that tells of a picture what its first pixel shows, and a folder of small pictures for the
// receptors' tool.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "vsp/picture_file.hpp"
#include "vsp/recorded.hpp"

namespace mrroc::test::recorded {

inline constexpr int kWidth = 64, kHeight = 48;

inline CameraModel small_camera() {
  CameraModel camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fx = camera.fy = 60;
  camera.cx = 31.5;
  camera.cy = 23.5;
  return camera;
}

inline vsp::ObjectShape cross(const Config& /*config*/) { return {{{0, 0, 0}}, {}, 0.1}; }

/// Sees something in pictures that are not black; how far away is what its number says.
inline CameraReading reading_of(const ImageView& picture, std::int64_t frame, std::int64_t step) {
  CameraReading r;
  r.frame = frame;
  r.step = step;
  r.seen = picture.at(0, 0, 0) > 100;
  r.T_CG.p = {0, 0, 1 + 0.1 * static_cast<double>(step)};
  return r;
}

inline vsp::ImageReceptor pixel_receptor() {
  return {"vsp_pixel", "Looks at one pixel.", "pixel", cross,
          [](const CameraModel& /*camera*/, const Config& /*config*/) { return reading_of; }};
}

/// The same as a tool, which says of every picture how far away.
inline vsp::RecordedTool pixel_tool() {
  return {"vsp_pixel", "Looks at one pixel.", cross,
          [](const CameraModel& /*camera*/, const Config& /*config*/, const std::string& key) {
            return [key](const ImageView& picture, std::int64_t number, const std::string& source) {
              const CameraReading r = reading_of(picture, number, number);
              return vsp::RecordedAnswer{{{"key", key}, {"source", source}}, r, r.seen ? "far" : ""};
            };
          }};
}

inline Image plain(int grey) {
  Image picture(kWidth, kHeight, 3);
  std::ranges::fill(picture.data, static_cast<std::uint8_t>(grey));
  return picture;
}

/// A folder of pictures, the camera's file, and both ways to run a tool on them.
class Recorded : public testing::Test {
 protected:
  Recorded()
      : folder_(std::filesystem::temp_directory_path() / ("mrroc_recorded_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_ / "in");
    write_camera("web");
  }
  ~Recorded() override { std::filesystem::remove_all(folder_); }

  void write_camera(const std::string& key) {
    std::ofstream(folder_ / "camera.toml", std::ios::app)
        << "[cameras." << key << "]\nwidth = 64\nheight = 48\nfx = 60\nfy = 60\ncx = 31.5\ncy = 23.5\n";
  }
  void write(const std::string& name, int grey) {
    vsp::write_picture(folder_ / "in" / name, plain(grey).view());
  }

  std::string printed(const vsp::RecordedTool& tool, const vsp::RecordedRun& run) {
    char* text{};
    std::size_t size{};
    std::FILE* const out = open_memstream(&text, &size);
    try {
      vsp::run_recorded(tool, run, out);
    } catch (...) {
      std::fclose(out);
      std::free(text);  // NOLINT
      throw;
    }
    std::fclose(out);
    std::string all(text, size);
    std::free(text);  // NOLINT
    return all;
  }
  std::vector<nlohmann::json> lines(const vsp::RecordedTool& tool, const vsp::RecordedRun& run) {
    std::vector<nlohmann::json> all;
    std::istringstream stream(printed(tool, run));
    for (std::string line; std::getline(stream, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  std::string refusal(const vsp::RecordedRun& run, FaultCode code) {
    try {
      printed(pixel_tool(), run);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, code);
      return e.what();
    }
    return "";
  }
  vsp::RecordedRun order() { return {folder_ / "in", folder_ / "camera.toml", "", {}, {}}; }

  /// Runs a program's main function. @return its exit status; what it printed is in out_ and err_
  int main_of(std::vector<std::string> words, const std::function<int(int, char**)>& program) {
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = program(static_cast<int>(words.size()), argv.data());
    std::fflush(stdout);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return status;
  }
  int receptor(const std::vector<std::string>& words, const vsp::ImageReceptor& what = pixel_receptor()) {
    std::vector<std::string> all{"vsp_pixel"};
    all.insert(all.end(), words.begin(), words.end());
    return main_of(all, [&](int argc, char** argv) { return vsp::receptor_main(argc, argv, what); });
  }
  std::string in() const { return (folder_ / "in").string(); }
  std::string camera() const { return (folder_ / "camera.toml").string(); }

  std::filesystem::path folder_;
  std::string out_, err_;
};

}  // namespace mrroc::test::recorded
