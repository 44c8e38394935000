// Which pushes bring the box from one pose to another.
#pragma once
#include <optional>
#include <vector>

#include "base/room_config.hpp"
#include "tasks/box_push/formation.hpp"
#include "tasks/box_push/steering.hpp"

namespace mrroc::box_push {

/// One push: from that side until the box is at that pose.
struct Push {
  Side side{};
  PlanarPose to;
};
using Pushes = std::vector<Push>;

/// What is known of the place where boxes are pushed.
struct Hall {
  Formation formation;  ///< of box and pair
  SteeringLimits steering;
  Room room;           ///< that ends somewhere, with obstacles
  double reach{0.55};  ///< room that a platform needs around its middle [m]
};

/// @return whether the box can stand there, and the pair before that side of it, also where its platforms turn
[[nodiscard]] bool has_room(const Hall& hall, Side side, const PlanarPose& box);

/// @return the pushes of the shortest way, where another push costs as much as some way; at most kMostPushes. None when
///         there are none
[[nodiscard]] std::optional<Pushes> plan_pushes(const Hall& hall, const PlanarPose& box,
                                                const PlanarPose& goal);
inline constexpr int kMostPushes = 5;

}  // namespace mrroc::box_push
