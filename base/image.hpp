// A picture as bytes, for cameras, their frame stores and the virtual receptors. It needs no image library;
// libraries such as OpenCV can use the same bytes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mrroc {

/// Bytes of a picture that somebody else owns: rows from the top, pixels from the left, without gaps. 1 channel:
/// grey; 3: blue, green, red. 0 black .. 255 the brightest that the camera can tell.
struct ImageView {
  int width{};                 ///< [pixel]
  int height{};                ///< [pixel]
  int channels{};              ///< 1 or 3
  const std::uint8_t* data{};  ///< width * height * channels bytes

  /// @return whether there is no picture
  [[nodiscard]] bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  /// @return number of bytes
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(channels);
  }
  /// @return all of them, row by row
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {data, size()}; }
  /// @param y  0..height-1
  [[nodiscard]] const std::uint8_t* row(int y) const {
    return data + static_cast<std::size_t>(y) * static_cast<std::size_t>(width * channels);
  }
  /// @param x  0..width-1 @param y  0..height-1 @param channel  0..channels-1
  [[nodiscard]] std::uint8_t at(int x, int y, int channel = 0) const {
    return row(y)[x * channels + channel];
  }
};

/// A picture that owns its bytes; layout as in ImageView.
struct Image {
  /// As in ImageView.
  int width{};
  int height{};
  int channels{};
  std::vector<std::uint8_t> data;

  Image() = default;
  /// A black picture. @param w @param h  [pixel], > 0 @param n  1 or 3 channels
  Image(int w, int h, int n) : width(w), height(h), channels(n) { data.resize(view().size()); }

  /// @return the same picture; valid until this one changes or goes
  [[nodiscard]] ImageView view() const { return {width, height, channels, data.data()}; }
  /// @return whether there is no picture
  [[nodiscard]] bool empty() const { return data.empty(); }
  /// @param y  0..height-1
  [[nodiscard]] std::uint8_t* row(int y) {
    return data.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width * channels);
  }

  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace mrroc
