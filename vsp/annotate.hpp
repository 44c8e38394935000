// Draws a receptor's detection into the picture, for people.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/camera.hpp"
#include "base/image.hpp"
#include "base/target/board.hpp"
#include "base/target/tag.hpp"

namespace mrroc::vsp {

/// Lines that are drawn for an object, in G [m].
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

/// Draws a frame: nothing was measured. @param picture  3 channels @param ambiguous  yellow: something was, and cannot be trusted; else red
void draw_frame(Image& picture, bool ambiguous = false);

/// Writes a line at the upper left. @param picture  3 channels
void write_text(Image& picture, const std::string& text);

/// @return 3 channels, whatever the picture has
Image in_colour(const ImageView& picture);

/// Pictures of a run side by side, in rows from left to right: mostly those with a reading, and what was between them.
class FilmStrip {
 public:
  /// @param columns  pictures in a row @param width  of one of them [pixel]
  /// @param most     that are shown: when there are more, those go that are next to another one of their kind, so that
  ///                 what is seen for a moment only stays. A quarter is for pictures without a reading
  explicit FilmStrip(int columns = 6, int width = 240, std::size_t most = 48);

  /// @param frame    its number, larger than those before @param seen  whether it carries a reading
  /// @param picture  of the same size as all others, 3 channels
  void add(std::int64_t frame, bool seen, const ImageView& picture);
  /// @return whether nothing has been kept
  [[nodiscard]] bool empty() const { return reels_[0].empty() && reels_[1].empty(); }
  /// @return whether the picture of that number is to be added: fewer and fewer as the run goes on
  [[nodiscard]] bool wants(std::int64_t frame, bool seen) const;
  /// @return all that are shown in one picture; empty when there are none
  [[nodiscard]] Image picture() const;

 private:
  struct Kept {
    std::int64_t frame{};
    Image picture;
  };
  using Reel = std::vector<Kept>;

  /// @return number of the picture that is nearest to the one before it, the first such one; of two pictures and more
  static std::size_t nearest(const Reel& reel);
  static std::int64_t gap(const Reel& reel, std::size_t k) { return reel[k].frame - reel[k - 1].frame; }
  /// Leaves so many.
  static void thin(Reel& reel, std::size_t most);

  int columns_;
  int width_;
  std::size_t most_;
  std::array<Reel, 2> reels_;  // without a reading, and with one
};

}  // namespace mrroc::vsp
