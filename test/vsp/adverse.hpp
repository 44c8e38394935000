// Pictures that must not fool a receptor: nothing, too little, or something else than the object is in view.
#pragma once
#include <optional>
#include <random>
#include <string>

#include "test/vsp/plane_camera.hpp"

namespace mrroc::test {

/// One such picture.
struct AdversePicture {
  Image image;
  std::string kind;
  std::optional<Pose> T_CG;  ///< where the object is, if any of it is in the picture
};

/// An endless seeded sequence of them, one kind after the other.
class AdversePictures {
 public:
  /// What is looked for, of which parts, likenesses and damaged ones are shown.
  enum class Object { chessboard, apriltag };

  /// @param rays  for a pixel along either edge; 1 gives the jagged edges of cheap cameras
  AdversePictures(const CameraModel& camera, Object object, unsigned seed, int rays = 1);

  AdversePicture next();
  /// @return a faultless picture of the object where the last one showed something: what a receptor may have seen before
  [[nodiscard]] Image faultless();
  /// @return number of kinds; next() goes through all of them in turn
  static int kinds();

 private:
  using Texture = PlaneCamera::Texture;
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  int pick(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  Pose place(double nearest, double farthest);
  Texture object();
  Texture likeness();
  Texture covered(const Texture& texture);
  Texture scrambled();
  Texture cloth();
  Texture stripes();
  Texture clutter();
  Texture two();
  Texture glare();
  Texture moved();

  /// What the camera is shown, and how.
  struct Shot {
    Pose T;  ///< of the plane in the camera
    Texture texture;
    Exposure exposure;
  };
  /// @return whether this is one of the kinds in which the object is to be seen; otherwise nothing is done
  bool show_object(const std::string& kind, Shot& shot);
  void show_something_else(const std::string& kind, Shot& shot);

  PlaneCamera camera_;
  Object object_;
  std::mt19937 random_;
  Pose last_;
  int number_{};
};

/// @return whether a reading claims what is not so: seen where no object is, or off by more than 2 % of its distance or
///         5 degrees
bool is_false(const CameraReading& reading, const AdversePicture& picture);

}  // namespace mrroc::test
