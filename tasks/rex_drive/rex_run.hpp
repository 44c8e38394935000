// MP of the task: the ontology agent a_2, with a record of all events.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/link/clocked_inbox.hpp"
#include "base/linked_port.hpp"
#include "mp/auto_start_operator.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/coordinator_run.hpp"
#include "mp/task_run.hpp"
#include "tasks/rex_drive/drive_record.hpp"
#include "tasks/rex_drive/figures.hpp"
#include "tasks/rex_drive/ontology.hpp"
#include "tasks/rex_drive/sensor_words.hpp"

namespace mrroc::rex_drive {

/// Settings of a run.
struct RexRunParameters {
  OntologyParameters ontology;              ///< of a_2
  std::vector<Plan> plans;                  ///< to be driven, in their order
  std::vector<std::int32_t> iterations;     ///< of the planner's search, one per fragment, for the figures
  bool gives_start{true};                   ///< false: a person or a script does
  bool records{true};                       ///< false: nothing is written down, as in a check
  std::optional<link::SensorClock> eyes{};  ///< when the odometry measures; nothing: there is none
  double lost{0.2};                         ///< as a_1 has it, for what is told [m]
  double dt{0.002};                         ///< duration of a step [s]
  int n_s{10};                              ///< steps of a macrostep
};

/// The agent a_2 in MP.
class RexRun final : public mp::CoordinatorRun {
 public:
  /// @param run  is told of everything that begins; must outlive this object
  RexRun(mp::TaskRun& run, RexRunParameters parameters);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return fault_ ? fault_ : links_.fault(); }
  /// @param folder  of the run, whose log has ended
  /// @return what the figures are made of, up to the rest of the platform also after a stop; without rows when nothing was
  ///         written down
  [[nodiscard]] DriveResults results(const std::filesystem::path& folder) const;

 private:
  using X = Ontology::X;
  void observe(const Motion<Ontology>& motion, const X& x);
  void show(const Motion<Ontology>& motion, const X& x);
  void show_platform(const X& x);
  void announce(const Motion<Ontology>& motion, const X& x);
  void report_position(const X& x);
  void watch_map(const X& x);
  void watch_odometry(const X& x);
  void note_ack(const X& x);
  /// @return the fault of a platform that does not know its position well enough to drive
  [[nodiscard]] Fault uncertain() const;
  [[nodiscard]] DriveMessages messages(const std::filesystem::path& folder) const;
  [[nodiscard]] std::string progress_text(const X& x) const;
  [[nodiscard]] SensorStatus sensor_status(const X& x) const;
  /// @return why the odometry measures nothing, as far as it has told
  [[nodiscard]] const char* why_no_odometry(const Report& r) const;
  [[nodiscard]] double progress(const X& x) const;
  [[nodiscard]] double seconds(std::int64_t macrosteps) const;

  mp::TaskRun& run_;
  RexRunParameters k_;
  mp::AutoStartOperator operator_;
  link::OutgoingLink<Plan> plan_;
  mp::CoordinatorLinks links_;
  std::optional<DriveRecord> record_;
  Fault fault_;
  std::string announced_;            // behaviour that was announced last
  std::int64_t position_lost_in_{};  // macrostep from which on the platform waits for it; 0: it does not
  std::int64_t map_lost_in_{};       // macrostep from which on the map has been lost; 0: it is not
  bool odometry_lost_{};             // it has measured nothing for long, which has been told
  std::int64_t odometry_seen_in_{};  // macrostep in which it measured last
  std::int64_t acked_{};             // number of the plan whose ack came last
  std::int64_t acked_in_{};          // macrostep in which a_1 gave it
  std::int64_t
      ended_in_{};  // macrostep whose motion the last report was about; 0: the run did not come to its end
};

}  // namespace mrroc::rex_drive
