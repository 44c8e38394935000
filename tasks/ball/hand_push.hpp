// A person who pushes one arm while both carry the object.
#pragma once
#include <cstddef>

#include "base/spatial.hpp"

namespace mrroc::ball {

/// The push of a simulated hand.
struct HandPush {
  std::size_t arm{};       ///< that is pushed
  Vector3 force{8, 6, 0};  ///< in the world [N]
  int begin{200};          ///< macrosteps around the circle until the hand pushes
  int duration{200};       ///< macrosteps
};

}  // namespace mrroc::ball
