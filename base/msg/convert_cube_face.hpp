// Converts readings of the cube's faces to and from messages.
#pragma once
#include "base/cube/cube_face.hpp"
#include "mrroc/cube_face_reading_t.hpp"
#include "mrroc/cube_face_setting_t.hpp"

namespace mrroc {

/// The frame becomes the stamp of the header, which the channel writes.
cube_face_reading_t to_message(const CubeFaceReading& r);
/// The stamp of the message's header becomes CubeFaceReading::frame. @param m  a proper one
CubeFaceReading from_message(const cube_face_reading_t& m);
/// @return whether all numbers are finite, and colours and flaws are ones that there are. Real-time safe
bool is_proper(const cube_face_reading_t& m) noexcept;

cube_face_setting_t to_message(const CubeFaceSetting& s);
CubeFaceSetting from_message(const cube_face_setting_t& m);
/// @return whether the face is one that there is, or none. Real-time safe
bool is_proper(const cube_face_setting_t& m) noexcept;

}  // namespace mrroc
