#include "tasks/rubik/camera_input.hpp"

namespace mrroc::rubik {

CameraInput::CameraInput(link::Process& process, const std::optional<CameraSetup>& camera)
    : process_(process), camera_(camera) {
  if (!camera_) return;
  in_ = process.inbox<cube_face_reading_t>(camera_->key + ".cube_face");
  sources_ = {in_.get()};
  setting_out_ =
      std::make_unique<link::OutgoingLink<CubeFaceSetting>>(process, camera_->key + ".cube_face.setting");
}

link::OtherLinks CameraInput::others() {
  link::OtherLinks others;
  if (setting_out_) others.outgoing = {setting_out_.get()};
  return others;
}

void CameraInput::ask(const CubeFaceSetting& V) {
  if (setting_out_) setting_out_->set(V);
}

void CameraInput::read(std::int64_t i, SeenFace& V) {
  if (!camera_) return;
  const std::int64_t step = i * kPacing.n_s;
  const std::int64_t frame = (step - camera_->latency) / camera_->period;
  if (step < camera_->latency) return;
  if (process_.lock_step())
    process_.await_from(sources_, FaultCode::peer_silent, [&] { return in_->at(frame) || process_.over(); });
  const cube_face_reading_t* const exact = in_->at(frame);
  const cube_face_reading_t* const m = exact || process_.lock_step() ? exact : in_->newest();
  if (!m || m->last != 0) return;
  V.there = true;
  V.reading = from_message(*m);
}

}  // namespace mrroc::rubik
