// The last forces and poses of a task's agents, for the charts of the full-screen view.
#pragma once
#include <array>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ui_cli/snapshot.hpp"

namespace mrroc::ui {

/// Quantity of a chart: a component of F_a in E [N], or of the position of E in the arm's base [mm].
enum class Quantity : std::uint8_t { F_z, F_x, F_y, x, y, z };
/// In the order in which the key c shows them.
inline constexpr std::array kQuantities{Quantity::F_z, Quantity::F_x, Quantity::F_y,
                                        Quantity::x,   Quantity::y,   Quantity::z};
/// @return its name, such as "F_z"
[[nodiscard]] std::string_view to_string(Quantity q);
/// @return its unit
[[nodiscard]] constexpr std::string_view unit_of(Quantity q) { return q <= Quantity::F_y ? "N" : "mm"; }

/// One sample per status.
class History {
 public:
  /// Samples kept per agent: more than a terminal has columns.
  static constexpr std::size_t kKept = 600;

  /// Takes force and position of every agent; the oldest sample beyond kKept goes.
  void add(const Snapshot& s);
  /// @param width  so many of the newest at most
  /// Before an agent's first behaviour its sensor has a bias: such a force is NaN where there are later ones.
  /// @return oldest first, a force [N], or how far a coordinate has come since the first of them [mm]; empty for an
  ///         agent that is not known
  [[nodiscard]] std::vector<double> samples(const std::string& agent, Quantity q, int width) const;

 private:
  struct Sample {
    std::array<double, 3> F{};  // [N]
    std::array<double, 3> p{};  // [mm]
    bool begun{};               // the agent has, or had, a behaviour
  };
  std::map<std::string, std::deque<Sample>> agents_;
};

}  // namespace mrroc::ui
