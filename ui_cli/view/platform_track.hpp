// Makes the tracks of platforms, as samples.hpp describes them, from the messages of a session.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "mrroc/box_truth_t.hpp"
#include "mrroc/plan_t.hpp"
#include "mrroc/platform_command_t.hpp"
#include "mrroc/platform_reply_t.hpp"
#include "mrroc/platform_telemetry_t.hpp"
#include "mrroc/platform_truth_t.hpp"
#include "ui_cli/view/record.hpp"

namespace mrroc::view {

/// Writes the tracks of any number of platforms. A message whose numbers nobody can use (is_proper() in
/// base/msg/convert_platform.hpp) is left out.
class PlatformTracks {
 public:
  /// @param record  outlives this
  explicit PlatformTracks(Record& record) : record_(record) {}

  /// Adds no row while the driver does not know its position: there is nothing to draw.
  /// @param name  of the platform, here and below  @param behaviour  of its agent
  void take(const std::string& name, const platform_reply_t& m, int behaviour);
  void take(const std::string& name, const platform_telemetry_t& m);
  void take(const std::string& name, const platform_truth_t& m);
  /// @param name  of a box that platforms push
  void take(const std::string& name, const box_truth_t& m);
  /// A plan comes in every macrostep; its points are added once.
  /// @param t  when it comes [s]
  void take(const std::string& name, const plan_t& m, double t);
  /// Adds the fragment of a command that hands a new one over; one that is handed over again is known.
  void take(const std::string& name, const platform_command_t& m);

 private:
  Record& record_;
  std::map<std::string, std::int64_t> plans_;      // number told last
  std::map<std::string, std::int64_t> fragments_;  // number told last
};

}  // namespace mrroc::view
