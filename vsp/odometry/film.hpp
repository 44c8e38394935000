// The film of a platform's odometry: pictures of the left camera with the points that the motion rests on.
#pragma once
#include <filesystem>
#include <string>

#include "base/config.hpp"
#include "vsp/annotate.hpp"
#include "vsp/odometry/stereo_odometry.hpp"

namespace mrroc::vsp {

/// Draws what the odometry saw, for people: how points have moved since the pair before, green those that agree on the motion, yellow
/// others, and their numbers; or why nothing was measured, in a red frame.
/// @param picture  the left one of the second pair, 3 channels
void annotate(Image& picture, const OdometrySupport& support, const std::vector<SeenPoint>& seen);

/// Keeps some pictures of a run. With `film.directory` in the configuration KEY_odometry.png there, KEY the platform's.
class OdometryFilm {
 public:
  /// @param key  of the platform
  OdometryFilm(std::string key, const Config& config);

  /// Keeps the picture unless there are enough like it.
  /// @param left  the second pair's, as it is when the odometry has answered it; empty: none
  void see(const ImageView& left, const StereoOdometry& odometry);
  /// Leaves the file. @throws FaultError cannot_write
  void write() const;

 private:
  std::string key_;
  std::filesystem::path directory_;
  FilmStrip strip_;
};

}  // namespace mrroc::vsp
