// The conveyor of the drawing task: as a third effector that moves for the arms (MS 8.3), or running by itself.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/agent_images.hpp"
#include "base/config.hpp"
#include "base/motion.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::drawing {

/// Key of the conveyor, behind the arms in [robots] order.
inline constexpr const char* kConveyorKey = "conveyor";

/// The options --conveyor and --belt-speed.
struct ConveyorOptions {
  bool conveyor{};                     ///< it moves for the arms
  std::optional<double> belt_speed{};  ///< it runs by itself so fast [m/s]
};

/// Adds the options to a program's command line.
void add_conveyor_options(CommandLine& line, ConveyorOptions& options);

/// @return KEY=VALUE of the configuration that the options stand for
[[nodiscard]] std::vector<std::string> conveyor_settings(const ConveyorOptions& options);

/// @return whether a run with that configuration has a conveyor @throws ConfigError
[[nodiscard]] bool has_conveyor(const Config& config);

/// @return the speed of a belt that runs by itself [m/s], 0.01 to 0.1; 0: it moves for the arms, or there is none
/// @throws FaultError bad_configuration
[[nodiscard]] double read_belt_speed(const Config& config);

/// Way of a belt that runs by itself: to and fro, with a rest at either end.
class BeltSchedule {
 public:
  /// @param speed  the greatest [m/s]  @param macrostep_s  [s]
  BeltSchedule(double speed, double macrostep_s);
  /// @return its velocity in a macrostep [m/s]
  /// @param i  since it began to run
  [[nodiscard]] double velocity(std::int64_t i) const;

 private:
  double speed_, macrostep_s_;
};

/// Memory of the agent of such a belt: constant during a run.
struct BeltMemory {
  double speed{};  ///< of the belt [m/s]
  double dt{};     ///< duration of a step [s]
  int n_s{};       ///< steps of a macrostep

  friend bool operator==(const BeltMemory&, const BeltMemory&) = default;
};

/// The agent a_3 of a belt that runs by itself: it obeys no commands of the coordinator, but stands until the arms are to reproduce.
struct Belt : ArmAgent<BeltMemory> {};

/// Its behaviours: it stands, then it runs.
extern const Motion<Belt> kBeltStands;
extern const Motion<Belt> kBeltRuns;

}  // namespace mrroc::drawing
