// What the behaviours of c_1 compute (VS 3.5): errors, their aggregation and the effector's displacement.
#pragma once
#include "tasks/visual_servo/images.hpp"

namespace mrroc::visual_servo {

/// P(x_r): whether a camera sees the object: its last reading is valid and not older than max_age frames beyond the
/// latency, at the step of x_ce.
[[nodiscard]] bool sees(const Arm::X& x, Camera camera);

/// The driver could not do what it was told - too fast for its motors, or beyond its reach - and the arm comes to rest
/// instead. It is told again in the next control step, more slowly.
[[nodiscard]] bool asked_too_much(const Arm::X& x);
/// Refusals in a row after which that is a fault.
inline constexpr int kMostRefusals = 50;

/// The pose of the object that a camera saw, in the base, and with what uncertainty.
[[nodiscard]] Sighting sighting(const Arm::X& x, Camera camera);

/// The instant for which a command is made: when its motion begins [step], and where E is then.
struct Start {
  std::int64_t step{};  ///< of the effector driver
  Pose T_0E;            ///< measured, and carried on by the displacements that are commanded already
};
/// @return start of the command that is decided on x
[[nodiscard]] Start start_of_command(const Arm::X& x);

/// (49), (51): e of one camera at the start of the command. The object goes on with its velocity from the image's
/// instant until then.
[[nodiscard]] CameraError error_of(const Arm::X& x, Camera camera, const Start& start,
                                   const ObjectMotion& motion);

/// What c_1 concludes from x_c.
struct Conclusion {
  ObjectTrack track;                         ///< with the pictures that are new
  std::array<std::int64_t, kCameras> taken;  ///< as Memory
  std::array<bool, kCameras> sees;           ///< P(x_r) of each camera
  Pose e;       ///< aggregated error E T_d,c of the cameras that the behaviour uses; identity without any
  Pose T_dc;    ///< E T_d,c': the effector's displacement; identity without any
  double ease;  ///< as Memory
  int refused;  ///< as Memory
};

/// Pure: f_cc and f_ce are made of it.
/// @param uses  the cameras whose errors count
[[nodiscard]] Conclusion conclude(const Arm::X& x, const std::array<bool, kCameras>& uses);

}  // namespace mrroc::visual_servo
