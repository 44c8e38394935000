// Measures detection in adverse pictures, and the work per picture, also against OpenCV's own detector.
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/vision.hpp"
#include "sim/camera/renderer.hpp"
#include "test/vsp/adverse.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"

namespace mrroc::bench {
namespace {

using test::AdversePictures;

struct Adverse {
  int false_poses{};
  double longest{};  // of any detection [ms]
};

/// OpenCV's own threads would hide work from thread_ms().
class OneThread {
 public:
  OneThread() { cv::setNumThreads(1); }
  ~OneThread() { cv::setNumThreads(threads_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int threads_{cv::getNumThreads()};
};

// The same picture is the same work, but a busy machine makes it take longer: a detection that was long is done again,
// and the median counts.
constexpr double kLong = 20;  // [ms]
constexpr int kRepeats = 4;

template <class Sensor>
double repeated_ms(Sensor& sensor, const ImageView& picture, double first) {
  if (first <= kLong) return first;
  std::vector<double> all{first};
  for (int k = 0; k < kRepeats; ++k) {
    sensor.forget();
    const double begun = thread_ms();
    sensor.detect(picture, 0, 0);
    all.push_back(thread_ms() - begun);
  }
  return quantile(all, 0.5);
}

/// @param before  picture that was seen just before, as in a run; none: the first one of a run
template <class Sensor>
void show(Sensor& sensor, const Image* before, const test::AdversePicture& picture, Adverse& result) {
  sensor.forget();
  if (before) sensor.detect(before->view(), 0, 0);
  const double begun = thread_ms();
  const CameraReading reading = sensor.detect(picture.image.view(), 1, 20);
  const double ms = thread_ms() - begun;
  result.longest = std::max(result.longest, repeated_ms(sensor, picture.image.view(), ms));
  result.false_poses += test::is_false(reading, picture) ? 1 : 0;
}

// Both receptors look at every picture; to one of them there is nothing to be seen at all.
Adverse adverse_pictures(int pictures) {
  const CameraModel model = web_camera();
  vsp::ChessboardSensor chessboard(model);
  vsp::AprilTagSensor apriltag(model);
  Adverse result;
  for (const auto object : {AdversePictures::Object::chessboard, AdversePictures::Object::apriltag}) {
    AdversePictures source(model, object, 77);
    for (int k = 0; k < pictures / 2; ++k) {
      test::AdversePicture picture = source.next();
      const auto own = picture.T_CG;
      const bool board = object == AdversePictures::Object::chessboard;
      const Image faultless = k % 2 == 0 ? source.faultless() : Image{};
      const Image* before = faultless.data.empty() ? nullptr : &faultless;
      picture.T_CG = board ? own : std::nullopt;
      show(chessboard, before, picture, result);
      picture.T_CG = board ? std::nullopt : own;
      show(apriltag, before, picture, result);
    }
  }
  return result;
}

struct Comparison {
  double own{};    // [ms], sum
  double stock{};  // [ms], sum
  double own_found{};
  double stock_found{};
};

void compare(vsp::ChessboardSensor& sensor, const Image& picture, Comparison& c, double& longest) {
  sensor.forget();
  double begun = thread_ms();
  const bool seen = sensor.detect(picture.view(), 0, 0).seen;
  const double own = thread_ms() - begun;
  begun = thread_ms();
  cv::Mat all(picture.height, picture.width, CV_8UC(picture.channels),
              const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat grey = all;
  if (picture.channels == 3) cv::cvtColor(all, grey, cv::COLOR_BGR2GRAY);
  std::vector<cv::Point2f> corners;
  const bool found = cv::findChessboardCorners(grey, {kBoard.columns, kBoard.rows}, corners);
  if (found)
    cv::cornerSubPix(grey, corners, {5, 5}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01});
  const double stock = thread_ms() - begun;
  longest = std::max(longest, repeated_ms(sensor, picture.view(), own));
  c.own += own;
  c.stock += stock;
  if (seen && found) {
    c.own_found += own;
    c.stock_found += stock;
  }
}

// The pictures of a run: the board near and far, and now and then something else.
Comparison against_opencv(double& longest) {
  constexpr int kNear = 60;
  constexpr int kFar = 12;
  constexpr int kAdverse = 16;
  const CameraModel model = web_camera();
  camera::Renderer renderer(model, camera::exact_profile());
  ViewedCell cell(ViewedCell::Object::board, 31);
  vsp::ChessboardSensor sensor(model);
  Comparison c;
  for (int k = 0; k < kNear + kFar; ++k) {
    const Pose T = k < kNear ? cell.pose(model, 0.3, 1) : cell.pose(model, 1.5, 2);
    const Image picture = renderer.render(cell.scene(), cell.camera(T), k);
    compare(sensor, picture, c, longest);
  }
  AdversePictures adverse(model, AdversePictures::Object::chessboard, 5);
  for (int k = 0; k < kAdverse; ++k) compare(sensor, adverse.next().image, c, longest);
  return c;
}

}  // namespace

Figures run_detection_figures() {
  const OneThread one_thread;
  constexpr int kAdverse = 10'000;
  Adverse adverse = adverse_pictures(kAdverse);
  const Comparison c = against_opencv(adverse.longest);
  return {
      {"false_poses", static_cast<double>(adverse.false_poses), "",
       "poses claimed falsely in 10,000 adverse pictures, by both receptors"},
      {"detect_ms_max", adverse.longest, "ms", "processor time of the longest detection, found or not"},
      {"detect_vs_opencv", c.own / c.stock, "",
       "mean time against findChessboardCorners and cornerSubPix, same pictures"},
      {"detect_vs_opencv_found", c.own_found / c.stock_found, "",
       "the same over the pictures in which both found the board"},
  };
}

}  // namespace mrroc::bench
