// The fields of a run that can be drawn over time, and their values.
#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mrroc/agent_report_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Source of a field in a message.
enum class FieldSource : std::uint8_t {
  force,         ///< F_a of the agent's report
  displacement,  ///< how far E has come since the first reading shown, from T_0E
  rotation,      ///< how far E has turned since then: rotation vector in E as it was, from T_0E
  pose,          ///< T_0E itself
  gripper,       ///< distance of the jaws, of the report
  behaviour,     ///< m of the report
  turned,        ///< how far a motor has turned since the first reading shown, from motors
  motors,        ///< of the driver's reply
  joints,        ///< of the reply
  current        ///< current_mean of the reply
};

struct PlatformRow;

/// A field of an arm or of a platform, one curve over time.
struct PlotField {
  std::string name;      ///< "F_z", "x", "motors[0]"
  std::string alias;     ///< another name, that in the message: "F_a[2]"; may be empty
  std::string legend{};  ///< of its curve; empty: the name
  std::string subject;   ///< force, pose, ...
  std::string quantity;  ///< what it is, for a title; fields of one quantity have one unit and share a chart
  std::string unit;      ///< "N"; empty: none
  FieldSource source{};  ///< where it is read
  std::size_t index{};   ///< component; of the fields of motors and joints: the axis
  double scale{1};       ///< from the message's unit to `unit`
  bool usual{};          ///< drawn when no fields are asked for
  /// Of a platform: reads it, see platform_fields.hpp. Null: the field is one of an arm.
  double (*of_platform)(const PlatformRow& row, std::size_t index){};
};

/// @return whether the field is of one axis of the arm: read from the driver's reply
[[nodiscard]] bool of_axis(const PlotField& field);

/// What of an arm can be drawn: force, pose, motors, behaviours.
[[nodiscard]] const std::vector<std::string>& arm_subjects();

/// @param subject  one of arm_subjects(); empty: all
/// @param axes     of the arm: motors and joints beyond them do not exist
/// @return the fields that there are, in the order of charts and curves
[[nodiscard]] std::vector<PlotField> plot_fields(const std::string& subject, std::size_t axes);

/// @param wanted  names or aliases of fields, or what stands before their bracket: "motors"; empty: the usual ones
/// @return those of `known` that are wanted, in the order of `known`
/// @throws FaultError bad_usage that names those that exist, and the nearest
[[nodiscard]] std::vector<PlotField> chosen_fields(const std::vector<PlotField>& known,
                                                   const std::vector<std::string>& wanted);

/// One reading; or, with a value that is not finite, none.
struct Sample {
  double t{};  ///< simulated time [s], as `log csv` has it
  double y{};  ///< in the unit of the field
};

/// Recorded values of one arm or platform.
class Readings {
 public:
  Readings() = default;
  virtual ~Readings() = default;
  Readings(const Readings&) = delete;
  Readings& operator=(const Readings&) = delete;

  /// @return axes of the arm
  [[nodiscard]] virtual std::size_t axes() const { return 0; }
  /// @return since when the adjusted force has been free of the sensor's bias and the tool's weight [s]; not finite:
  ///         the run does not tell
  [[nodiscard]] virtual double biased_at() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// @return time of the first and the last reading of a field [s]; NaN: there is none
  [[nodiscard]] std::pair<double, double> extent(const PlotField& field) const;
  /// @return its readings between two times, oldest first; macrosteps without one are left out. Forces before the bias
  ///         are left out where there are others
  [[nodiscard]] virtual std::vector<Sample> samples(const PlotField& field, double from, double to) const {
    return readings(field, from, to);
  }

 private:
  [[nodiscard]] virtual std::vector<Sample> readings(const PlotField& field, double from,
                                                     double to) const = 0;
};

/// Recorded values of one arm.
class ArmReadings final : public Readings {
 public:
  ArmReadings(const RunRecord& run, const std::string& arm);

  [[nodiscard]] std::size_t axes() const override { return axes_; }
  [[nodiscard]] double biased_at() const override { return biased_at_; }
  [[nodiscard]] std::vector<Sample> samples(const PlotField& field, double from, double to) const override;

 private:
  [[nodiscard]] std::vector<Sample> readings(const PlotField& field, double from, double to) const override;

  double macrostep_s_;
  std::map<std::int64_t, agent_report_t> reports_;    // by stamp, those with readings
  std::map<std::int64_t, effector_reply_t> replies_;  // the same
  std::size_t axes_{};
  double biased_at_{std::numeric_limits<double>::quiet_NaN()};
};

}  // namespace mrroc::ui
