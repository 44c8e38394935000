// The coordinator's run: read the cube, think, turn, look again, while everything that happens is written down.
#pragma once
#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mp/arm_trace.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/dormant_operator.hpp"
#include "mp/task_run.hpp"
#include "tasks/rubik/cube_record.hpp"
#include "tasks/rubik/eyes.hpp"
#include "tasks/rubik/plan/planner.hpp"
#include "tasks/rubik/program.hpp"
#include "tasks/rubik/reading/state_reading.hpp"
#include "tasks/rubik/solver/solver.hpp"

namespace mrroc::rubik {

/// What the coordinator asks when it thinks. Called in a thread of their own, one at a time.
struct Brain {
  std::function<Solution(const Cube&)> solve;  ///< finds turns that solve the cube
  /// How the arms do these turns, of a cube with such jams.
  std::function<Planned(const PlanStart&, const Moves&, const Jams&)> plan;
  std::function<Planned(const PlanStart&, int reading)>
      plan_reading;                   ///< shows all six faces; reading: 0 .. kReadings - 1
  PlanStart start;                    ///< how the cube is held at the beginning, and where the arms are
  std::optional<Cube> known;          ///< the cube as it is told; none: it is read
  std::optional<CameraSetup> camera;  ///< that looks at faces which are shown
  /// Thinks in a thread of its own, while the macrosteps of thinking pass; false: when they have passed, as a check does.
  bool aside{true};
};

/// What a run has left.
struct RunRecord {
  std::array<mp::ArmTrace, kArms> traces;  ///< a row per macrostep
  Journal journal;                         ///< cycles in their order
  std::vector<StateReading> readings;      ///< of all six faces, each time
  Moves solution;                          ///< turns of the last solution, in the order of execution
  double planned_s{};                      ///< estimate of the plan [s]
  std::int64_t
      turning{};  ///< macrosteps of all rounds from the first turn of a solution to the end of the last
  std::optional<bool>
      verified;  ///< whether the last look after a solution showed a solved cube; none: there was none
};

/// The agent a_0 in MP.
class RubikRun {
 public:
  /// @param announce  gets a line for everything that begins
  RubikRun(mp::TaskRun& run, const Parameters& parameters, Brain brain, bool gives_start,
           std::function<void(const std::string&)> announce);

  /// Runs the task to its end. Call TaskRun::start() before.
  Outcome execute();

  /// @return why execute() gave faulted
  [[nodiscard]] const Fault& fault() const { return fault_; }
  /// @return what there is so far
  [[nodiscard]] const RunRecord& record() const { return record_; }
  /// What is true of the cube in every macrostep, where the world tells it.
  [[nodiscard]] const CubeRecord& truth() const { return truth_; }
  CubeRecord& truth() { return truth_; }

 private:
  using X = Coordinator::X;
  using Observer = std::function<void(const Motion<Coordinator>&, const X&)>;
  using Links = mp::CoordinatorPort<Coordinator, Observer>;
  using Port = SeeingPort<Links>;

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
  /// Tells how long m = 5 took, and the forces.
  void tell_turn(const CycleNote& note);
  void note_view(const Step& step, const CubeFaceReading& reading);
  Outcome plan_failed(const Planned& planned);
  /// Thinks for a fixed simulated time, however long it takes. @throws what work throws
  template <class T>
  Outcome think(X& x, Port& port, std::function<T()> work, std::optional<T>& result);

  void observe(const Motion<Coordinator>& motion, const X& x);
  void note_rows(const X& x);
  void show(const Motion<Coordinator>& motion, const X& x);
  void say(const std::string& text);
  Outcome fail(FaultCode code, const std::string& text);
  [[nodiscard]] double seconds(std::int64_t macrosteps) const;

  mp::TaskRun& run_;
  Parameters k_;
  Brain brain_;
  mp::DormantOperator operator_;
  mp::CoordinatorLinks links_;
  Eyes eyes_;
  CubeRecord truth_;
  std::function<void(const std::string&)> announce_;
  RunRecord record_;
  Fault fault_;
  std::function<bool()> thought_;  // while there is thinking: whether it has ended
  std::vector<FaceView> views_;    // since the cube was last turned
  Jams jams_;                      // of this cube
  std::deque<int> ordered_;        // m of the last orders, newest first
  std::string doing_;              // for the operator
  double progress_{};
  std::int64_t i_{};
};

/// @return code of the fault that a trouble becomes when nothing helps
[[nodiscard]] FaultCode code_of(Trouble trouble);

}  // namespace mrroc::rubik
