// What a receptor found, drawn into the picture in which it found it; for people.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/camera.hpp"
#include "base/image.hpp"
#include "vsp/apriltag/tag.hpp"
#include "vsp/chessboard/board.hpp"

namespace mrroc::vsp {

/// What is drawn of an object, in G [m].
struct ObjectShape {
  std::vector<Vector3> marks;    ///< crosses
  std::vector<Vector3> outline;  ///< closed
  double axes{0.05};             ///< length of the axes of G
};
/// @return what is drawn of a board: its inner corners, edge and axes
ObjectShape shape_of(const Board& board);
/// @return what is drawn of a tag: its black border and axes
ObjectShape shape_of(const Tag& tag);

/// Draws the object where the reading has it - axes of G red, green, blue, outline, marks - with the text at the upper
/// left; a red frame when it was not seen, a yellow one when the reading is ambiguous.
/// @param picture  3 channels, of the camera's size
void annotate(Image& picture, const CameraReading& reading, const CameraModel& camera,
              const ObjectShape& shape, const std::string& text);

/// @return 3 channels, whatever the picture has
Image in_colour(const ImageView& picture);

/// Pictures of a run side by side, in rows from left to right.
class FilmStrip {
 public:
  /// @param columns  pictures in a row @param width  of one of them [pixel] @param most  that are kept: when there are
  ///                 more, every second one goes, so that they cover the run evenly
  explicit FilmStrip(int columns = 6, int width = 240, std::size_t most = 48);

  /// @param picture  of the same size as all others, 3 channels
  void add(const ImageView& picture);
  [[nodiscard]] bool empty() const { return kept_.empty(); }
  /// @return whether the picture of that number is to be added: fewer and fewer as the run goes on
  [[nodiscard]] bool wants(std::int64_t frame) const { return frame % every_ == 0; }
  /// @return all that were kept in one picture; empty when there are none
  [[nodiscard]] Image picture() const;

 private:
  int columns_;
  int width_;
  std::size_t most_;
  std::int64_t every_{1};
  std::vector<Image> kept_;
};

}  // namespace mrroc::vsp
