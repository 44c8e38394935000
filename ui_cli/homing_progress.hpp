// Progress of arms that are homing, computed from their motors' positions.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/effector_command.hpp"
#include "ui_cli/manual_page.hpp"

namespace mrroc::ui {

/// @param instruction  as behind `ui_cli manual`
/// @param arms         those of the task; none: they are not known here
/// @return the arms that it homes; none when it does something else
[[nodiscard]] std::vector<ManualArm> arms_to_home(const std::string& instruction,
                                                  std::vector<ManualArm> arms);

/// Homing moves one motor after the other, so those that have moved tell how far it is.
class HomingProgress {
 public:
  /// @param arms  that are followed, with the numbers of their axes
  explicit HomingProgress(const std::vector<ManualArm>& arms);

  /// @param arm      name of one of them; others are ignored
  /// @param reading  its newest
  void see(const std::string& arm, const EffectorReply& reading);
  /// @return which of its axes every arm is homing, "arm1 axis 2 of 6, arm2 axis 1 of 7"; of arms that do
  [[nodiscard]] std::string text() const;

 private:
  struct Followed {
    std::string arm;
    int axes{};
    std::optional<std::array<double, kMaxAxes>>
        begun{};  // motors when homing began; nothing: it is not homing
    std::array<bool, kMaxAxes> moved{};
  };
  std::vector<Followed> followed_;
};

}  // namespace mrroc::ui
