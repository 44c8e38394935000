#include "sim/camera/camera_station.hpp"
#include "base/counted.hpp"
#include "sim/world.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>

namespace mrroc::sim {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kMoment{20};

/// A camera as the others see it, and as it casts a shadow: behind its own eye.
camera::Body housing(const Pose& T_UC) {
  camera::Body b;
  b.size = {0.036, 0.036, 0.05};
  b.T_UB = T_UC * Pose{Matrix3::Identity(), {0, 0, -0.027}};
  b.colour = {0.1, 0.1, 0.11};
  return b;
}

/// @return where a camera really is
Pose place(const SimulatedCamera& k, const View& view) {
  return view.mount(k.setup) * (k.setup.place * k.error);
}

CameraFault fault_at(const CameraFaults& faults, double time) {
  if (contains(faults.silent, time)) return CameraFault::silent;
  if (contains(faults.black, time)) return CameraFault::black;
  if (contains(faults.frozen, time)) return CameraFault::frozen;
  return contains(faults.hangs, time) ? CameraFault::hangs : CameraFault::none;
}

/// Steps of the instants of a picture, from its own.
std::int64_t offset(const SimulatedCamera& k, int instant) {
  return k.instants == 1 ? 0 : instant * k.exposure / (k.instants - 1) - k.exposure / 2;
}

}  // namespace

CameraStation::CameraStation(link::Process& process, const std::vector<PlacedCamera>& cameras)
    : process_(process) {
  for (const PlacedCamera& each : cameras) {
    Eye eye;
    eye.k = each.camera;
    eye.view = each.view;
    eye.worker = std::make_unique<CameraWorker>(eye.k, process.context());
    eye.out = process.outbox<camera_frame_t>(eye.k.setup.key + ".frame");
    const auto is_shown = [&](const PlacedCamera& c) {
      return c.camera.setup.key == each.camera.faults.shows;
    };
    const auto shown = std::ranges::find_if(cameras, is_shown);
    eye.shown = shown == cameras.end() ? eyes_.size() : static_cast<std::size_t>(shown - cameras.begin());
    if (std::ranges::find(views_, each.view) == views_.end()) views_.push_back(each.view);
    if (eye.k.setup.on_demand && !setting_in_)
      setting_in_ = std::make_unique<link::IncomingLink<SensorSetting>>(process, kCamerasSetting);
    eyes_.push_back(std::move(eye));
  }
}

link::Sources CameraStation::sources() const {
  return setting_in_ ? link::Sources{&setting_in_->inbox()} : link::Sources{};
}

void CameraStation::obey(std::int64_t i) {
  if (!setting_in_) return;
  setting_in_->receive(i);
  wanted_ = setting_in_->image().value.mode == kTakePictures;
}

void CameraStation::begin() {
  for (Eye& eye : eyes_) eye.worker->hide();
}

void CameraStation::deliver(std::int64_t step) {
  for (Eye& eye : eyes_) {
    if (!eye.worker->busy()) continue;
    const std::int64_t due = eye.worker->step() + std::min(eye.k.setup.latency, eye.k.setup.period);
    hand_over(eye, process_.lock_step() && step >= due);
  }
}

void CameraStation::hand_over(Eye& eye, bool must) {
  if (!eye.worker->busy()) return;
  if (!eye.worker->ready()) {
    if (!must) return;
    wait_for(eye);
  }
  const auto [frame, message] = eye.worker->finish();
  eye.told = frame;
  eye.out->publish(message, frame);
}

/// The other threads and processes hear meanwhile that the simulator lives, and wait no longer than for other
/// messages.
void CameraStation::wait_for(Eye& eye) {
  const auto begun = Clock::now();
  const auto waited = [&] { return Clock::now() - begun; };
  const std::chrono::milliseconds timeout = process_.context().timeout;
  while (!eye.worker->ready_within(kMoment)) {
    process_.poll();
    if (timeout.count() == 0 || waited() < timeout) continue;
    const std::string text =
        fmt::format("camera {}: the picture of step {} has not been drawn for {:.0f} s", eye.k.setup.key,
                    eye.worker->step(), std::chrono::duration<double>(timeout).count());
    process_.log(text, FaultCode::no_renderer);  // the thread that draws may hold up the end of this one
    throw FaultError(FaultCode::no_renderer, text);
  }
  ++eye.waits;
  eye.waited += std::chrono::duration<double>(waited()).count();
}

void CameraStation::look(std::int64_t step) {
  for (Eye& eye : eyes_) look(eye, step);
  for (View* const view : views_) view->tell(step);
}

void CameraStation::look(Eye& eye, std::int64_t step) {
  const std::int64_t period = eye.k.setup.period;
  // The picture whose exposure this step may belong to.
  const std::int64_t frame = (step + eye.k.exposure / 2) / period;
  const Eye& shown = eyes_[eye.shown];
  CameraJob& job = eye.next;
  job.frame = frame;
  job.step = frame * period;
  const bool wanted = wanted_ || !eye.k.setup.on_demand;
  job.fault = wanted ? fault_at(eye.k.faults, static_cast<double>(job.step) * kStep) : CameraFault::silent;
  for (int instant = 0; instant < eye.k.instants; ++instant)
    if (job.step + offset(eye.k, instant) == step)
      job.exposure.push_back({scene(shown, step), place(shown.k, *shown.view)});
  if (job.step + offset(eye.k, eye.k.instants - 1) != step) return;
  if (eye.worker->busy()) {  // with the wall clock only
    ++eye.left_out;
    process_.report_skipped(1);
    job.exposure.clear();
    return;
  }
  ++eye.frames;
  eye.worker->begin(std::exchange(job, {}));
  if (process_.lock_step() && eye.k.setup.latency == 0) hand_over(eye, true);
}

camera::Scene CameraStation::scene(const Eye& eye, std::int64_t step) const {
  camera::Scene scene = eye.view->scene(eye.k.setup, step);
  for (const Eye& each : eyes_)
    if (each.view == eye.view) scene.bodies.push_back(housing(place(each.k, *each.view)));
  return scene;
}

void CameraStation::end() {
  for (Eye& eye : eyes_) {
    hand_over(eye, true);
    camera_frame_t last{};
    last.slot = -1;
    last.last = 1;
    eye.out->publish(last, eye.told + 1);
    process_.log(
        fmt::format("camera {}: {}, {} left out; the simulator waited for {} of them, {:.2f} s in all",
                    eye.k.setup.key, counted(eye.frames, "picture"), eye.left_out, eye.waits, eye.waited));
  }
}

}  // namespace mrroc::sim
