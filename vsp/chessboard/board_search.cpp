#include "vsp/chessboard/board_search.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp::chessboard {
namespace {

constexpr std::size_t kMostLattices = 6;  // that are grown in one picture

// From pixels of the enlarged part to pixels of the picture.
void bring_home(std::vector<Quadrangle>& quadrangles, const Search& search) {
  const auto scale = static_cast<float>(search.scale);
  const cv::Point2f origin(static_cast<float>(search.x), static_cast<float>(search.y));
  const auto home = [&](cv::Point2f p) {
    return cv::Point2f((p.x + 0.5F) / scale - 0.5F, (p.y + 0.5F) / scale - 0.5F) + origin;
  };
  for (Quadrangle& q : quadrangles) {
    for (cv::Point2f& c : q.corner) c = home(c);
    q.centre = home(q.centre);
    q.shortest /= scale;
  }
}

bool same(const InnerCorners& a, const InnerCorners& b) {
  return (a.pixels.front() - b.pixels.front()).norm() < 0.5 * a.shortest;
}

}  // namespace

std::vector<InnerCorners> boards(const cv::Mat& grey, const Search& search, const Board& board) {
  cv::Mat part = grey({search.x, search.y, search.width, search.height});
  if (search.scale > 1) {
    cv::Mat enlarged;
    cv::resize(part, enlarged, {}, search.scale, search.scale, cv::INTER_LINEAR);
    part = enlarged;
  }
  const cv::Mat light = dilation(threshold(part, search.block, search.offset));
  std::vector<Quadrangle> found = quadrangles(contours(light, search.limits), search.limits);
  bring_home(found, search);
  std::vector<InnerCorners> result;
  const std::vector<Lattice> all = lattices(found);
  for (std::size_t k = 0; k < std::min(all.size(), kMostLattices); ++k) {
    const auto corners = inner_corners(grey, found, all[k], board);
    const auto again = [&](const InnerCorners& other) { return same(other, *corners); };
    if (corners && std::ranges::none_of(result, again)) result.push_back(*corners);
  }
  return result;
}

}  // namespace mrroc::vsp::chessboard
