// A receptor at work on recorded pictures of a real camera: prints one reading a line.
#pragma once
#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {

/// What to do with which pictures.
struct RecordedRun {
  std::filesystem::path source;    ///< picture, folder of pictures, or film
  std::filesystem::path camera;    ///< TOML file with [cameras.KEY], as `calibrate` writes it
  std::string key;                 ///< which of its cameras; empty: the only one
  std::filesystem::path annotate;  ///< folder for pictures with the detection drawn in; empty: none
  std::filesystem::path strip;     ///< file for all of them side by side; empty: none
};

/// Prints for every picture a line of JSON: frame, source, seen, ambiguous, p [m], aa (angle times axis) [rad], sigma of
/// x y z [m] and ax ay az [rad], reprojection_px; p, aa and sigma only when seen.
/// @throws FaultError bad_picture: a picture that cannot be used or is of another size than the camera's;
///         bad_configuration: the camera file; cannot_write
void run_recorded(const ImageReceptor& receptor, const RecordedRun& run, std::FILE* out);

}  // namespace mrroc::vsp
