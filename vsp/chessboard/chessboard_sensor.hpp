// Virtual receptor of the chessboard: pose of the board from one picture (VS 35-42).
#pragma once
#include <optional>
#include <vector>

#include "base/target/board.hpp"
#include "vsp/image_sensor.hpp"
#include "vsp/planar_pose.hpp"

namespace cv {
class Mat;
}

namespace mrroc::vsp {
namespace chessboard {
struct InnerCorners;
}  // namespace chessboard

/// Thresholds of the detector.
struct ChessboardParameters {
  int offset{6};              ///< how much darker than its surroundings a dark pixel is [grey levels]
  double rms_px{0.5};         ///< no pose is delivered whose reprojection error is larger [pixel]
  double worst_px{2};         ///< nor one with a corner farther off [pixel]
  PlanarPoseParameters pose;  ///< of the pose from the corners
};

/// Looks for one board, first around the place where the last picture had it, then everywhere, then everywhere in the
/// picture enlarged two and three times, which shows boards whose squares are only 5 pixels wide. Two boards in the
/// part that is searched are reported as ambiguous; one that is followed stays the one that is meant, whatever comes
/// into view elsewhere. For pictures whose whole width is more than kWidest pixels the enlarged search is left out.
class ChessboardSensor {
 public:
  /// @throws FaultError bad_configuration: the camera is not proper
  explicit ChessboardSensor(const CameraModel& camera, const Board& board = kBoard,
                            const ChessboardParameters& parameters = {});

  /// @param picture  1 or 3 channels, of the camera's size; anything else shows nothing
  /// @return pose of the board's frame G (Board::corner) in C; not seen and identity when there is none, not all of it,
  ///         or not one pose
  CameraReading detect(const ImageView& picture, std::int64_t frame, std::int64_t step);
  /// The next picture has nothing to do with the last one.
  void forget() { last_.reset(); }

 private:
  void take(const cv::Mat& grey, const std::vector<chessboard::InnerCorners>& boards, CameraReading& reading);

  CameraModel camera_;
  Board board_;
  ChessboardParameters k_;
  std::optional<Pose> last_;
};
static_assert(ImageSensor<ChessboardSensor>);

}  // namespace mrroc::vsp
