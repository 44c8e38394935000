#include "vsp/chessboard/board_search.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp::chessboard {
namespace {

constexpr std::size_t kMostLattices = 6;  // that are grown in one picture
constexpr std::size_t kManySquares = 8;   // dark ones, which are no accident

// Outlines in a picture beyond which it is not enlarged: it shows noise or a texture, and the work would grow with it.
constexpr std::size_t kClutter = 1500;

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

// Tells whether the lattice's middle is on the board.
bool lies_on(const Lattice& lattice, const std::vector<Quadrangle>& quadrangles, const InnerCorners& board,
             const Board& size) {
  cv::Point2f middle(0, 0);
  for (const Cell& cell : lattice)
    middle += quadrangles[cell.quadrangle].centre / static_cast<float>(lattice.size());
  const auto columns = static_cast<std::size_t>(size.columns);
  std::vector<cv::Point2f> outline;
  for (const std::size_t k :
       {std::size_t{0}, columns - 1, board.pixels.size() - 1, board.pixels.size() - columns})
    outline.emplace_back(static_cast<float>(board.pixels[k].x()), static_cast<float>(board.pixels[k].y()));
  return cv::pointPolygonTest(outline, middle, false) >= 0;
}

}  // namespace

void add(std::vector<InnerCorners>& boards, const InnerCorners& board) {
  const auto same = [&board](const InnerCorners& other) {
    return (other.pixels.front() - board.pixels.front()).norm() < 0.5 * board.shortest;
  };
  if (std::ranges::none_of(boards, same)) boards.push_back(board);
}

SearchResult find_boards(const cv::Mat& grey, const Search& search, const Board& board) {
  cv::Mat part = grey({search.x, search.y, search.width, search.height});
  if (search.scale > 1) {
    cv::Mat enlarged;
    cv::resize(part, enlarged, {}, search.scale, search.scale, cv::INTER_LINEAR);
    part = enlarged;
  }
  const cv::Mat light = dilation(threshold(part, search.block, search.offset));
  const auto outlines = contours(light, search.limits);
  std::vector<Quadrangle> found = quadrangles(outlines, search.limits);
  bring_home(found, search);
  SearchResult result;
  result.outlines = outlines.size();
  const std::vector<Lattice> all = lattices(found);
  std::vector<const Lattice*> rest;
  for (std::size_t k = 0; k < std::min(all.size(), kMostLattices); ++k) {
    const auto corners = inner_corners(grey, found, all[k], board);
    if (corners)
      add(result.boards, *corners);
    else if (all[k].size() >= kManySquares)
      rest.push_back(&all[k]);
  }
  for (const Lattice* lattice : rest)
    result.unresolved =
        result.unresolved || std::ranges::none_of(result.boards, [&](const InnerCorners& known) {
          return lies_on(*lattice, found, known, board);
        });
  return result;
}

int large_surroundings(int width) { return std::max(kSmallSurroundings, (width / 8) | 1); }

void find_everywhere(const cv::Mat& grey, const Board& board, int offset, std::vector<InnerCorners>& known) {
  struct Pass {
    int scale;
    int block;
  };
  // Large squares need large surroundings, small ones small.
  const Pass passes[]{{1, large_surroundings(grey.cols)},
                      {1, kSmallSurroundings},
                      {2, kSmallSurroundings},
                      {3, kSmallSurroundings}};
  bool cluttered = false;
  for (const Pass& pass : passes) {
    if (pass.scale > 1 && (cluttered || grey.cols > kWidest)) return;
    const SearchResult result =
        find_boards(grey, {0, 0, grey.cols, grey.rows, pass.scale, pass.block, offset, {}}, board);
    for (const InnerCorners& found : result.boards) add(known, found);
    if (known.size() > 1 || (known.size() == 1 && !result.unresolved)) return;
    cluttered = result.outlines > kClutter;
  }
}

}  // namespace mrroc::vsp::chessboard
