// Rooms that nobody tuned the odometry to, and how it does there.
#pragma once
#include <string>
#include <vector>

#include "test/vsp/stereo_room.hpp"

namespace mrroc::test {

/// A room, and what is hard in it.
struct HardRoom {
  std::string name;
  RoomLook look;
};

/// @return rooms with little to see, light, noise, and cameras that are not as they are believed to be; all of one seed
std::vector<HardRoom> hard_rooms(unsigned seed);

/// What the odometry has made of a room.
struct HardRoomResult {
  int pairs{};  ///< that could have a motion
  int valid{};  ///< of them, those that have one
  int wrong{};  ///< of these, those whose error in the plane is beyond 99.9 % of their own covariance
  int misleading{};  ///< the same of what an estimator counts with, that allows for 4 % of the way, 0.5 mm and 0.15 mrad
  double nees{};        ///< mean square of the error in the plane in its own covariance: 3, if that is honest
  double worst_mm{};    ///< largest error of the place of a valid motion
  double worst_mrad{};  ///< the same of the turn
  double
      drift_pct{};  ///< error of the place at the end of each speed against the way, mean of those with ways
};

/// Drives on a circle about the middle at 0.3, 0.6, 1 and 1.3 m/s, then turns on the spot at 1.6 rad/s; at most 5 m/s^2 in between.
/// @param pairs  of pictures at each speed
HardRoomResult drive_through(const HardRoom& room, int pairs);

}  // namespace mrroc::test
