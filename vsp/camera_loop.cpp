#include "vsp/camera_loop.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>

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

/// One camera's announcements and pictures.
class Stream {
 public:
  Stream(link::Process& process, const WatchedCamera& camera)
      : in_(process.inbox<camera_frame_t>(camera.key + ".frame")), store_(open_store(process, camera.key)) {
    if (store_.shape().width != camera.model.width || store_.shape().height != camera.model.height)
      throw FaultError(
          FaultCode::bad_configuration,
          fmt::format("the pictures of camera {} are {} x {}, its model says {} x {}", camera.key,
                      store_.shape().width, store_.shape().height, camera.model.width, camera.model.height));
  }

  [[nodiscard]] const link::InboxBase* source() const { return in_.get(); }
  [[nodiscard]] const camera_frame_t* at(std::int64_t i) const { return in_->at(i); }
  [[nodiscard]] const camera_frame_t* newest() const { return in_->newest(); }
  /// @return false when the picture came too late
  bool take(const camera_frame_t& announced, bool lock_step) {
    return vsp::take(store_, announced, lock_step, frame_);
  }
  [[nodiscard]] const link::Frame& frame() const { return frame_; }

 private:
  std::unique_ptr<link::Inbox<camera_frame_t>> in_;
  link::FrameReader store_;
  link::Frame frame_;  // taken last
};

/// Announcements of one number, by camera.
using Announced = std::vector<const camera_frame_t*>;

/// @return announcements of picture i; none when a camera has none
Announced of_number(const std::vector<Stream>& streams, std::int64_t i) {
  Announced all;
  for (const Stream& each : streams)
    if (const camera_frame_t* const m = each.at(i)) all.push_back(m);
  return all.size() == streams.size() ? all : Announced{};
}

/// @return those that are looked at next, or none when they have not all come: in lock-step those of picture i, with the wall
///         clock the newest that every camera has, so that nobody works off a heap of old pictures; each camera leaves out
///         what it cannot draw in time. A last one counts for all cameras, since the others' may have another number
Announced announced(const link::Process& process, const std::vector<Stream>& streams, std::int64_t i) {
  if (process.lock_step()) return of_number(streams, i);
  std::int64_t common = std::numeric_limits<std::int64_t>::max();
  for (const Stream& each : streams) {
    const camera_frame_t* const newest = each.newest();
    if (newest && newest->last != 0) return Announced(streams.size(), newest);
    common = std::min(common, newest ? newest->header.stamp : -1);
  }
  for (; common >= i; --common)
    if (Announced all = of_number(streams, common); !all.empty()) return all;
  return {};
}

void check_together(const Announced& all) {
  for (const camera_frame_t* const m : all)
    if (m->step != all.front()->step)
      throw FaultError(FaultCode::malformed_message,
                       fmt::format("the pictures {} are of different steps", m->header.stamp));
}

}  // namespace

std::string camera_of(const link::Process& process) {
  const std::string& name = process.context().name;
  if (!name.starts_with(kPrefix) || name.size() == kPrefix.size())
    throw FaultError(FaultCode::bad_usage, "a camera's receptor is called vsp-CAMERA, not " + name);
  return name.substr(kPrefix.size());
}

void run_cameras(link::Process& process, std::span<const WatchedCamera> cameras, const PicturesAnswer& answer,
                 const std::function<void()>& at_end, PictureSetting* setting) {
  std::vector<Stream> streams;
  link::Sources sources;
  for (const WatchedCamera& camera : cameras) {
    streams.emplace_back(process, camera);
    sources.push_back(streams.back().source());
  }
  if (!process.assemble()) return;
  if (!process.lock_step()) link::become_background(kNice);
  for (std::int64_t i = 0;; ++i) {
    Announced all;
    process.await_from(sources, FaultCode::peer_silent, [&] {
      all = announced(process, streams, i);
      const bool pictures = !all.empty() && all.front()->last == 0;
      if (pictures && setting != nullptr && !setting->here(all.front()->step)) all.clear();
      return !all.empty() || process.phase() == link::Phase::finished;
    });
    if (all.empty()) break;
    process.report_skipped(all.front()->header.stamp - i);
    i = all.front()->header.stamp;
    const std::int64_t step = all.front()->step;
    if (std::ranges::any_of(all, [](const camera_frame_t* m) { return m->last != 0; })) {
      answer({}, i, step, 0, true);  // no picture goes with the last announcement
      break;
    }
    check_together(all);
    const bool given = std::ranges::none_of(all, [](const camera_frame_t* m) { return m->slot < 0; });
    bool taken = given;
    for (std::size_t k = 0; given && k < streams.size(); ++k)
      taken = streams[k].take(*all[k], process.lock_step()) && taken;
    if (taken) {
      std::vector<ImageView> pictures;
      for (const Stream& each : streams) pictures.push_back(each.frame().image.view());
      answer(pictures, i, step, streams.front().frame().t, false);
    } else {
      if (given) process.report_skipped(1);
      answer({}, i, step, 0, false);
    }
    process.report_progress(i, step);
  }
  at_end();
  process.report_done();  // while the link of the pictures is still there
  process.stay();
}

void run_camera(link::Process& process, const std::string& key, const CameraModel& camera,
                const PictureAnswer& answer, const std::function<void()>& at_end, PictureSetting* setting) {
  const WatchedCamera watched{key, camera};
  run_cameras(
      process, {&watched, 1},
      [&answer](std::span<const ImageView> pictures, std::int64_t frame, std::int64_t step, double t,
                bool last) { answer(pictures.empty() ? nullptr : pictures.data(), frame, step, t, last); },
      at_end, setting);
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
