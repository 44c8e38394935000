// The stages (35)-(40) one by one, on a board that faces the camera.
#include "vsp/chessboard/chain.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "test/vsp/plane_camera.hpp"
#include "vsp/chessboard/board_search.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp::chessboard {
namespace {

constexpr int kDarkSquares = 35;

class ChainTest : public testing::Test {
 protected:
  static const Image& picture() {
    static const Image picture_of_board =
        test::PlaneCamera(CameraModel{}, 2)
            .render(test::facing(0.5, 0, 0, 0.2), test::chessboard_texture(9, 6, 0.025, 0.025));
    return picture_of_board;
  }
  // The table around the plate is a dark quadrangle, too.
  static std::vector<Quadrangle> small_ones(const cv::Mat& binary) {
    std::vector<Quadrangle> found = quadrangles(contours(dilation(binary), {}), {});
    std::erase_if(found, [](const Quadrangle& q) { return q.shortest > 100; });
    return found;
  }
  cv::Mat grey_ = grey(picture().view());
  cv::Mat binary_ = threshold(grey_, 81, 6);
};

TEST_F(ChainTest, ThresholdFollowsTheBrightnessOfTheSurroundings) {
  cv::Mat shaded;
  grey_.convertTo(shaded, CV_32F);
  for (int v = 0; v < shaded.rows; ++v)
    for (int u = 0; u < shaded.cols; ++u) shaded.at<float>(v, u) *= 0.3F + 0.7F * static_cast<float>(u) / 640;
  shaded.convertTo(shaded, CV_8U);
  const auto squares = [](const cv::Mat& g) { return small_ones(threshold(g, 81, 6)).size(); };
  EXPECT_EQ(squares(grey_), kDarkSquares);
  EXPECT_EQ(squares(shaded), kDarkSquares);
}

TEST_F(ChainTest, DilationLetsLightGrowAndTakesSquaresApart) {
  const cv::Mat grown = dilation(binary_);
  cv::Mat lost;
  cv::bitwise_and(binary_, ~grown, lost);
  EXPECT_EQ(cv::countNonZero(lost), 0);
  EXPECT_GT(cv::countNonZero(grown), cv::countNonZero(binary_));
  cv::Mat labels;
  // Squares that touch at their corners are joined in the paper's picture, which lets dark grow.
  cv::Mat joined;
  cv::dilate(~binary_, joined, cv::Mat());
  const cv::Rect middle(220, 190, 200, 100);
  EXPECT_GT(cv::connectedComponents(~grown, labels, 8), kDarkSquares);
  EXPECT_LT(cv::connectedComponents(joined(middle), labels, 8), 3);
}

TEST_F(ChainTest, QuadranglesAreTheDarkSquaresWithTheirCornersClockwise) {
  const auto found = small_ones(binary_);
  ASSERT_EQ(found.size(), kDarkSquares);
  for (const Quadrangle& q : found) {
    EXPECT_NEAR(q.shortest, 30, 2.5);
    for (std::size_t k = 0; k < 4; ++k) {
      const cv::Point2f a = q.corner[(k + 1) % 4] - q.corner[k];
      const cv::Point2f b = q.corner[(k + 2) % 4] - q.corner[(k + 1) % 4];
      EXPECT_GT(a.cross(b), 0);
    }
  }
}

TEST_F(ChainTest, NeighboursMakeOneLatticeOfAllSquares) {
  const auto found = quadrangles(contours(dilation(binary_), {}), {});
  const auto all = lattices(found);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].size(), static_cast<std::size_t>(kDarkSquares));
  for (const Cell& cell : all[0]) EXPECT_EQ((cell.i + cell.j) % 2, 0);
}

TEST_F(ChainTest, SquaresThatDoNotTouchMakeNoLattice) {
  cv::Mat apart(480, 640, CV_8U, cv::Scalar(230));
  for (int k = 0; k < 12; ++k)
    cv::rectangle(apart, cv::Rect(30 + 60 * (k % 4), 30 + 60 * (k / 4), 30, 30), 20, cv::FILLED);
  const auto found = quadrangles(contours(dilation(threshold(apart, 81, 6)), {}), {});
  EXPECT_EQ(found.size(), 12U);
  EXPECT_TRUE(lattices(found).empty());
}

TEST_F(ChainTest, InnerCornersLieWhereTheLensProjectsThem) {
  const SearchResult result = find_boards(grey_, {0, 0, 640, 480, 1, 81, 6, {}}, kBoard);
  ASSERT_TRUE(result.is_one());
  const Pose T = test::facing(0.5, 0, 0, 0.2);
  double squares = 0;
  std::size_t n = 0;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c)
      squares +=
          (project(CameraModel{}, T * kBoard.corner(r, c)) - result.boards[0].pixels[n++]).squaredNorm();
  EXPECT_LT(std::sqrt(squares / kBoard.corners()), 0.1);
}

TEST_F(ChainTest, WorkIsBoundedByTheLimits) {
  EXPECT_EQ(contours(dilation(binary_), {.contours = 10, .quadrangles = 800}).size(), 10U);
  const auto outlines = contours(dilation(binary_), {});
  EXPECT_EQ(quadrangles(outlines, {.contours = 6000, .quadrangles = 7}).size(), 7U);
}

TEST_F(ChainTest, LostSquaresAreBridged) {
  cv::Mat dirty = grey_.clone();
  // A scratch joins two dark squares across a light one.
  const Quadrangle q = small_ones(binary_)[17];
  cv::line(dirty, q.centre, q.centre + 2 * (q.corner[1] - q.corner[0]), 20, 3);
  EXPECT_LT(small_ones(threshold(dirty, 81, 6)).size(), static_cast<std::size_t>(kDarkSquares));
  EXPECT_TRUE(find_boards(dirty, {0, 0, 640, 480, 1, 81, 6, {}}, kBoard).is_one());
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
