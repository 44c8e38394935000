#include "sim/camera/textures.hpp"

#include <gtest/gtest.h>

namespace mrroc::camera {
namespace {

TEST(Textures, ShowABoardWithAWhiteMarginAndADarkFirstSquare) {
  const BoardSize board;
  const auto image = board_texture(board, 8);
  ASSERT_EQ(image->width, 8 * (9 + 1 + 2));
  ASSERT_EQ(image->height, 8 * (6 + 1 + 2));
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 12; ++column) {
      const bool inside = row > 0 && row < 8 && column > 0 && column < 11;
      const bool dark = inside && (row + column) % 2 == 0;
      EXPECT_EQ(image->view().at(8 * column + 4, 8 * row + 4), dark ? kPaperBlack : kPaperWhite);
    }
}

TEST(Textures, ShowTagsThatDifferByElevenCellsHoweverTheyAreTurned) {
  const auto cells = [](int id) {
    const auto image = tag_texture(id, 1, 2);
    std::array<std::array<int, 6>, 6> bits{};
    for (int row = 0; row < 10; ++row)
      for (int column = 0; column < 10; ++column) {
        const int white = image->view().at(2 * column, 2 * row) == kPaperWhite ? 1 : 0;
        const int edge = std::min({row, column, 9 - row, 9 - column});
        if (edge <= 1) {
          EXPECT_EQ(white, 1 - edge);
          continue;
        }
        bits[static_cast<std::size_t>(row - 2)][static_cast<std::size_t>(column - 2)] = white;
      }
    return bits;
  };
  for (int a = 0; a < kKnownTags; ++a)
    for (int b = 0; b < kKnownTags; ++b) {
      auto turned = cells(b);
      for (int quarter = 0; quarter < 4; ++quarter) {
        const auto before = turned;
        for (std::size_t r = 0; r < 6; ++r)
          for (std::size_t c = 0; c < 6; ++c) turned[r][c] = before[c][5 - r];
        int distance = 0;
        const auto first = cells(a);
        for (std::size_t r = 0; r < 6; ++r)
          for (std::size_t c = 0; c < 6; ++c) distance += first[r][c] != turned[r][c];
        const bool same = a == b && quarter == 3;
        EXPECT_TRUE(same || distance >= 11) << a << ' ' << b << ' ' << distance;
      }
    }
  EXPECT_THROW(tag_texture(kKnownTags), std::invalid_argument);
  EXPECT_THROW(tag_texture(-1), std::invalid_argument);
}

TEST(Textures, LieWithTheirPatternInThePlaneOfG) {
  Scene scene;
  const Pose T_UG{rotation_from_angle_axis({0.3, -0.2, 0.5}), {0.1, 0.2, 0.3}};
  add_board(scene, {}, T_UG);
  add_tag(scene, 3, 0.1, T_UG);
  ASSERT_EQ(scene.bodies.size(), 4U);
  for (const std::size_t picture : {1, 3}) {
    EXPECT_EQ(scene.bodies[picture].shape, Shape::quad);
    EXPECT_LT((scene.bodies[picture].T_UB.p - T_UG.p).norm(), 1e-12);
    EXPECT_LT((T_UG.inverse() * scene.bodies[picture - 1].T_UB.p).z(), 0)
        << "the plate is behind the picture";
  }
  EXPECT_LT((scene.bodies[1].size.head<2>() - Eigen::Vector2d(0.3, 0.225)).norm(), 1e-12);
  EXPECT_LT((scene.bodies[3].size.head<2>() - Eigen::Vector2d(0.15, 0.15)).norm(), 1e-12);
}

}  // namespace
}  // namespace mrroc::camera
