#include "vsp/chessboard/inner_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp::chessboard {
namespace {

constexpr int kReach = 14;        // largest lattice that is grown, to either side of its first square
constexpr int kRounds = 12;       // of growing
constexpr double kWindow = 0.45;  // half the edge of the place in which a corner is located, in squares
constexpr int kLargestWindow = 8;
constexpr int kRoughSteps = 4;    // of locating corners while growing
constexpr int kFineSteps = 20;    // and of the board's corners in the end
constexpr double kSmallHalf = 6;  // half a square that is too small to be looked at in two places [pixel]
constexpr double kLeastContrast = 14;  // between light and dark squares [grey levels]

struct Place {
  int i{};
  int j{};
};
Place operator+(Place a, Place b) { return {a.i + b.i, a.j + b.j}; }
Place operator-(Place a, Place b) { return {a.i - b.i, a.j - b.j}; }

enum class State : char { unknown, refused, corner };

void locate_points(const cv::Mat& grey, double square, int steps, std::vector<cv::Point2f>& points) {
  const int window = std::clamp(static_cast<int>(std::lround(kWindow * square)), 2, kLargestWindow);
  if (std::min(grey.cols, grey.rows) < 2 * window + 6) return;
  cv::cornerSubPix(grey, points, {window, window}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, steps, 0.003});
}

class Grid {
 public:
  Grid(const cv::Mat& grey, const std::vector<Quadrangle>& quadrangles, const Lattice& lattice)
      : grey_(grey) {
    seed(quadrangles, lattice);
  }

  [[nodiscard]] std::optional<InnerCorners> board(const Board& board) {
    grow(board);
    return whole(board);
  }

 private:
  struct Node {
    State state{State::unknown};
    cv::Point2f p;
  };
  static constexpr int kSide = 2 * kReach + 1;

  static bool inside(Place a) { return std::abs(a.i) <= kReach && std::abs(a.j) <= kReach; }
  static std::size_t index(Place a) {
    return static_cast<std::size_t>((a.j + kReach) * kSide + a.i + kReach);
  }
  Node& at(Place a) { return nodes_[index(a)]; }
  bool known(Place a) { return inside(a) && at(a).state == State::corner; }

  // Corner (i, j) is the upper left one of cell (i, j).
  static Place place_of(const Cell& cell, int corner) {
    return {cell.i + (corner == 1 || corner == 2 ? 1 : 0), cell.j + (corner >= 2 ? 1 : 0)};
  }

  void seed(const std::vector<Quadrangle>& quadrangles, const Lattice& lattice) {
    std::vector<int> meets(nodes_.size(), 0);
    std::vector<cv::Point2f> sum(nodes_.size(), cv::Point2f(0, 0));
    for (const Cell& cell : lattice) {
      const Quadrangle& q = quadrangles[cell.quadrangle];
      for (int k = 0; k < 4; ++k) {
        const Place a = place_of(cell, (k + cell.turn) % 4);
        if (!inside(a)) continue;
        const auto n = index(a);
        ++meets[n];
        sum[n] += q.corner[static_cast<std::size_t>(k)];
      }
    }
    square_ = middle_edge(quadrangles, lattice);
    std::vector<Place> candidates;
    for (int j = -kReach; j <= kReach; ++j)
      for (int i = -kReach; i <= kReach; ++i) {
        const auto n = index({i, j});
        if (meets[n] == 0) continue;
        at({i, j}) = {State::corner, sum[n] * (1.0F / static_cast<float>(meets[n]))};
        candidates.push_back({i, j});
      }
    accept(candidates);
  }

  static double middle_edge(const std::vector<Quadrangle>& quadrangles, const Lattice& lattice) {
    std::vector<double> edges;
    for (const Cell& cell : lattice) edges.push_back(quadrangles[cell.quadrangle].shortest);
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    return *middle;
  }

  // Keeps those around which the pattern is, and locates them. Their places are what is thought of them so far.
  void accept(const std::vector<Place>& candidates) {
    std::vector<cv::Point2f> points;
    std::vector<Place> places;
    for (const Place a : candidates)
      if (crosses(a, at(a).p)) {
        points.push_back(at(a).p);
        places.push_back(a);
      }
    for (const Place a : candidates) at(a).state = State::refused;
    for (const Place a : places) at(a).state = State::corner;
    if (places.empty()) return;
    locate_points(grey_, square_, kRoughSteps, points);
    std::vector<char> good(points.size(), 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double moved = cv::norm(points[k] - at(places[k]).p);
      good[k] = moved < 0.5 * square_ && crosses(places[k], points[k]) ? 1 : 0;
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (good[k] == 0)
        at(places[k]).state = State::refused;
      else
        at(places[k]).p = points[k];
    }
  }

