// The picture of a contact: the force of arm 1 over time, like MG fig. 16.
#pragma once
#include <vector>

#include "launch/evaluation.hpp"

namespace mrroc::launch {

/// @return the force of arm 1 along an axis of E over time, and the force desired [N]
std::vector<Picture> force_picture(Axis axis, double desired);
/// The same for Evaluation::pictures.
template <Axis axis, int desired>
std::vector<Picture> force_picture(const std::vector<mp::ArmTrace>&, const Config&) {
  return force_picture(axis, desired);
}
/// @param desired  reads the force desired from the configuration [N]
template <Axis axis, double (*desired)(const Config&)>
std::vector<Picture> force_picture(const std::vector<mp::ArmTrace>&, const Config& config) {
  return force_picture(axis, desired(config));
}

}  // namespace mrroc::launch
