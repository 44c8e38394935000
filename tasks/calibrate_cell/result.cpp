#include "tasks/calibrate_cell/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

namespace mrroc::calibrate_cell {
namespace {

std::string pose_text(const Pose& T) {
  const AngleAxisPose r = angle_axis_from_pose(T);
  return fmt::format("[{:.7f}]", fmt::join(r.data(), r.data() + r.size(), ", "));
}

std::string as_comment(const std::string& text) {
  std::string lines, line;
  for (std::istringstream in(text); std::getline(in, line);) lines += "# " + line + "\n";
  return lines;
}

std::string names_of(const std::vector<CameraPlace>& cameras) {
  std::string names;
  for (const CameraPlace& camera : cameras) names += (names.empty() ? "\"" : ", \"") + camera.key + "\"";
  return names;
}

}  // namespace

Bases corrected(const Bases& believed, const Pose& T_12) { return {believed[0], believed[0] * T_12}; }

std::string as_toml(const CellResult& found, const std::string& run) {
  std::string text = fmt::format(
      "# Where arms and cameras are and what the tools weigh, as calibrate_cell found it.\n"
      "# ./run rubik --config {}; a task leaves out what it has no use for.\n{}\n[calibration]\nrun = '{}'\n"
      "robots = [\"{}\"]\ncameras = [{}]\n",
      kResultFile, as_comment(found.ways), run, fmt::join(kKeys, "\", \""), names_of(found.cameras));
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    text += fmt::format("\n[cell.robots.{}]\nplace = {}\n", kKeys[arm], pose_text(found.bases[arm]));
    if (!found.sets[arm].empty())
      text += fmt::format("\n[robots.{}]\nkinematics = \"{}\"\n", kKeys[arm], found.sets[arm]);
    text += fmt::format("\n[robots.{}.tool]\nweight = {:.3f}\nmass_centre = [{:.4f}]\n", kKeys[arm],
                        found.tools[arm].w,
                        fmt::join(found.tools[arm].P.data(), found.tools[arm].P.data() + 3, ", "));
  }
  for (const CameraPlace& camera : found.cameras)
    text += fmt::format("\n[cell.cameras.{}]\npose = {}\n", camera.key, pose_text(camera.pose));
  return text;
}

}  // namespace mrroc::calibrate_cell