  // Half of the vector to the next corner in that direction, from the nearest known ones; zero when there is none.
  cv::Point2f half_edge(Place a, cv::Point2f p, Place direction) {
    const Place next = a + direction;
    const Place last = a - direction;
    if (known(next) && known(last)) return 0.25F * (at(next).p - at(last).p);
    if (known(next)) return 0.5F * (at(next).p - p);
    if (known(last)) return 0.5F * (p - at(last).p);
    const Place side{direction.j, direction.i};
    for (const Place beside : {a + side, a - side}) {
      if (!known(beside)) continue;
      if (known(beside + direction)) return 0.5F * (at(beside + direction).p - at(beside).p);
      if (known(beside - direction)) return 0.5F * (at(beside).p - at(beside - direction).p);
    }
    return {0, 0};
  }

  // Mean around a point; -1 outside of the picture and where its outermost pixels would be needed.
  [[nodiscard]] double brightness(cv::Point2f p, int reach) const {
    const int x = static_cast<int>(std::lround(p.x));
    const int y = static_cast<int>(std::lround(p.y));
    const int edge = reach + 1;
    if (x < edge || y < edge || x >= grey_.cols - edge || y >= grey_.rows - edge) return -1;
    int sum = 0;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) sum += grey_.at<unsigned char>(y + dy, x + dx);
    return static_cast<double>(sum) / ((2 * reach + 1) * (2 * reach + 1));
  }

  // Whether the two squares of the pattern's dark places around the corner are darker than both light ones; all four must
  // be in the picture.
  bool crosses(Place a, cv::Point2f p) {
    const cv::Point2f u = half_edge(a, p, {1, 0});
    const cv::Point2f v = half_edge(a, p, {0, 1});
    const double half = std::min(cv::norm(u), cv::norm(v));
    if (half < 1) return false;
    if (half < kSmallHalf) return crosses_at(a, p, u, v, half < 2.5 ? 0 : 1);
    return crosses_at(a, p, 0.4F * u, 0.4F * v, 1) && crosses_at(a, p, 0.75F * u, 0.75F * v, 1);
  }

  bool crosses_at(Place a, cv::Point2f p, cv::Point2f u, cv::Point2f v, int reach) {
    const double same[]{brightness(p + u + v, reach), brightness(p - u - v, reach)};
    const double cross[]{brightness(p + u - v, reach), brightness(p - u + v, reach)};
    // The square at the lower right is dark where i + j is even.
    const bool even = (a.i + a.j) % 2 == 0;
    const auto& dark = even ? same : cross;
    const auto& light = even ? cross : same;
    if (std::min({same[0], same[1], cross[0], cross[1]}) < 0) return false;
    // Uneven light changes both; squares of two colours differ more than those of one.
    const double spread = std::max(std::abs(light[0] - light[1]), std::abs(dark[0] - dark[1]));
    const double contrast = std::min(light[0], light[1]) - std::max(dark[0], dark[1]);
    return contrast > std::max(kLeastContrast, 0.5 * spread);
  }

  // Where the corner must be if the pattern goes on: from two known ones in a line, mean over the directions.
  bool predict(Place a, cv::Point2f& p) {
    cv::Point2f sum(0, 0);
    int n = 0;
    for (const Place d : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}}) {
      if (!known(a + d)) continue;
      if (known(a + d + d)) {
        sum += 2 * at(a + d).p - at(a + d + d).p;
        ++n;
      }
      const Place side{d.j, d.i};
      for (const Place s : {side, Place{} - side})
        if (known(a + s) && known(a + d + s)) {
          sum += at(a + d).p + at(a + s).p - at(a + d + s).p;
          ++n;
        }
    }
    if (n == 0) return false;
    p = sum * (1.0F / static_cast<float>(n));
    return true;
  }

  // Until the pattern goes on nowhere, or is larger than the board.
  void grow(const Board& board) {
    for (int round = 0; round < kRounds && extent().count <= board.corners(); ++round) {
      // What was refused is tried again with more neighbours known.
      for (Node& n : nodes_)
        if (n.state == State::refused) n.state = State::unknown;
      std::vector<Place> candidates;
      std::vector<cv::Point2f> predicted;
      for (int j = -kReach; j <= kReach; ++j)
        for (int i = -kReach; i <= kReach; ++i) {
          cv::Point2f p;
          if (at({i, j}).state == State::unknown && predict({i, j}, p)) {
            candidates.push_back({i, j});
            predicted.push_back(p);
          }
        }
      for (std::size_t k = 0; k < candidates.size(); ++k) at(candidates[k]).p = predicted[k];
      accept(candidates);
      if (std::ranges::none_of(candidates, [this](Place a) { return known(a); })) return;
    }
  }

  // The corners that are known, and the rectangle of the lattice that they fill or not.
  struct Extent {
    Place low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
    Place high{std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};
    int count{};
    [[nodiscard]] int ni() const { return high.i - low.i + 1; }
    [[nodiscard]] int nj() const { return high.j - low.j + 1; }
  };

  Extent extent() {
    Extent e;
    for (int j = -kReach; j <= kReach; ++j)
      for (int i = -kReach; i <= kReach; ++i)
        if (known({i, j})) {
          e.low = {std::min(e.low.i, i), std::min(e.low.j, j)};
          e.high = {std::max(e.high.i, i), std::max(e.high.j, j)};
          ++e.count;
        }
    return e;
  }

  std::optional<InnerCorners> whole(const Board& board) {
    const Extent e = extent();
    const auto& [low, high, count] = e;
    if (count != board.corners()) return std::nullopt;
    const bool upright = e.ni() == board.columns && e.nj() == board.rows;
    const bool lying = e.ni() == board.rows && e.nj() == board.columns;
    if (!upright && !lying) return std::nullopt;
    if (!ends_everywhere(low, high)) return std::nullopt;
    InnerCorners result = in_order(board, low, high, upright);
    return locate(grey_, result) ? std::optional(result) : std::nullopt;
  }

  // The square at the upper left of corner 0, 0 is dark: that tells which way round.
  InnerCorners in_order(const Board& board, Place low, Place high, bool upright) {
    Place first = upright ? low : Place{high.i, low.j};
    Place right = upright ? Place{1, 0} : Place{0, 1};
    Place down = upright ? Place{0, 1} : Place{-1, 0};
    const int upper_left = upright ? first.i - 1 + first.j - 1 : first.i + first.j - 1;
    if (upper_left % 2 != 0) {
      first = upright ? high : Place{low.i, high.j};
      right = Place{} - right;
      down = Place{} - down;
    }
    InnerCorners result;
    result.shortest = std::numeric_limits<double>::max();
    for (int r = 0; r < board.rows; ++r)
      for (int c = 0; c < board.columns; ++c) {
        const Place a{first.i + c * right.i + r * down.i, first.j + c * right.j + r * down.j};
        result.pixels.emplace_back(at(a).p.x, at(a).p.y);
        for (const Place back : {a - right, a - down})
          if (known(back)) result.shortest = std::min(result.shortest, cv::norm(at(a).p - at(back).p));
      }
    return result;
  }

  // The picture must show of every side that the light margin is there: beside most of the dark squares at the edge.
  bool ends_everywhere(Place low, Place high) {
    return margin_along({low.i, low.j}, {1, 0}, {0, -1}, high.i) &&
           margin_along({low.i, high.j}, {1, 0}, {0, 1}, high.i) &&
           margin_along({low.i, low.j}, {0, 1}, {-1, 0}, high.j) &&
           margin_along({high.i, low.j}, {0, 1}, {1, 0}, high.j);
  }

  // From the outermost corner `from` along the side, where `out` leads away from the board.
  bool margin_along(Place from, Place along, Place out, int last) {
    constexpr float kSquare =
        0.5F;  // middle of the square at the edge, and of the margin beside it [squares]
    constexpr float kMargin = 1.25F;
    int dark = 0;
    int light = 0;
    for (Place a = from; along.i != 0 ? a.i < last : a.j < last; a = a + along) {
      const cv::Point2f p = at(a).p;
      const cv::Point2f next = at(a + along).p;
      const cv::Point2f outwards = 0.5F * (p - at(a - out).p + next - at(a + along - out).p);
      const cv::Point2f middle = 0.5F * (p + next);
      // Cell (i, j) has corner (i, j) at its upper left: the square at the edge lies beyond or before the corner.
      const Place cell{a.i + (out.i < 0 ? -1 : 0), a.j + (out.j < 0 ? -1 : 0)};
      if ((cell.i + cell.j) % 2 != 0) continue;
      ++dark;
      const double inside = brightness(middle + kSquare * outwards, 0);
      const double outside = brightness(middle + kMargin * outwards, 0);
      if (inside >= 0 && outside > inside + kLeastContrast) ++light;
    }
    return 2 * light > dark;
  }

  const cv::Mat& grey_;
  double square_{};  // edge that is typical of the pattern here [pixel]
  std::vector<Node> nodes_ = std::vector<Node>(static_cast<std::size_t>(kSide * kSide));
};

}  // namespace

std::optional<InnerCorners> inner_corners(const cv::Mat& grey, const std::vector<Quadrangle>& quadrangles,
                                          const Lattice& lattice, const Board& board) {
  return Grid(grey, quadrangles, lattice).board(board);
}

bool locate(const cv::Mat& grey, InnerCorners& corners) {
  std::vector<cv::Point2f> points;
  for (const Vector2& p : corners.pixels) {
    if (!(p.x() >= 0 && p.y() >= 0 && p.x() <= grey.cols - 1 && p.y() <= grey.rows - 1)) return false;
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  locate_points(grey, corners.shortest, kFineSteps, points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector2 p(points[k].x, points[k].y);
    if ((p - corners.pixels[k]).norm() > 0.5 * corners.shortest) return false;
    corners.pixels[k] = p;
  }
  return true;
}

}  // namespace mrroc::vsp::chessboard
