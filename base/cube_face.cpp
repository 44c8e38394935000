#include "base/cube_face.hpp"

namespace mrroc {

std::string_view to_string(StickerColour colour) {
  static constexpr std::array<std::string_view, kStickerColours> kNames{"white",  "red",    "green",
                                                                        "yellow", "orange", "blue"};
  return kNames[static_cast<std::size_t>(colour)];
}

std::string_view to_string(StickerFlaw flaw) {
  static constexpr std::array<std::string_view, 5> kNames{"none", "hidden", "glaring", "dark", "mixed"};
  return kNames[static_cast<std::size_t>(flaw)];
}

}  // namespace mrroc
