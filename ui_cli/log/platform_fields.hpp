// The fields of a platform that can be drawn over time, and their values.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/platform_command.hpp"
#include "base/platform_transmission.hpp"
#include "ui_cli/log/plot_fields.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// What is known of a platform in one macrostep. Headings are not wrapped: they go on from row to row.
struct PlatformRow {
  double t{};            ///< simulated time, as `log csv` has that of the reply [s]
  int m{};               ///< behaviour of its agent
  PlatformReply reply;   ///< of the driver
  PlanarPose reference;  ///< where it is to be at the reading of the reply
  bool has_truth{};      ///< the simulation tells what is true at that reading
  PlatformTruth truth;   ///< what that is
};

/// What of a platform can be drawn: path, error, torques, slip, speeds, behaviours.
[[nodiscard]] const std::vector<std::string>& platform_subjects();

/// @param subject  one of platform_subjects(); empty: all
/// @return the fields that there are, in the order of charts and curves. What is compared with what is true is not a number where
///         nothing tells the truth
[[nodiscard]] std::vector<PlotField> platform_fields(const std::string& subject);

/// Recorded values of one platform, from when its driver knows its position.
class PlatformReadings final : public Readings {
 public:
  PlatformReadings(const RunRecord& run, const std::string& platform);

 private:
  [[nodiscard]] std::vector<Sample> readings(const PlotField& field, double from, double to) const override;

  std::vector<PlatformRow> rows_;
};

}  // namespace mrroc::ui
