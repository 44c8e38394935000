// The configuration of the pair of test/vsp/stereo_room.hpp.
#pragma once
#include <fmt/core.h>

#include <string>

#include "base/pose.hpp"
#include "test/vsp/stereo_room.hpp"

namespace mrroc::test {

/// @return [cameras.KEY] at stereo_place(side)
inline std::string stereo_camera_text(const std::string& key, double side) {
  const AngleAxisPose p = angle_axis_from_pose(stereo_place(side));
  return fmt::format(
      "[cameras.{}]\nmount = \"rex\"\npose = [{}, {}, {}, {}, {}, {}]\nfx = 420.0\nperiod = 40\nlatency = "
      "40\n",
      key, p[0], p[1], p[2], p[3], p[4], p[5]);
}

/// @return [odometry.rex] with both cameras
inline std::string stereo_text() {
  return "[odometry.rex]\nleft = \"rex_left\"\nright = \"rex_right\"\n" +
         stereo_camera_text("rex_left", 0.06) + stereo_camera_text("rex_right", -0.06);
}

/// @return the text with the last place of `from` exchanged, which must be there
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.rfind(from), from.size(), to);
}

}  // namespace mrroc::test
