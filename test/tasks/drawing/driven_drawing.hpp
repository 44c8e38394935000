// The drawing task in one thread: the coordinator's program, the pen-state sensors, the real effector drivers and the
// simulated cell, without links. For tests and benchmarks that need hundreds of drawings.
#pragma once
#include <functional>
#include <span>

#include "sim/hand.hpp"
#include "sim/paper.hpp"
#include "sim/world.hpp"
#include "tasks/drawing/drawing_run.hpp"
#include "tasks/drawing/ink.hpp"
#include "tasks/drawing/results.hpp"
#include "vsp/pen_state/pen_state_sensor.hpp"

namespace mrroc::test {

/// The drawing, the arms and the paper.
struct DrivenDrawing {
  drawing::Drawing drawing;        ///< taught to arm 1 [mm]
  sim::HandParameters hand;        ///< of the operator, at both arms
  sim::PaperParameters paper;      ///< of both sheets, but for their place
  vsp::PenStateParameters sensor;  ///< of both arms
  double oscillation_force{};      ///< least swing of an unstable contact [N]; 0: as in drawing.toml
  std::uint64_t seed{1};           ///< of tremor and noise
  bool copies{true};               ///< false: the run ends with the teach-in, and arm 2 is not there
  double longest_s{600};           ///< simulated time after which the run is given up
  /// Called after every step with the cell, the sensors and the coordinator's behaviour.
  std::function<void(const sim::World&, std::span<const vsp::PenStateSensor>, int m)> watch;
};

/// The result of the drawing.
struct DrivenResult {
  Outcome outcome{};          ///< terminated: the task came to its end
  Fault fault;                ///< why it did not
  drawing::RunRecord record;  ///< recording and traces
  drawing::RunInk ink;        ///< that the pens left
  double simulated_s{};       ///< duration
};

/// Runs the task to its end. @throws FaultError  a driver refused to start
DrivenResult run(const DrivenDrawing& d);

}  // namespace mrroc::test
