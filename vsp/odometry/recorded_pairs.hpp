// Runs the odometry on recorded pairs of pictures: prints one reading a line.
#pragma once
#include <cstdio>
#include <filesystem>
#include <string>

namespace mrroc::vsp {

/// Pairs to process.
struct RecordedPairs {
  std::filesystem::path
      source;  ///< folder with a folder of pictures for either camera, LEFT and RIGHT of [odometry.KEY]
  std::filesystem::path camera;  ///< TOML file with [odometry.KEY] and its [cameras.LEFT] and [cameras.RIGHT]
  std::string key;               ///< of the platform; empty: the only one
};

/// Prints for every pair a line of JSON: frame, step, left and right (the files), valid, finding (why, in words), matches, inliers, cells,
/// reprojection_px; when valid also step_before, the motion p [m], aa (angle times axis) [rad], and sigma of x y z [m] and
/// ax ay az [rad]. Pair n is of step n times the cameras' period.
/// @throws FaultError bad_picture: one that cannot be used or is of another size than the cameras', or more of one camera
///         than of the other; bad_configuration: the camera file
void run_recorded_pairs(const RecordedPairs& run, std::FILE* out);

/// The receptor's program on recorded pairs. @return exit status @throws FaultError as above; bad_usage
int recorded_pairs_main(int argc, char** argv);

}  // namespace mrroc::vsp
