// Runs a receptor on recorded pictures of a real camera: prints one reading a line.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {

/// Pictures to process, and the outputs to make.
struct RecordedRun {
  std::filesystem::path source;    ///< picture, folder of pictures, or film
  std::filesystem::path camera;    ///< TOML file with [cameras.KEY], as `calibrate` writes it
  std::string key;                 ///< which of its cameras; empty: the only one
  std::filesystem::path annotate;  ///< folder for pictures with the detection drawn in; empty: none
  std::filesystem::path strip;     ///< file for all of them side by side; empty: none
};

/// A receptor's reading of a recorded picture.
struct RecordedAnswer {
  nlohmann::json line;    ///< that is printed
  CameraReading reading;  ///< that is drawn
  std::string text;       ///< to be written into the picture, behind its number
};
/// Finds the object in one picture. @param number  of the picture  @param source  name of its file
using RecordedDetector =
    std::function<RecordedAnswer(const ImageView&, std::int64_t number, const std::string& source)>;

/// A receptor as a tool for recorded pictures.
struct RecordedTool {
  std::string program;                  ///< e.g. "vsp_chessboard"
  std::string about;                    ///< one sentence for --help
  ObjectShape (*shape)(const Config&);  ///< what it looks for, for drawing. @throws ConfigError
  /// Makes the detector of a camera. @throws ConfigError
  std::function<RecordedDetector(const CameraModel&, const Config&, const std::string& key)> make;
};

/// Prints the tool's line for every picture. @throws FaultError as below
void run_recorded(const RecordedTool& tool, const RecordedRun& run, std::FILE* out);

/// @return frame, source, seen, ambiguous, and when seen p, aa, sigma, reprojection_px
nlohmann::json as_json(const CameraReading& reading, const std::string& source);

/// main() of a receptor's program: with --source for recorded pictures, else as a node of a running system.
/// @return exit status
int recorded_main(int argc, char** argv, const RecordedTool& tool, const link::NodeMain& body);

/// Prints for every picture a line of JSON: frame, source, seen, ambiguous, p [m], aa (angle times axis) [rad], sigma of
/// x y z [m] and ax ay az [rad], reprojection_px; p, aa and sigma only when seen.
/// @throws FaultError bad_picture: a picture that cannot be used or is of another size than the camera's;
///         bad_configuration: the camera file; cannot_write
void run_recorded(const ImageReceptor& receptor, const RecordedRun& run, std::FILE* out);

}  // namespace mrroc::vsp
