#include "tasks/visual_servo/camera_links.hpp"

#include <algorithm>

#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"
#include "tasks/visual_servo/servo.hpp"

namespace mrroc::visual_servo {
namespace {

void write(const AngleAxisPose& from, double (&to)[6]) { std::copy_n(from.data(), 6, to); }

}  // namespace

void EffectorPath::add(std::int64_t last, std::span<const step_sample_t> poses) {
  if (poses.empty()) return;
  const std::int64_t first = last + 1 - static_cast<std::int64_t>(poses.size());
  if (end_ == 0 || first > end_) first_ = first;  // a gap: what was before is of no use
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::int64_t step = first + static_cast<std::int64_t>(k);
    if (step >= 0)
      pose_[static_cast<std::size_t>(step % kKept)] = Eigen::Map<const AngleAxisPose>(poses[k].T_0E);
  }
  end_ = last + 1;
  first_ = std::max(first_, end_ - kKept);
}

Pose EffectorPath::at(std::int64_t step) const {
  if (end_ == 0) return {};
  const std::int64_t near = std::clamp(step, std::max<std::int64_t>(0, first_), end_ - 1);
  return pose_from_angle_axis(pose_[static_cast<std::size_t>(near % kKept)]);
}

CameraLinks::CameraLinks(link::Process& process, const CameraLinkNames& names, const Parameters& parameters)
    : process_(process),
      k_(parameters),
      samples_in_(process.inbox<step_samples_t, kSampleMessages>(names.robot + ".samples")),
      report_out_(process.outbox<servo_report_t>(names.robot + ".servo")) {
  for (std::size_t n = 0; n < kCameras; ++n)
    if (k_.camera[n].used) reading_in_[n] = process.inbox<camera_reading_t>(names.reading[n]);
}

link::OtherLinks CameraLinks::others() {
  link::OtherLinks others{{samples_in_.get()},
                          [this](std::int64_t i, std::int64_t step) { return here(i, step); }};
  for (const auto& in : reading_in_)
    if (in) others.sources.push_back(in.get());
  return others;
}

void CameraLinks::take_samples() {
  while (const step_samples_t* const m =
             process_.lock_step() ? samples_in_->at(taken_ + 1) : samples_in_->next(taken_ + 1)) {
    const auto n = std::clamp<std::int32_t>(m->n, 0, static_cast<std::int32_t>(std::size(m->sample)));
    path_.add(m->step, {m->sample, static_cast<std::size_t>(n)});
    taken_ = m->header.stamp;
    if (!m->more) sampled_ = m->macrostep;
  }
}

bool CameraLinks::here(std::int64_t i, std::int64_t step) {
  take_samples();
  if (sampled_ < i) return false;
  for (std::size_t n = 0; n < kCameras; ++n) {
    const std::int64_t frame = newest_frame(k_.camera[n], step);
    if (reading_in_[n] && frame >= 0 && !reading_in_[n]->at(frame)) return false;
  }
  return true;
}

void CameraLinks::read(Arm::X& x) {
  take_samples();
  for (std::size_t n = 0; n < kCameras; ++n) {
    if (!reading_in_[n]) continue;
    const camera_reading_t* const m = process_.lock_step()
                                          ? reading_in_[n]->at(newest_frame(k_.camera[n], x.e.step))
                                          : reading_in_[n]->newest();
    if (m) take(x.V.camera[n], *m);
  }
}

void CameraLinks::take(CameraImage& image, const camera_reading_t& m) const {
  if (!finite(m)) throw FaultError(FaultCode::malformed_message, "camera reading: a number is not finite");
  image.there = true;
  image.reading = from_message(m);
  image.T_0E = path_.at(image.reading.step);
}

void CameraLinks::report(const Motion<Arm>& motion, const Arm::X& x, const Arm::Y& y, std::int64_t stamp) {
  servo_report_t r{};
  r.step = x.e.step;
  r.m = motion.m;
  r.refused = not_made(x);
  for (std::size_t n = 0; n < kCameras; ++n) {
    r.seen[n] = sees(x, static_cast<Camera>(n));
    r.frame[n] = x.V.camera[n].there ? x.V.camera[n].reading.frame : -1;
  }
  std::ranges::copy(x.e.T_0E, r.T_0E);
  write(angle_axis_from_pose(y.c.e), r.e);
  write(angle_axis_from_pose(y.c.under_way), r.T_dc);
  const ObjectMotion motion_of_G = significant_motion(x.c.k.track, y.c.track);
  std::copy_n(motion_of_G.v.data(), 3, r.v);
  std::copy_n(motion_of_G.omega.data(), 3, r.v + 3);
  report_out_->publish(r, stamp);
}

ServoPort::ServoPort(ecp::SoloPort<Arm>& arm, CameraLinks& cameras) : arm_(arm), cameras_(cameras) {
  // The arm reads after the end of the program, and of this port, too.
  arm.also({.read = [&arm, &cameras](Arm::X& x) {
    x.waiting = static_cast<int>(arm.links().client().backlog());
    x.parts.reset();
    if (const auto sent = arm.sent_parts())
      x.parts = {ecp::displacement_of((*sent)[0]), ecp::displacement_of((*sent)[1])};
    cameras.read(x);
  }});
}

void ServoPort::dispatch(const Motion<Arm>& motion, const Arm::Y& y) {
  cameras_.report(motion, seen_, y, arm_.links().i() + 1);
  arm_.dispatch(motion, y);
}

void ServoPort::read(Arm::X& x) {
  arm_.read(x);
  seen_ = x;
}

}  // namespace mrroc::visual_servo
