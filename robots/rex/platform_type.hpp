// The entry of Rex in the list of platforms.
#pragma once
#include <string_view>

#include "robots/platforms.hpp"

namespace mrroc::rex {

/// @return its description
std::string_view urdf();

/// @return Rex; lives to the end of the program
const robots::PlatformType& type();

}  // namespace mrroc::rex
