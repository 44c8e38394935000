// How a receptor's program ends that works on recorded pictures.
#pragma once
#include <functional>

namespace mrroc::vsp {

/// Does the work of a program.
/// @return its exit status; when it throws, that of the fault, which is told on the standard error. What is no fault comes from
///         OpenCV, and is bad_picture
[[nodiscard]] int recorded_status(const std::function<int()>& work);

}  // namespace mrroc::vsp
