#include "tasks/calibrate_cell/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mrroc::calibrate_cell {

Bases corrected(const Bases& believed, const Calibration& found) {
  return {believed[0], believed[0] * found.T_12.T_AB};
}

std::string as_toml(const Bases& bases, const std::array<ecp::ForceTool, kArms>& tools,
                    const std::array<std::string, kArms>& sets, const std::string& run) {
  std::string text = fmt::format(
      "# Where the arms stand and what their tools weigh, as calibrate_cell found it.\n"
      "# ./run rubik --config {}; a task leaves out what it has no use for.\n\n[calibration]\nrun = '{}'\n",
      kResultFile, run);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const AngleAxisPose place = angle_axis_from_pose(bases[arm]);
    text += fmt::format("\n[cell.robots.{}]\nplace = [{:.7f}]\n", kKeys[arm],
                        fmt::join(place.data(), place.data() + place.size(), ", "));
    if (!sets[arm].empty())
      text += fmt::format("\n[robots.{}]\nkinematics = \"{}\"\n", kKeys[arm], sets[arm]);
    text += fmt::format("\n[robots.{}.tool]\nweight = {:.3f}\nmass_centre = [{:.4f}]\n", kKeys[arm],
                        tools[arm].w, fmt::join(tools[arm].P.data(), tools[arm].P.data() + 3, ", "));
  }
  return text;
}

}  // namespace mrroc::calibrate_cell
