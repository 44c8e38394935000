// Commands to the simulated operator's hand.
#pragma once
#include <cstdint>

namespace mrroc {

/// Action of the hand at one arm.
enum class HandAction : std::uint8_t {
  release,     ///< lets the pen go
  lead_along,  ///< leads the pen along the drawing of the configuration
  lead_to,     ///< leads the pen to a point above the sheet and holds it there
  follow,      ///< leads the tool through the air along the track of the configuration, with its times
  push,        ///< pushes the tool with a constant force, wherever it goes
};

}  // namespace mrroc
