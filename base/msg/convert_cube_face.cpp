#include "base/msg/convert_cube_face.hpp"
#include "base/msg/pose_rows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mrroc {
namespace {

using RowMajorMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
constexpr int kFlaws = static_cast<int>(StickerFlaw::mixed) + 1;

template <std::size_t N>
bool finite(const double (&numbers)[N]) noexcept {
  return std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return std::isfinite(x); });
}

}  // namespace

cube_face_reading_t to_message(const CubeFaceReading& r) {
  cube_face_reading_t m{};
  m.step = r.step;
  m.seen = r.seen;
  m.valid = r.valid;
  m.place = r.place;
  put_rows(m.T_CG, r.T_CG);
  Eigen::Map<RowMajorMatrix6>{m.covariance} = r.covariance;
  m.reprojection_px = r.reprojection_px;
  for (int k = 0; k < kStickers; ++k) {
    const StickerReading& sticker = r.stickers[static_cast<std::size_t>(k)];
    std::ranges::copy(sticker.rgb, m.rgb + 3 * k);
    m.deviation[k] = sticker.deviation;
    m.confidence[k] = sticker.confidence;
    m.colour[k] = static_cast<std::int32_t>(sticker.colour);
    m.flaw[k] = static_cast<std::int32_t>(sticker.flaw);
  }
  return m;
}

CubeFaceReading from_message(const cube_face_reading_t& m) {
  CubeFaceReading r;
  r.frame = m.header.stamp;
  r.step = m.step;
  r.seen = m.seen != 0;
  r.valid = m.valid != 0;
  r.place = m.place;
  r.T_CG = pose_from_rows(m.T_CG);
  r.covariance = Eigen::Map<const RowMajorMatrix6>{m.covariance};
  r.reprojection_px = m.reprojection_px;
  for (int k = 0; k < kStickers; ++k) {
    StickerReading& sticker = r.stickers[static_cast<std::size_t>(k)];
    std::copy_n(m.rgb + 3 * k, 3, sticker.rgb.begin());
    sticker.deviation = m.deviation[k];
    sticker.confidence = m.confidence[k];
    sticker.colour = static_cast<StickerColour>(m.colour[k]);
    sticker.flaw = static_cast<StickerFlaw>(m.flaw[k]);
  }
  return r;
}

bool is_proper(const cube_face_reading_t& m) noexcept {
  const auto within = [](const auto& values, int end) {
    return std::all_of(std::begin(values), std::end(values), [end](int x) { return x >= 0 && x < end; });
  };
  return finite(m.T_CG) && finite(m.covariance) && std::isfinite(m.reprojection_px) && finite(m.rgb) &&
         finite(m.deviation) && finite(m.confidence) && within(m.colour, kStickerColours) &&
         within(m.flaw, kFlaws);
}

cube_face_setting_t to_message(const CubeFaceSetting& s) {
  cube_face_setting_t m{};
  m.face = s.face;
  m.place = s.place;
  return m;
}

CubeFaceSetting from_message(const cube_face_setting_t& m) { return {.face = m.face, .place = m.place}; }

bool is_proper(const cube_face_setting_t& m) noexcept {
  return m.face >= -1 && m.face < kStickerColours && m.place >= -1;
}

}  // namespace mrroc
