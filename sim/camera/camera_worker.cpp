#include <utility>

#include "sim/camera/camera_station.hpp"

namespace mrroc::sim {

CameraWorker::CameraWorker(const SimulatedCamera& camera, const link::Membership& membership)
    : renderer_(camera.setup.model, camera.profile),
      store_({membership.session, membership.session_id, camera.setup.key},
             {camera.setup.model.width, camera.setup.model.height, camera.profile.channels}),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

CameraWorker::~CameraWorker() = default;

void CameraWorker::begin(CameraJob job) {
  step_ = job.step;
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
  }
  changed_.notify_all();
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

void CameraWorker::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return job_.has_value(); })) {
    const CameraJob& job = *job_;  // untouched by others until it is gone
    lock.unlock();
    int slot = -1;
    std::exception_ptr error;
    try {
      const Image image = renderer_.render(job.exposure, job.frame);
      slot = store_.write(job.frame, job.step, static_cast<double>(job.step) * kStep, image.view());
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
