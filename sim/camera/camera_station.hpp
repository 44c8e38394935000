// The simulator's cameras: takes snapshots when pictures are due, has them drawn beside the simulation, and hands them
// to the receptors.
#pragma once
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/link/frame_store.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "sim/camera/config.hpp"
#include "sim/camera/view.hpp"

namespace mrroc::sim {

/// What a camera does instead of giving the picture that it is told to take.
enum class CameraFault : std::uint8_t {
  none,
  silent,  ///< there is no picture
  black,   ///< it shows nothing
  frozen,  ///< it is the last one again
  hangs    ///< it shows what the last one showed
};

/// A picture that is to be drawn, or has been.
struct CameraJob {
  std::int64_t frame{};  ///< number of the picture, 0, 1, 2... of the camera
  std::int64_t step{};   ///< of the effector drivers at which it is taken: the middle of the exposure
  std::vector<camera::Instant> exposure;  ///< snapshots so far, one or more when it is drawn
  CameraFault fault{};                    ///< then
};

/// One camera: a thread that draws, and the store into which it draws. With the wall clock the thread is in nobody's way:
/// it draws when nobody else has something to do in time. What a picture shows depends on its snapshots,
/// its number and the seed alone, whichever thread comes first.
class CameraWorker {
 public:
  /// @throws FaultError no_renderer, cannot_write, session_in_use; std::invalid_argument  see camera::Renderer
  CameraWorker(const SimulatedCamera& camera, const link::NodeContext& context);
  /// Waits for the picture that is being drawn.
  ~CameraWorker();
  CameraWorker(const CameraWorker&) = delete;
  CameraWorker& operator=(const CameraWorker&) = delete;

  /// Every receptor has opened the store.
  void hide() { store_.hide(); }
  /// Begins a picture. There must be none under way.
  void begin(CameraJob job);
  /// @return whether a picture has been begun and not been taken
  [[nodiscard]] bool busy() const { return step_.has_value(); }
  /// @return step of that picture
  [[nodiscard]] std::int64_t step() const { return step_.value_or(0); }
  /// @return whether that picture is ready: finish() will not wait. Does not wait itself
  [[nodiscard]] bool ready();
  /// @return whether that picture is ready, or gets ready in that time
  [[nodiscard]] bool ready_within(std::chrono::milliseconds time);
  /// Waits for the picture. @return what to tell about it; slot -1: the camera gives none @throws what drawing or storing it threw
  [[nodiscard]] std::pair<std::int64_t, camera_frame_t> finish();

 private:
  void work(const std::stop_token& stop);
  /// @return the slot in which the picture lies; -1: there is none
  int make(const CameraJob& job);

  camera::Renderer renderer_;
  // Only for the thread that draws:
  Image last_;                          // picture that was made last
  bool begun_{};                        // there is one
  std::vector<camera::Instant> shown_;  // by the last picture that showed what there was
  link::FrameWriter store_;
  std::optional<std::int64_t> step_;  // of the picture under way; only for the simulator's thread

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<CameraJob> job_;  // begun, not ready
  int slot_{-1};
  std::int64_t frame_{};
  std::exception_ptr error_;
  std::jthread thread_;  // the last one: it uses everything above
};

/// A camera with what it looks at.
struct PlacedCamera {
  SimulatedCamera camera;
  View* view{};  ///< not null, outlives the station
};

/// All cameras of the world. Used by the simulator's thread.
///
/// Simulated time never outruns the cameras: in lock-step a picture is waited for when its reading is about to become
/// visible, at the latest when the next one is due. With the wall clock a picture that is due while the one before is
/// still being drawn is left out.
class CameraStation {
 public:
  /// @throws FaultError as CameraWorker
  CameraStation(link::Process& process, const std::vector<PlacedCamera>& cameras);

  /// Call this when the system has assembled.
  void begin();
  /// @return where the settings of cameras on demand come from; none: there is no such camera
  [[nodiscard]] link::Sources sources() const;
  /// @return whether what the cameras are asked in macrostep i has come
  [[nodiscard]] bool asked(std::int64_t i) const { return !setting_in_ || setting_in_->here(i); }
  /// Takes what they are asked in that macrostep. @throws FaultError malformed_message
  void obey(std::int64_t i);
  /// Hands over pictures that are ready or have to be; before the state of that step is published.
  void deliver(std::int64_t step);
  /// Takes the snapshots that are due; at the same instant as the state of that step.
  void look(std::int64_t step);
  /// Hands over the last pictures and says that no more will come.
  void end();

 private:
  struct Eye {
    SimulatedCamera k;
    View* view{};
    std::size_t shown{};  // number of the eye whose view it has
    std::unique_ptr<CameraWorker> worker;
    std::unique_ptr<link::Outbox<camera_frame_t>> out;
    CameraJob next;           // whose snapshots are being taken
    std::int64_t frames{};    // begun
    std::int64_t left_out{};  // because the one before was not ready
    std::int64_t waits{};     // of the simulator, and how long
    double waited{};          // [s]
    std::int64_t told{-1};    // number of the last frame
  };

  void look(Eye& eye, std::int64_t step);
  void hand_over(Eye& eye, bool must);
  void wait_for(Eye& eye);
  [[nodiscard]] camera::Scene scene(const Eye& eye, std::int64_t step) const;

  link::Process& process_;
  std::vector<View*> views_;  // each once
  std::vector<Eye> eyes_;
  std::unique_ptr<link::IncomingLink<SensorSetting>> setting_in_;  // null: no camera is on demand
  bool wanted_{};                                                  // pictures of cameras on demand
};

}  // namespace mrroc::sim
