// The coordinator's run: read the cube, plan, turn, look again, with a record of all events.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/linked_port.hpp"
#include "mp/arm_trace.hpp"
#include "mp/auto_start_operator.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/task_run.hpp"
#include "mp/trace_recorder.hpp"
#include "tasks/rubik/camera_input.hpp"
#include "tasks/rubik/cube_record.hpp"
#include "tasks/rubik/plan/planner.hpp"
#include "tasks/rubik/program.hpp"
#include "tasks/rubik/reading/state_reading.hpp"
#include "tasks/rubik/solver/solver.hpp"

namespace mrroc::rubik {

/// Solver and planner, and what they begin with. Called in a thread of their own, one at a time.
struct PlannerServices {
  std::function<Solution(const Cube&)> solve;  ///< finds turns that solve the cube
  /// How the arms do these turns, of a cube whose faces do not turn in these directions.
  std::function<Planned(const PlanStart&, const Moves&, const BlockedDirections&)> plan;
  std::function<Planned(const PlanStart&, int reading)>
      plan_reading;                   ///< shows all six faces; reading: 0 .. kReadings - 1
  PlanStart start;                    ///< how the cube is held at the beginning, and where the arms are
  std::optional<Cube> known;          ///< the cube as it is told; none: it is read
  std::optional<CameraSetup> camera;  ///< that looks at faces which are shown
  /// Thinks in a thread of its own, while the macrosteps of thinking pass; false: when they have passed, as a check does.
  bool aside{true};
};

/// Results of a run.
struct RunRecord {
  std::array<mp::ArmTrace, kArms> traces;  ///< a row per macrostep
  ExecutionLog execution_log;              ///< cycles in their order
  std::vector<StateReading> readings;      ///< of all six faces, each time
  Moves solution;                          ///< turns of the last solution, in the order of execution
  double planned_s{};                      ///< estimate of the plan [s]
  std::int64_t
      turning{};  ///< macrosteps of all rounds from the first turn of a solution to the end of the last
  std::optional<bool>
      verified;  ///< whether the last look after a solution showed a solved cube; none: there was none
};

/// The agent a_0 in MP.
class RubikRun final : public mp::CoordinatorRun {
 public:
  /// @param run  is told of everything that begins; must outlive this object
  RubikRun(mp::TaskRun& run, const Parameters& parameters, PlannerServices services, bool gives_start);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return fault_; }
  [[nodiscard]] std::span<const mp::ArmTrace> traces() const override { return record_.traces; }
  /// @return what there is so far
  [[nodiscard]] const RunRecord& record() const { return record_; }
  /// What is true of the cube in every macrostep, where the simulator tells it.
  [[nodiscard]] const CubeRecord& truth() const { return truth_; }

 private:
  using X = Coordinator::X;
  using Observer = std::function<void(const Motion<Coordinator>&, const X&)>;
  /// Typed links to one arm.
  struct ArmLinks {
    link::OutgoingLink<CubeOrder> order;
    link::IncomingLink<CubeReport> report;
  };
  using Links = mp::CoordinatorPort<Coordinator, Observer>;
  using Port = LinkedPort<Links, std::function<void(const Coordinator::Y&)>, std::function<void(X&)>>;

  /// @return links beside those that every coordinator has
  link::OtherLinks others();
  void give(const Coordinator::Y& y);
  void take(X& x);
  Outcome work(X& x, Port& port);
  /// Shows all faces to the camera. @param now  how the cube is held; changed
  Outcome read_cube(X& x, Port& port, PlanStart& now, std::optional<Cube>& cube);
  Outcome solve(X& x, Port& port, PlanStart& now, const Cube& cube);
  /// A face that jams is left as it was. @param now  how the cube is held at the end; changed @param left  turns that
  /// have not been done: that of a face which jams, and those after it
  Outcome execute_plan(const Plan& plan, X& x, Program<Port>& program, PlanStart& now, Moves& left);
  /// Executes a plan; where a face jams in one direction, the rest is planned anew without turning it so.
  Outcome turn_all(const Plan& plan, X& x, Port& port, PlanStart& now);
  [[nodiscard]] bool may_turn_otherwise(const Step& step, const Program<Port>& program) const;
  /// Says what became of a step, and names the fault.
  Outcome judge(Outcome o, const Program<Port>& program);
  /// Announces how long m = 5 took, and the forces.
  void announce_turn(const CycleRecord& entry);
  /// Announces the faces that are the reason for showing all of them again.
  void announce_unseen();
  /// Announces how the cube is when all has been done.
  void announce_end();
  Outcome plan_failed(const Planned& planned);
  /// Thinks for a fixed simulated time, however long it takes. @throws what work throws
  template <class T>
  Outcome think(X& x, Port& port, std::function<T()> work, std::optional<T>& result);

  void observe(const Motion<Coordinator>& motion, const X& x);
  void show(const Motion<Coordinator>& motion, const X& x);
  void announce(const std::string& text);
  Outcome fail(FaultCode code, const std::string& text);
  [[nodiscard]] double seconds(std::int64_t macrosteps) const;

  mp::TaskRun& run_;
  Parameters k_;
  PlannerServices services_;
  mp::AutoStartOperator operator_;
  CameraInput camera_input_;
  std::array<ArmLinks, kArms> arms_;
  mp::CoordinatorLinks links_;
  CubeRecord truth_;
  mp::TraceRecorder recorder_;
  RunRecord record_;
  Fault fault_;
  std::function<bool()> thought_;  // while there is thinking: whether it has ended
  std::vector<FaceView> views_;    // since the cube was last turned
  std::string unseen_;             // faces of which the present reading has no good picture
  BlockedDirections blocked_;      // of this cube
  std::string doing_;              // for the operator
  double progress_{};
  std::int64_t i_{};
};

/// @return code of the fault that a failure becomes when nothing helps
[[nodiscard]] FaultCode code_of(FailureReason failure);

}  // namespace mrroc::rubik
