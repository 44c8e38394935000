// The two IRb-6 arms as entries of the catalogue of robots.
#pragma once
#include "robots/catalogue.hpp"

namespace mrroc::irb6 {

/// @return the arm on the pedestal, "irb6_postument"
const robots::RobotType& postument();
/// @return the arm on the track, "irb6_track"
const robots::RobotType& track();

/// @return their descriptions; the build puts them into the library
std::string_view postument_urdf();
std::string_view track_urdf();

}  // namespace mrroc::irb6
