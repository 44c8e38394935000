// Checks that every number of a message that enters a computation is finite. Messages come from the network;
// one NaN would spread to everything.
#pragma once
#include <algorithm>
#include <cmath>
#include <iterator>

#include "mrroc/agent_report_t.hpp"
#include "mrroc/camera_reading_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/step_sample_t.hpp"

namespace mrroc {

/// @return whether all numbers are finite. Real-time safe
template <std::size_t N>
bool finite(const double (&numbers)[N]) noexcept {
  return std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return std::isfinite(x); });
}
template <std::size_t N, std::size_t M>
bool finite(const double (&rows)[N][M]) noexcept {
  return std::all_of(std::begin(rows), std::end(rows), [](const auto& row) { return finite(row); });
}
/// @return whether pose, force and gripper are finite
inline bool finite(const agent_report_t& m) noexcept {
  return finite(m.T_0E) && finite(m.F_a) && std::isfinite(m.gripper);
}
/// @return whether what was measured is finite
inline bool finite(const effector_reply_t& m) noexcept {
  return finite(m.pose) && finite(m.T_0E) && finite(m.F_a) && finite(m.joints) && finite(m.motors) &&
         std::isfinite(m.gripper);
}
/// @return the same: such a reply can be used
inline bool is_proper(const effector_reply_t& m) noexcept { return finite(m); }
/// @return whether all numbers of the message are finite
inline bool finite(const step_sample_t& m) noexcept { return finite(m.T_0E) && finite(m.F_a); }
inline bool finite(const camera_reading_t& m) noexcept {
  return finite(m.T_CG) && finite(m.covariance) && std::isfinite(m.reprojection_px);
}
inline bool finite(const hand_order_t& m) noexcept { return finite(m.x) && finite(m.y) && finite(m.height); }

}  // namespace mrroc
