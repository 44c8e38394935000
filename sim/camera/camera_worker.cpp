#include <algorithm>
#include <utility>

#include "base/link/real_time.hpp"
#include "sim/camera/camera_station.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {
namespace {

/// With the wall clock, of the threads that draw: processes that must be in time come first.
constexpr int kNice = 5;

}  // namespace

CameraWorker::CameraWorker(const SimulatedCamera& camera, const link::NodeContext& context)
    : renderer_(camera.setup.model, camera.profile),
      last_(camera.setup.model.width, camera.setup.model.height, camera.profile.channels),
      store_({context.session, context.session_id, camera.setup.key},
             {camera.setup.model.width, camera.setup.model.height, camera.profile.channels}),
      thread_([this, wall = context.clock == ClockKind::wall](const std::stop_token& stop) {
        if (wall) link::become_background(kNice);
        work(stop);
      }) {}

CameraWorker::~CameraWorker() = default;

void CameraWorker::begin(CameraJob job) {
  step_ = job.step;
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
  }
  changed_.notify_all();
}

bool CameraWorker::ready() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  return lock && step_.has_value() && !job_.has_value();
}

bool CameraWorker::ready_within(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return step_.has_value() && changed_.wait_for(lock, time, [this] { return !job_.has_value(); });
}

std::pair<std::int64_t, camera_frame_t> CameraWorker::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !job_.has_value(); });
  if (error_) std::rethrow_exception(error_);
  camera_frame_t message{};
  message.step = *std::exchange(step_, std::nullopt);
  message.slot = slot_;
  return {frame_, message};
}

int CameraWorker::make(const CameraJob& job) {
  if (job.fault == CameraFault::silent) return -1;
  if (job.fault != CameraFault::hangs || shown_.empty()) shown_ = job.exposure;
  if (job.fault == CameraFault::black)
    std::ranges::fill(last_.data, std::uint8_t{});
  else if (job.fault != CameraFault::frozen || !begun_)
    last_ = renderer_.render(shown_, job.frame);
  begun_ = true;
  return store_.write(job.frame, job.step, static_cast<double>(job.step) * kStep, last_.view());
}

void CameraWorker::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return job_.has_value(); })) {
    const CameraJob& job = *job_;  // untouched by others until it is gone
    lock.unlock();
    int slot = -1;
    std::exception_ptr error;
    try {
      slot = make(job);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    slot_ = slot;
    frame_ = job_->frame;
    error_ = error;
    job_.reset();
    changed_.notify_all();
  }
}

}  // namespace mrroc::sim
