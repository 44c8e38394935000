// Signals as orders of the operator: Ctrl-C stops, Ctrl-Z pauses.
#pragma once
#include <csignal>
#include <string_view>

#include "base/fault.hpp"
#include "base/link/process.hpp"
#include "mp/operator_command_server.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// Holds SIGINT, SIGTERM and SIGHUP back while it lives: one that comes meanwhile comes at its end. For work that leaves
/// something half done; threads that are made meanwhile never get one.
class HeldStops {
 public:
  HeldStops();
  ~HeldStops();
  HeldStops(const HeldStops&) = delete;
  HeldStops& operator=(const HeldStops&) = delete;

 private:
  sigset_t before_{};
};

/// Takes the signals of the whole program from its making to its end; one object at a time. SIGINT, SIGTERM and SIGHUP stop
/// the task in a controlled way, unless the caller wants one ignored, as nohup does. The second one does not wait for a
/// macrostep, the third one for nobody. By the wall clock the arms move on while their program is suspended: Ctrl-Z pauses
/// the task instead.
class SignalOrders {
 public:
  /// All must outlive this object.
  SignalOrders(OperatorCommandServer& command_server, Supervisor& supervisor, link::Process& process);
  ~SignalOrders();
  SignalOrders(const SignalOrders&) = delete;
  SignalOrders& operator=(const SignalOrders&) = delete;

  /// Obeys what has come since the last call. Call it often: where it is not called for 2 s, a third signal ends the program.
  void look();

  /// @param finishing  the run is over, and only pictures are made: a signal ends these, a second one the program
  void set_finishing(bool finishing);

  /// @return whether more than one has come
  [[nodiscard]] bool impatient() const { return signals_ > 1; }
  /// @return why the system is stopped when an order was the reason: the operator's, or that of a signal
  [[nodiscard]] Fault stop_reason() const;

 private:
  void look_after_stops();
  void look_after_suspension();
  void end_pictures(int signals);

  OperatorCommandServer& command_server_;
  Supervisor& supervisor_;
  link::Process& process_;
  bool by_wall_clock_;
  int signals_{};  // that have been obeyed
  int signal_{};   // that ended the task, 0: none
  int suspensions_{}, continuations_{};
  bool paused_by_signal_{};
  bool finishing_{}, gave_up_pictures_{};
};

}  // namespace mrroc::mp
