// The pictures of a running task's cameras, for whoever asks.
#pragma once
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
/// A store has a name only while its system assembles: who comes later does not see its pictures.
class CameraWindow {
 public:
  /// Forgets the stores of the session before, and from now on looks for those of this one.
  void begin(const std::string& session, std::int64_t session_id, const std::vector<std::string>& cameras,
             std::filesystem::path directory = "/dev/shm");
  /// Opens what can be opened by now; cheap when there is nothing to do.
  void look();
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
  std::map<std::string, Eye, std::less<>> eyes_;
};

/// @return a BMP file with 24 bits per pixel
[[nodiscard]] std::string bitmap(const ImageView& image);

}  // namespace mrroc::view
