// Reads and writes pictures and films, from real cameras or of a run.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/camera.hpp"
#include "base/image.hpp"

namespace mrroc::vsp {

/// @param file  PNG, JPEG, BMP, TIFF or PGM/PPM
/// @param channels  1 or 3, of the result
/// @throws FaultError bad_picture: missing, empty, cut short, not a picture, or larger than 8192 pixels
Image read_picture(const std::filesystem::path& file, int channels = 3);

/// @param name  of the picture, for the error
/// @throws FaultError bad_picture: it is of another size than the camera's pictures
void check_size(const Image& picture, const std::string& name, const CameraModel& camera);

/// Writes a PNG file as a whole.
/// @throws FaultError cannot_write
void write_picture(const std::filesystem::path& file, const ImageView& picture);

/// @return the pictures of a folder in the order of their names, digits compared as numbers
/// @throws FaultError bad_picture: no such folder, or no picture in it
std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder);

/// One picture of a source.
struct SourcePicture {
  std::string name;  ///< of its file, or film:number
  Image image;       ///< 3 channels
  double t{};        ///< of a film: from its beginning, never negative [s]
};

/// A picture, a folder of pictures, or a film: one picture after the other.
class PictureSource {
 public:
  /// @throws FaultError bad_picture: there is nothing that could be read
  explicit PictureSource(const std::filesystem::path& source);
  PictureSource(PictureSource&&) noexcept;
  PictureSource& operator=(PictureSource&&) noexcept;
  ~PictureSource();

  /// @return false at the end @throws FaultError bad_picture, also when a film breaks off
  bool next(SourcePicture& picture);

 private:
  struct Film;
  std::filesystem::path source_;
  std::vector<std::filesystem::path> files_;
  std::size_t number_{};
  std::unique_ptr<Film> film_;
};

}  // namespace mrroc::vsp
