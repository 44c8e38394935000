// The coordinator's eyes: readings of the virtual receptor that looks at the face which is shown to the camera.
#pragma once
#include <memory>
#include <optional>

#include "base/camera_config.hpp"
#include "base/link/process.hpp"
#include "mrroc/cube_face_reading_t.hpp"
#include "tasks/rubik/coordinator.hpp"

namespace mrroc::rubik {

/// Used by MP's thread.
class Eyes {
 public:
  /// @param camera  none: nothing is ever seen
  Eyes(link::Process& process, const std::optional<CameraSetup>& camera);

  /// The newest reading that is visible in macrostep i (rules R6, R7): in lock-step it is waited for.
  /// @throws FaultError peer_silent
  void read(std::int64_t i, Coordinator::Seen& V);

 private:
  link::Process& process_;
  std::optional<CameraSetup> camera_;
  std::unique_ptr<link::Inbox<cube_face_reading_t>> in_;
  link::Sources sources_;
};

/// A Port of the coordinator that fills in x.V. @tparam P  the Port for everything else
template <class P>
class SeeingPort {
 public:
  /// @param port, eyes  must outlive this one
  SeeingPort(P& port, Eyes& eyes) : port_(port), eyes_(eyes) {}
  /// The operations of a Port: those of `port`, and read() fills in x.V, too.
  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) { port_.dispatch(motion, y); }
  Outcome wait() { return port_.wait(); }
  void read(Coordinator::X& x) {
    port_.read(x);
    eyes_.read(x.i, x.V);
  }

 private:
  P& port_;
  Eyes& eyes_;
};

}  // namespace mrroc::rubik
