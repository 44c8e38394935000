#include <fmt/format.h>

#include "base/camera_config.hpp"
#include "base/link/frame_store.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "mrroc/camera_reading_t.hpp"
#include "vsp/image_receptor.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

constexpr std::string_view kPrefix = "vsp-";

std::string camera_of(const link::Process& process) {
  const std::string& name = process.membership().name;
  if (!name.starts_with(kPrefix) || name.size() == kPrefix.size())
    throw FaultError(FaultCode::bad_usage, "a camera's receptor is called vsp-CAMERA, not " + name);
  return name.substr(kPrefix.size());
}

/// What the camera saw, with what was found drawn in, for the run folder.
class Film {
 public:
  Film(const ImageReceptor& receptor, const CameraModel& camera, const Config& config, const std::string& key)
      : receptor_(receptor), camera_(camera), key_(key), directory_(config.text("film.directory", "")) {}

  void see(const ImageView& picture, const CameraReading& reading) {
    if (directory_.empty() || !strip_.wants(reading.frame)) return;
    Image drawn = in_colour(picture);
    const double distance = reading.T_CG.p.norm();
    annotate(drawn, reading, camera_, receptor_.shape,
             reading.seen ? fmt::format("{} {}  {:.3f} m", key_, reading.frame, distance)
                          : fmt::format("{} {}", key_, reading.frame));
    strip_.add(drawn.view());
  }
  void write() const {
    if (strip_.empty()) return;
    const auto file = directory_ / fmt::format("{}_{}.png", key_, receptor_.object);
    write_picture(file, strip_.picture().view());
  }

 private:
  const ImageReceptor& receptor_;
  CameraModel camera_;
  std::string key_;
  std::filesystem::path directory_;
  FilmStrip strip_;
};

/// Takes the announced picture out of the store.
/// @return false when it came too late, which happens with the wall clock only
bool take(link::FrameReader& store, const camera_frame_t& announced, bool lock_step, link::Frame& frame) {
  const std::int64_t number = announced.header.stamp;
  switch (store.read(announced.slot, number, frame)) {
    case link::FrameFate::read:
      break;
    case link::FrameFate::overwritten:
      if (!lock_step) return false;
      throw FaultError(FaultCode::malformed_message,
                       fmt::format("picture {} was written over before it was read", number));
    case link::FrameFate::malformed:
      throw FaultError(FaultCode::malformed_message,
                       fmt::format("the frame store has no picture {}", number));
  }
  if (frame.step != announced.step)
    throw FaultError(FaultCode::malformed_message,
                     fmt::format("picture {} is of another step than announced", number));
  return true;
}

}  // namespace

void run_receptor(const ImageReceptor& receptor, link::Process& process, const Config& config) {
  process.needs_unlogged("the pictures of cameras");
  const std::string key = camera_of(process);
  const CameraModel camera = read_camera_model(config, key);
  const ImageDetector detect = receptor.make(camera, config);
  Film film(receptor, camera, config, key);
  const auto frames = process.inbox<camera_frame_t>(key + ".frame");
  const link::Sources sources{frames.get()};
  const auto readings = process.outbox<camera_reading_t>(key + "." + receptor.object);
  const link::Membership& member = process.membership();
  link::FrameReader store({.session = member.session, .session_id = member.session_id, .camera = key});
  if (store.shape().width != camera.width || store.shape().height != camera.height)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("the pictures of camera {} are {} x {}, its model says {} x {}", key,
                                 store.shape().width, store.shape().height, camera.width, camera.height));
  if (!process.assemble()) return;
  link::Frame frame;
  for (std::int64_t i = 0;; ++i) {
    const camera_frame_t* m{};
    process.await_from(sources, FaultCode::peer_silent, [&] {
      m = process.lock_step() ? frames->at(i) : frames->next(i);
      return m || process.phase() == link::Phase::finished;
    });
    if (!m) break;
    process.report_skipped(m->header.stamp - i);
    i = m->header.stamp;
    CameraReading reading;
    reading.frame = i;
    reading.step = m->step;
    if (m->last != 0) {
      camera_reading_t over = to_message(reading);  // no picture goes with the last announcement
      over.last = 1;
      readings->publish(over, i);
      break;
    }
    if (take(store, *m, process.lock_step(), frame)) {
      reading = detect(frame.image.view(), i, m->step);
      film.see(frame.image.view(), reading);
    } else {
      process.report_skipped(1);
    }
    readings->publish(to_message(reading), i);
    process.report_progress(i, m->step);
  }
  film.write();
  process.report_done();
  process.stay();
}

}  // namespace mrroc::vsp
