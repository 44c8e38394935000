#include "vsp/camera_loop.hpp"

#include <fmt/core.h>

#include "base/link/frame_store.hpp"
#include "base/link/real_time.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

constexpr std::string_view kPrefix = "vsp-";
constexpr std::chrono::seconds kStoreMade{60};  // as long as a system may take to assemble
/// With the wall clock: after processes that must be in time, and before the one that draws the next picture.
constexpr int kNice = 3;

/// Waits for the simulator to make the store; it may have shaders to compile first.
link::FrameReader open_store(link::Process& process, const std::string& key) {
  const link::NodeContext& context = process.context();
  const link::FrameStoreName name{
      .session = context.session, .session_id = context.session_id, .camera = key};
  std::optional<link::FrameReader> store;
  process.await(
      [&] {
        store = link::FrameReader::open(name);
        return store.has_value() || process.over();
      },
      link::Process::Clock::now() + kStoreMade);
  if (!store)
    throw FaultError(FaultCode::hardware_silent, fmt::format("camera {} has no store of frames", key));
  return std::move(*store);
}

/// @return the announcement that is looked at next, or null when it has not come: in lock-step that of picture i, with
///         the wall clock the newest one, so that nobody works off a heap of old pictures
const camera_frame_t* announced(const link::Process& process, const link::Inbox<camera_frame_t>& frames,
                                std::int64_t i) {
  if (process.lock_step()) return frames.at(i);
  const camera_frame_t* const newest = frames.newest();
  return newest && newest->header.stamp >= i ? newest : nullptr;
}

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

std::string camera_of(const link::Process& process) {
  const std::string& name = process.context().name;
  if (!name.starts_with(kPrefix) || name.size() == kPrefix.size())
    throw FaultError(FaultCode::bad_usage, "a camera's receptor is called vsp-CAMERA, not " + name);
  return name.substr(kPrefix.size());
}

void run_camera(link::Process& process, const std::string& key, const CameraModel& camera,
                const PictureAnswer& answer, const std::function<void()>& at_end, PictureSetting* setting) {
  const auto frames = process.inbox<camera_frame_t>(key + ".frame");
  const link::Sources sources{frames.get()};
  link::FrameReader store = open_store(process, key);
  if (store.shape().width != camera.width || store.shape().height != camera.height)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("the pictures of camera {} are {} x {}, its model says {} x {}", key,
                                 store.shape().width, store.shape().height, camera.width, camera.height));
  if (!process.assemble()) return;
  if (!process.lock_step()) link::become_background(kNice);
  link::Frame frame;
  for (std::int64_t i = 0;; ++i) {
    const camera_frame_t* m{};
    process.await_from(sources, FaultCode::peer_silent, [&] {
      m = announced(process, *frames, i);
      if (m && m->last == 0 && setting != nullptr && !setting->here(m->step)) m = nullptr;
      return m || process.phase() == link::Phase::finished;
    });
    if (!m) break;
    process.report_skipped(m->header.stamp - i);
    i = m->header.stamp;
    if (m->last != 0) {
      answer(nullptr, i, m->step, 0, true);  // no picture goes with the last announcement
      break;
    }
    if (take(store, *m, process.lock_step(), frame)) {
      const ImageView picture = frame.image.view();
      answer(&picture, i, m->step, frame.t, false);
    } else {
      process.report_skipped(1);
      answer(nullptr, i, m->step, 0, false);
    }
    process.report_progress(i, m->step);
  }
  at_end();
  process.report_done();  // while the link of the pictures is still there
  process.stay();
}

CameraFilm::CameraFilm(std::string key, std::string object, ObjectShape shape, const CameraModel& camera,
                       const Config& config)
    : key_(std::move(key)),
      object_(std::move(object)),
      shape_(std::move(shape)),
      camera_(camera),
      directory_(config.text("film.directory", "")) {}

void CameraFilm::see(const ImageView& picture, const CameraReading& reading, const std::string& text) {
  if (directory_.empty() || !strip_.wants(reading.frame, reading.seen)) return;
  Image drawn = in_colour(picture);
  annotate(drawn, reading, camera_, shape_,
           text.empty() ? fmt::format("{} {}", key_, reading.frame)
                        : fmt::format("{} {}  {}", key_, reading.frame, text));
  strip_.add(reading.frame, reading.seen, drawn.view());
}

void CameraFilm::write() const {
  if (strip_.empty()) return;
  write_picture(directory_ / fmt::format("{}_{}.png", key_, object_), strip_.picture().view());
}

}  // namespace mrroc::vsp
