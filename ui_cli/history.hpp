// The last forces, poses and speeds of a task's agents, for the charts of the full-screen view.
#pragma once
#include <array>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui_cli/snapshot.hpp"

namespace mrroc::ui {

/// Quantity of a chart: a component of F_a in E [N]; of the position of E in the arm's base, of a platform on the map [mm];
/// of a platform's velocity along B: forward [m/s], turn [rad/s].
enum class Quantity : std::uint8_t { F_z, F_x, F_y, x, y, z, v, w };
/// @return what there is of an agent with such an effector, in the order in which the key c shows them; empty without one
[[nodiscard]] std::span<const Quantity> quantities_of(EffectorKind kind);
/// @return its name, such as "F_z"
[[nodiscard]] std::string_view to_string(Quantity q);
/// @return its unit
[[nodiscard]] std::string_view unit_of(Quantity q);

/// One sample per status.
class History {
 public:
  /// Samples kept per agent: more than a terminal has columns.
  static constexpr std::size_t kKept = 600;

  /// Takes force, position and velocity of every agent; the oldest sample beyond kKept goes.
  void add(const Snapshot& s);
  /// @param width  so many of the newest at most
  /// Before an agent's first behaviour its sensor has a bias: such a force is NaN where there are later ones.
  /// @return oldest first, a force [N], a velocity [m/s], [rad/s], or how far a coordinate has come since the first of them
  ///         [mm]; empty for an agent that is not known
  [[nodiscard]] std::vector<double> samples(const std::string& agent, Quantity q, int width) const;

 private:
  struct Sample {
    std::array<double, 8> value{};  // by quantity
    bool begun{};                   // the agent has, or had, a behaviour
  };
  std::map<std::string, std::deque<Sample>> agents_;
};

}  // namespace mrroc::ui
