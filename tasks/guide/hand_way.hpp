// The way that a simulated operator wants to lead the tool: to the fixture, along it while he pushes across and against its ends.
#pragma once
#include <vector>

#include "mp/hand_file.hpp"
#include "tasks/guide/config.hpp"

namespace mrroc::guide {

using mp::WayPoint;

/// @return a point every 10 ms. From off the fixture onto it, a rest until the fixture holds; along it to both ends and half
///         back, or once and a half around a curve without ends, or once over a plane; a rest at the end. On the way his hand
///         is off the fixture by as much as the push takes, in a direction that turns.
[[nodiscard]] std::vector<WayPoint> hand_way(const Setup& k, const OperatorPlan& plan);

}  // namespace mrroc::guide
