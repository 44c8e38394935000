// Gives the pictures of a running task's cameras to any number of readers.
#pragma once
#include <sys/types.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.hpp"
#include "base/link/frame_store.hpp"
#include "mrroc/camera_frame_t.hpp"

namespace mrroc::view {

/// Opens the frame stores of a session and copies a picture out when somebody asks. Used by any number of threads.
/// A store has a name only while its system assembles: a later reader opens it through the process that
/// draws.
class CameraWindow {
 public:
  /// Forgets the stores of the session before, and from now on looks for those of this one.
  /// @param task  process of the task, whose children draw; 0: on another host
  void begin(const std::string& session, std::int64_t session_id, const std::vector<std::string>& cameras,
             pid_t task = 0, std::filesystem::path directory = "/dev/shm");
  /// Opens what can be opened by now; cheap when there is nothing to do.
  void look();
  /// Looks among the open files of the task's children for stores that have no name any more. Not cheap: a few times
  /// a second.
  void look_hidden();
  /// @return whether every camera's store is open
  [[nodiscard]] bool complete() const;
  /// Remembers the newest picture of a camera. @param camera  unknown ones are ignored
  void announce(const std::string& camera, const camera_frame_t& m);
  /// @return the newest picture of a camera as a BMP file; nothing: no such camera, none yet, or it was written over
  [[nodiscard]] std::optional<std::string> picture(const std::string& camera);

 private:
  struct Eye {
    std::optional<link::FrameReader> store;
    std::int32_t slot{-1};
    std::int64_t frame{-1};
    link::Frame last;
  };
  mutable std::mutex mutex_;
  link::FrameStoreName name_;
  pid_t task_{};
  std::map<std::string, Eye, std::less<>> eyes_;
};

/// @return a BMP file with 24 bits per pixel
[[nodiscard]] std::string bitmap(const ImageView& image);

}  // namespace mrroc::view
