// Computations of c_1's behaviours (VS 3.5): errors, their aggregation and the effector's displacement.
#pragma once
#include "tasks/visual_servo/images.hpp"

namespace mrroc::visual_servo {

/// P(x_r): whether a camera sees the object: its last reading is valid and not older than max_age frames beyond the
/// latency, at the step of x_ce.
[[nodiscard]] bool sees(const Arm::X& x, Camera camera);

/// The object's estimate still holds, though no picture may be believed: the last one is no older than the track's memory, at the
/// step of x_ce.
[[nodiscard]] bool remembers(const Arm::X& x);

/// @return frames that max_age can be: for every camera that is used it is known where E was so long ago
[[nodiscard]] int longest_age(const Parameters& k);
/// @return how long ago a camera's newest picture was taken, at the step of x_ce; without one, since the task began
///         [steps]
[[nodiscard]] std::int64_t age_of_picture(const Arm::X& x, Camera camera);
/// @return age up to which a camera's picture is believed [steps]
[[nodiscard]] std::int64_t oldest_believed(const Parameters& k, Camera camera);

/// The driver has refused the displacement that it was told, or could not make all of it, and the arm comes to rest. The task
/// goes on: the next ones are slower.
[[nodiscard]] bool not_made(const Arm::X& x);
/// Displacements in a row that are not made, after which the task is given up.
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

/// The same of the estimate from earlier pictures, for behaviours that go by none.
[[nodiscard]] CameraError error_of(const Parameters& k, const ObjectTrack& track, const Start& start,
                                   const ObjectMotion& motion);

/// Conclusions of c_1 from x_c.
struct Conclusion {
  ObjectTrack track;                         ///< with the pictures that are new
  std::array<std::int64_t, kCameras> taken;  ///< as Memory
  std::array<bool, kCameras> sees;           ///< P(x_r) of each camera
  /// Aggregated error E T_d,c of the cameras that the behaviour uses; without any, of what is remembered; else identity.
  Pose e;
  Pose T_dc;    ///< E T_d,c': the effector's displacement; identity where e is none
  double ease;  ///< as Memory
  int refused;  ///< as Memory
};

/// Pure: f_cc and f_ce are made of it.
/// @param uses  the cameras whose errors count
[[nodiscard]] Conclusion conclude(const Arm::X& x, const std::array<bool, kCameras>& uses);

}  // namespace mrroc::visual_servo
