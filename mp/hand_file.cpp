#include "mp/hand_file.hpp"

#include <fmt/core.h>

#include <string>

#include "base/text_file.hpp"

namespace mrroc::mp {

void write_hand_way(const std::filesystem::path& file, const std::vector<WayPoint>& way, const Pose& T_0P) {
  const Pose T_P0 = T_0P.inverse();
  std::string text = "t,x,y,z\n";
  for (const WayPoint& point : way) {
    const Vector3 p = 1e3 * (T_P0 * point.p);
    text += fmt::format("{:.3f},{:.4f},{:.4f},{:.4f}\n", point.t, p.x(), p.y(), p.z());
  }
  write_text_file(file, text);
}

}  // namespace mrroc::mp
