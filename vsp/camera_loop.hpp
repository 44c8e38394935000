// Shared part of the shells of all receptors that look at pictures: takes the pictures out of the frame
// store, and writes the film of the run folder.
#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/process.hpp"
#include "vsp/annotate.hpp"
#include "vsp/picture_settings.hpp"

namespace mrroc::vsp {

/// @return KEY of [cameras.KEY] for the receptor's process "vsp-KEY" @throws FaultError bad_usage
std::string camera_of(const link::Process& process);

/// A camera whose pictures a receptor takes.
struct WatchedCamera {
  std::string key;    ///< of [cameras.KEY]
  CameraModel model;  ///< its pictures are of this size
};

/// Answers one announced picture of every camera, all of the same number and step, with a message.
/// @param pictures  one for every camera; nothing when one of them came too late (with the wall clock only), when a camera gave none,
///                  or with the last announcement
/// @param t         when they were taken [s]
/// @param last      there will be no more
using PicturesAnswer = std::function<void(std::span<const ImageView> pictures, std::int64_t frame,
                                          std::int64_t step, double t, bool last)>;

/// The life of a receptor's process: assembles, takes the cameras' pictures until the last ones or the end of the system,
/// and stays until everybody has ended. To be called when all other links have been made.
/// @param cameras  of one period: pictures of the same number belong together
/// @param at_end   called when there are no more pictures, if it had assembled
/// @param setting  in lock-step no picture is taken before the setting for it is there; null: nobody sets the receptor
/// @throws FaultError bad_configuration: the pictures are of another size than their camera's; malformed_message: a frame
///         store does not hold what was announced, or pictures of one number are of different steps
void run_cameras(link::Process& process, std::span<const WatchedCamera> cameras, const PicturesAnswer& answer,
                 const std::function<void()>& at_end, PictureSetting* setting = nullptr);

/// The same for one picture of one camera.
using PictureAnswer =
    std::function<void(const ImageView* picture, std::int64_t frame, std::int64_t step, double t, bool last)>;

/// run_cameras() for one camera.
void run_camera(link::Process& process, const std::string& key, const CameraModel& camera,
                const PictureAnswer& answer, const std::function<void()>& at_end,
                PictureSetting* setting = nullptr);

/// Pictures of the camera, with the found object drawn in: with `film.directory` in the configuration KEY_OBJECT.png there.
class CameraFilm {
 public:
  /// @param key  of the camera  @param object  OBJECT of the file's name  @param shape  that is drawn
  /// @param config  `film.directory`: where the file is left; empty: there is no film
  CameraFilm(std::string key, std::string object, ObjectShape shape, const CameraModel& camera,
             const Config& config);

  /// Keeps the picture unless there are enough like it. @param text  behind the camera's name and the picture's number
  void see(const ImageView& picture, const CameraReading& reading, const std::string& text);
  /// Leaves the file. @throws FaultError cannot_write
  void write() const;

 private:
  std::string key_, object_;
  ObjectShape shape_;
  CameraModel camera_;
  std::filesystem::path directory_;
  FilmStrip strip_;
};

}  // namespace mrroc::vsp
