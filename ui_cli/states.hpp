// Words in messages besides the codes of errors, with their meanings: states, outcomes, and words of ./run.
#pragma once
#include <array>
#include <string_view>

namespace mrroc::ui {

/// One word and what it means.
struct StateEntry {
  std::string_view name;  ///< as it is shown
  std::string_view of;    ///< whose it is: where it is shown
  std::string_view text;  ///< what it means
  std::string_view next;  ///< what leads on
};

/// All of them, in the order of the enumerators of each kind.
// clang-format off
inline constexpr std::array kStates{
  // TaskState
  StateEntry{"starting", "a task",
             "its processes are being started and get to know one another",
             "it goes on by itself"},
  StateEntry{"waiting for start", "a task",
             "everything is ready and stands, and the operator is to let it begin",
             "`ui_cli start`, or the key s"},
  StateEntry{"running", "a task",
             "it does its work",
             "`ui_cli pause`, `ui_cli stop`; `ui_cli trigger` where a behaviour waits for it"},
  StateEntry{"paused", "a task",
             "arms rest and keep their forces, platforms stand; simulated time goes on, the task does not",
             "`ui_cli resume`, or `ui_cli stop`"},
  StateEntry{"stopping", "a task",
             "after a stop or a fault everything comes to rest, and the processes end",
             "it goes on by itself"},
  StateEntry{"ending", "a task",
             "everything rests and the processes are gone; figures, tables and pictures are being made",
             "it goes on by itself"},
  StateEntry{"ended", "a task",
             "it is over; its files are in the run folder",
             "look at summary.json there, or start it again"},
  // DriverState
  StateEntry{"not synchronised", "an arm",
             "its driver does not know where the arm is; only its motors can be jogged",
             "a task homes it by itself; by hand: `ui_cli manual home ARM`"},
  StateEntry{"homing", "an arm",
             "it looks for its synchronisation switches; positions are not known yet",
             "it goes on by itself; how it ends is told"},
  StateEntry{"ready", "an arm", "it stands since homing or a reset, and takes commands", "nothing has to be done"},
  StateEntry{"executing", "an arm or a platform", "it follows the commands of its control subsystem", "nothing has to be done"},
  StateEntry{"decelerating", "an arm or a platform",
             "it comes to rest: no command followed, or the motion failed",
             "it goes on by itself"},
  StateEntry{"holding", "an arm or a platform",
             "it is at rest; its brakes close when no command follows",
             "nothing has to be done"},
  StateEntry{"faulted", "an arm or a platform",
             "a fatal fault: its drives brake, and it takes nothing but a reset",
             "`ui_cli status` tells why; remove the cause, then `ui_cli manual reset ARM`, or begin a new run"},
  StateEntry{"jogging", "an arm", "its motors are moved before homing, by hand", "nothing has to be done"},
  // link::ProcessState
  StateEntry{"starting", "a process",
             "it has been started and has said nothing yet",
             "if it stays so: look at messages.log in the run folder"},
  StateEntry{"ready", "a process", "it waits until all the others are ready", "nothing has to be done"},
  StateEntry{"running", "a process", "it does its part", "nothing has to be done"},
  StateEntry{"done", "a process", "it has come to the end of its part", "nothing has to be done"},
  StateEntry{"faulted", "a process",
             "it has found a fault, because of which the task ends",
             "the fault is told as a message, and explained by its code"},
  StateEntry{"dead", "a process",
             "it ended before its time; the others are told, and everything comes to rest",
             "look at its last lines in messages.log, and at black_box/ in the run folder"},
  // summary.json
  StateEntry{"done", "a run", "the task has come to its own end; exit status 0", "nothing has to be done"},
  StateEntry{"fault", "a run",
             "a fault has ended the task; the summary names it",
             "explain its code; look at the black box"},
  StateEntry{"stopped", "a run",
             "the operator, a signal or the emergency stop has ended the task; exit status 1",
             "start it again when ready"},
  // InstructionState
  StateEntry{"refused", "an instruction by hand",
             "nothing has been done, for the reason told",
             "do what the reason says, then give it again"},
  StateEntry{"failed", "an instruction by hand",
             "it was begun and could not be done to its end",
             "`ui_cli manual show ARM` tells how the arm stands"},
  StateEntry{"called off", "an instruction by hand",
             "a stop, or the end of the session, came before its end",
             "give it again if it is still wanted"},
  // The script ./run
  StateEntry{"missing_packages", "./run",
             "packages of the system are missing, and it may not install them",
             "type the line that it prints, or `ui_cli doctor`"},
  StateEntry{"install_failed", "./run",
             "packages of the system could not be installed",
             "look at the network, then at build/install.log"},
  StateEntry{"configure_failed", "./run",
             "CMake found a problem",
             "look at build/configure-PRESET.log; ./run clean begins anew"},
  StateEntry{"build_failed", "./run",
             "a program could not be built",
             "the first error is printed; all of them are in build/build-PRESET.log"},
  StateEntry{"tests_failed", "./run", "some tests did not pass", "the reasons are printed, and are in build/*.log"},
  StateEntry{"package_failed", "./run", "the Debian package could not be made", "look at build/package.log"},
  // Campaigns
  StateEntry{"wall_time", "a run of a campaign",
             "it was ended with all its processes, since it took longer than --timeout, and counts as a failure",
             "run the line that repeats it; a larger --timeout if it was only slow"},
  StateEntry{"signal_N", "a run of a campaign",
             "its program was ended by the signal N of the system, such as signal_11, a wrong address, or signal_9, killed from outside; it counts as a failure",
             "run the line that repeats it; after signal_9 look whether memory was short"},
  StateEntry{"host_failed", "a campaign",
             "a run could not be carried out, for a reason that is the machine's and not the run's; it is not counted",
             "mend what the text says, such as a full disk, then go on with --resume"},
  StateEntry{"no_scheduler", "a campaign",
             "the scheduler that --on names is not reached",
             "`./run campaign scheduler` starts one; then go on with --resume"},
  StateEntry{"no_summary", "a run of a campaign",
             "its exit status was 0, but its summary.json was missing, damaged, or did not say done; it counts as a failure",
             "run the line that repeats it"},
  StateEntry{"worker_lost", "a run of a campaign",
             "the workers that carried it out died, again and again; it counts as a failure until it is carried out",
             "look whether memory was short; --resume tries it once more"},
  StateEntry{"runs_lost", "a campaign",
             "runs whose workers died again and again were given up; they count as failures, worker_lost",
             "look whether memory was short; --resume tries them once more"},
  StateEntry{"nothing_found", "a search of a campaign",
             "no trial came to its end with all seeds, so that there is nothing to compare",
             "look at the runs that were kept; narrow --over"},
};
// clang-format on

}  // namespace mrroc::ui
