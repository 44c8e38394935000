// The interface of all virtual receptors of objects (VS 35-42): a picture in, a reading out.
#pragma once
#include <concepts>
#include <cstdint>

#include "base/camera.hpp"
#include "base/image.hpp"

namespace mrroc::vsp {

/// Interface of an image sensor's kernel. It may remember where the object was; what it returns is a function
/// of its parameters and of the pictures that it has been given, with a bound on the work for any picture.
template <class S>
concept ImageSensor = requires(S s, const ImageView& picture, std::int64_t frame, std::int64_t step) {
  { s.detect(picture, frame, step) } -> std::same_as<CameraReading>;
};

}  // namespace mrroc::vsp
