#include "vsp/annotate.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

const cv::Scalar kRed(40, 40, 230);
const cv::Scalar kGreen(60, 200, 60);
const cv::Scalar kBlue(230, 90, 40);
const cv::Scalar kYellow(0, 210, 240);
const cv::Scalar kWhite(255, 255, 255);
const cv::Scalar kBlack(0, 0, 0);

constexpr int kSubPixel = 4;  // OpenCV's shift: sixteenths of a pixel

cv::Point sixteenths(const Vector2& p) {
  const double far = 1e5;
  return {static_cast<int>(std::lround(16 * std::clamp(p.x(), -far, far))),
          static_cast<int>(std::lround(16 * std::clamp(p.y(), -far, far)))};
}

class Pen {
 public:
  Pen(cv::Mat& on, const CameraModel& camera, const Pose& T_CG) : on_(on), camera_(camera), T_CG_(T_CG) {}

  void line(const Vector3& a, const Vector3& b, const cv::Scalar& colour, int thickness) {
    const Vector3 p = T_CG_ * a;
    const Vector3 q = T_CG_ * b;
    if (std::min(p.z(), q.z()) < 0.01) return;
    cv::line(on_, sixteenths(project(camera_, p)), sixteenths(project(camera_, q)), colour, thickness,
             cv::LINE_AA, kSubPixel);
  }
  void mark(const Vector3& a) {
    const Vector3 p = T_CG_ * a;
    if (p.z() < 0.01) return;
    cv::circle(on_, sixteenths(project(camera_, p)), 2 * 16, kGreen, 1, cv::LINE_AA, kSubPixel);
  }

 private:
  cv::Mat& on_;
  const CameraModel& camera_;
  const Pose& T_CG_;
};

}  // namespace

ObjectShape shape_of(const Board& board) {
  ObjectShape shape;
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) shape.marks.push_back(board.corner(r, c));
  const double x = 0.5 * (board.columns + 1) * board.square;
  const double y = 0.5 * (board.rows + 1) * board.square;
  shape.outline = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  shape.axes = 2 * board.square;
  return shape;
}

ObjectShape shape_of(const Tag& tag) {
  ObjectShape shape;
  const auto corners = tag.corners();
  shape.outline.assign(corners.begin(), corners.end());
  shape.axes = 0.5 * tag.edge;
  return shape;
}

void annotate(Image& picture, const CameraReading& reading, const CameraModel& camera,
              const ObjectShape& shape, const std::string& text) {
  if (picture.channels != 3) return;
  cv::Mat on = drawn_on(picture);
  if (reading.seen) {
    Pen pen(on, camera, reading.T_CG);
    for (std::size_t k = 0; k < shape.outline.size(); ++k)
      pen.line(shape.outline[k], shape.outline[(k + 1) % shape.outline.size()], kYellow, 1);
    for (const Vector3& m : shape.marks) pen.mark(m);
    const std::array colours{kRed, kGreen, kBlue};
    for (int axis = 0; axis < 3; ++axis)
      pen.line(Vector3::Zero(), shape.axes * Vector3::Unit(axis), colours[static_cast<std::size_t>(axis)], 2);
  } else {
    draw_frame(picture, reading.ambiguous);
  }
  write_text(picture, text);
}

void draw_frame(Image& picture, bool ambiguous) {
  if (picture.channels != 3) return;
  constexpr int kThick = 6;  // [pixel]
  cv::rectangle(drawn_on(picture), {0, 0}, {picture.width - 1, picture.height - 1},
                ambiguous ? kYellow : kRed, kThick);
}

void write_text(Image& picture, const std::string& text) {
  if (picture.channels != 3) return;
  cv::Mat on = drawn_on(picture);
  const double size = 0.05 * std::max(8, on.rows / 48);
  const cv::Point at(10, 12 + static_cast<int>(20 * size));
  cv::putText(on, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kBlack, 3, cv::LINE_AA);
  cv::putText(on, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kWhite, 1, cv::LINE_AA);
}

Image in_colour(const ImageView& picture) {
  Image result(picture.width, picture.height, 3);
  cv::Mat target = drawn_on(result);
  if (picture.channels == 3)
    matrix(picture).copyTo(target);
  else
    cv::cvtColor(matrix(picture), target, cv::COLOR_GRAY2BGR);
  return result;
}

FilmStrip::FilmStrip(int columns, int width, std::size_t most)
    : columns_(std::max(1, columns)), width_(std::max(16, width)), most_(std::max<std::size_t>(2, most)) {}

std::size_t FilmStrip::nearest(const Reel& reel) {
  std::size_t found = 1;
  for (std::size_t k = 2; k < reel.size(); ++k)
    if (gap(reel, k) < gap(reel, found)) found = k;
  return found;
}

void FilmStrip::thin(Reel& reel, std::size_t most) {
  if (most == 0) return reel.clear();
  while (reel.size() > most) reel.erase(reel.begin() + static_cast<std::ptrdiff_t>(nearest(reel)));
}

bool FilmStrip::wants(std::int64_t frame, bool seen) const {
  const Reel& reel = reels_[seen ? 1 : 0];
  return reel.size() < most_ || frame - reel.back().frame >= gap(reel, nearest(reel));
}

void FilmStrip::add(std::int64_t frame, bool seen, const ImageView& picture) {
  if (picture.empty() || picture.channels != 3) return;
  Image small(width_, std::max(1, width_ * picture.height / picture.width), 3);
  cv::Mat target = drawn_on(small);
  cv::resize(matrix(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  Reel& reel = reels_[seen ? 1 : 0];
  reel.push_back({frame, std::move(small)});
  thin(reel, most_);
}

Image FilmStrip::picture() const {
  if (empty()) return {};
  Reel shown = reels_[1], between = reels_[0];
  thin(shown, most_ - std::min(between.size(), most_ / 4));
  thin(between, most_ - shown.size());
  shown.insert(shown.end(), between.begin(), between.end());
  std::ranges::sort(shown, {}, &Kept::frame);
  constexpr int kGap = 4;
  const int n = static_cast<int>(shown.size());
  const int columns = std::min(columns_, n);
  const int rows = (n + columns - 1) / columns;
  const Image& first = shown.front().picture;
  const int width = first.width + kGap;
  const int height = first.height + kGap;
  Image strip(columns * width + kGap, rows * height + kGap, 3);
  cv::Mat on = drawn_on(strip);
  for (int k = 0; k < n; ++k) {
    const Image& one = shown[static_cast<std::size_t>(k)].picture;
    if (one.width != first.width || one.height != first.height) continue;
    const cv::Rect place(kGap + k % columns * width, kGap + k / columns * height, one.width, one.height);
    matrix(one.view()).copyTo(on(place));
  }
  return strip;
}

}  // namespace mrroc::vsp
