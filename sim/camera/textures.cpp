#include "sim/camera/textures.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace mrroc::camera {
namespace {

constexpr double kThickness = 0.004;  // of a plate [m]
constexpr double kGap = 2e-4;         // between a plate and the picture on it [m]
constexpr int kTagCells = 8;          // along the black border

// The words of AprilTag 36h11, row by row from the top left, the first bit is the highest; 1 is white.
constexpr std::array<std::uint64_t, kKnownTags> kTags{
    0xd5d628584, 0xd97f18b49, 0xdd280910e, 0xe479e9c98, 0xebcbca822,
    0xf31dab3ac, 0x056a5d085, 0x10652e1d4, 0x22b1dfead, 0x265ad0472,
};

void fill(Image& image, int column, int row, int edge, std::uint8_t grey) {
  for (int y = row * edge; y < (row + 1) * edge; ++y)
    std::fill_n(image.row(y) + column * edge * 3, edge * 3, grey);
}

std::shared_ptr<Image> white(int columns, int rows, int pixels) {
  auto image = std::make_shared<Image>(columns * pixels, rows * pixels, 3);
  std::ranges::fill(image->data, kPaperWhite);
  return image;
}

void add_plate(Scene& scene, double width, double height, const Pose& T_UG,
               std::shared_ptr<const Image> texture) {
  Body plate;
  plate.size = {width, height, kThickness};
  plate.T_UB = T_UG * Pose{Matrix3::Identity(), {0, 0, -kGap - kThickness / 2}};
  plate.colour = {0.85, 0.85, 0.85};
  plate.shine = 0.05;
  scene.bodies.push_back(plate);
  Body picture = plate;
  picture.shape = Shape::quad;
  picture.size.z() = 1;
  picture.T_UB = T_UG;
  picture.colour = {1, 1, 1};
  picture.casts_shadow = false;
  picture.texture = std::move(texture);
  scene.bodies.push_back(std::move(picture));
}

}  // namespace

std::shared_ptr<const Image> board_texture(const BoardSize& board, int pixels) {
  auto image = white(board.columns + 1 + 2 * board.margin, board.rows + 1 + 2 * board.margin, pixels);
  for (int row = 0; row <= board.rows; ++row)
    for (int column = row % 2; column <= board.columns; column += 2)
      fill(*image, column + board.margin, row + board.margin, pixels, kPaperBlack);
  return image;
}

std::shared_ptr<const Image> tag_texture(int id, int margin, int pixels) {
  if (id < 0 || id >= kKnownTags) throw std::invalid_argument("camera: there is no tag with this number");
  const std::uint64_t word = kTags[static_cast<std::size_t>(id)];
  auto image = white(kTagCells + 2 * margin, kTagCells + 2 * margin, pixels);
  for (int row = 0; row < kTagCells; ++row)
    for (int column = 0; column < kTagCells; ++column) {
      const bool border = std::min(row, column) == 0 || std::max(row, column) == kTagCells - 1;
      const int bit = 35 - (row - 1) * (kTagCells - 2) - (column - 1);
      if (border || (word >> bit & 1) == 0) fill(*image, column + margin, row + margin, pixels, kPaperBlack);
    }
  return image;
}

void add_board(Scene& scene, const BoardSize& board, const Pose& T_UG) {
  add_plate(scene, (board.columns + 1 + 2 * board.margin) * board.square,
            (board.rows + 1 + 2 * board.margin) * board.square, T_UG, board_texture(board));
}

void add_tag(Scene& scene, int id, double edge, const Pose& T_UG) {
  constexpr int kMargin = 2;
  const double size = edge * (kTagCells + 2 * kMargin) / kTagCells;
  add_plate(scene, size, size, T_UG, tag_texture(id, kMargin));
}

}  // namespace mrroc::camera
