// The one table of errors: code, class, what happened, what to do. docs/faults.md is made from it; after a
// change here run  MRROC_UPDATE_DOCS=1 ./run test -R FaultTable
#pragma once
#include <array>

#include "base/fault.hpp"

namespace mrroc {

// clang-format off
#define MRROC_FAULT(code, fault_class, text, remedy) \
  FaultEntry { FaultCode::code, #code, FaultClass::fault_class, text, remedy }

/// Row k describes the code with the number k.
inline constexpr std::array kFaultTable{
  MRROC_FAULT(none, non_fatal, "no error", "nothing"),

  MRROC_FAULT(lost_command, non_fatal, "a command is missing before this one",
              "send the command with the expected number again"),
  MRROC_FAULT(not_owner, non_fatal, "another session holds the effector",
              "end the other session first: its task's RELEASE or the death of its process frees the effector"),
  MRROC_FAULT(start_guard, non_fatal, "the command came too soon after the start of the driver",
              "repeat it; commands of an earlier run are refused for the first 0.25 s"),
  MRROC_FAULT(not_finite, non_fatal, "a value of the command is not a finite number",
              "correct the computation that makes the command"),
  MRROC_FAULT(out_of_limits, non_fatal, "a value of the command is outside its limits",
              "keep the command within the limits of the robot's configuration"),
  MRROC_FAULT(unknown_enum, non_fatal, "a field of the command holds a number that means nothing",
              "build all programs from the same version"),
  MRROC_FAULT(illegal_in_state, non_fatal, "the command is not allowed in this state",
              "look at the state with `ui_cli status`"),
  MRROC_FAULT(unknown_number, non_fatal, "there is no reply with the number asked for",
              "ask for the number of the last command"),
  MRROC_FAULT(not_synchronised, non_fatal, "the effector does not know its position",
              "send SYNCHRO before any motion"),
  MRROC_FAULT(reset_required, non_fatal, "the effector waits for a reset after a fault",
              "remove the cause of the fault, then reset the effector, or start the task anew"),
  MRROC_FAULT(not_at_rest, non_fatal, "the command needs a standstill, and the effector moves",
              "bring the effector to rest first"),
  MRROC_FAULT(too_fast, non_fatal, "the command asks for more speed than the robot has",
              "give the motion more steps, or a nearer goal"),
  MRROC_FAULT(excessive_acceleration, non_fatal, "the command asks for a change of speed that the robot must not make",
              "change the velocity in smaller steps, or give a virtual inertia"),
  MRROC_FAULT(outside_workspace, non_fatal, "the end effector would leave the workspace that it was given",
              "choose a pose inside it, or another workspace in the robot's configuration"),
  MRROC_FAULT(force_limit, non_fatal, "the contact force is above its limit and the motion would raise it",
              "move away from the contact, or use a guarded or contact behaviour there"),
  MRROC_FAULT(unknown_model, non_fatal, "the robot has no model or servo algorithm with this number",
              "choose one of those in the robot's documentation"),

  MRROC_FAULT(not_a_rotation, non_fatal, "the matrix of the command is not a rotation",
              "correct the computation that makes the command"),
  MRROC_FAULT(unreachable_pose, non_fatal, "the pose is out of the arm's reach",
              "choose a pose within the workspace"),
  MRROC_FAULT(joint_limit, non_fatal, "the pose needs a joint or motor beyond its limit",
              "choose another pose or orientation"),

  MRROC_FAULT(over_current, fatal, "the current of a motor is too high",
              "look for a collision, then reset"),
  MRROC_FAULT(over_speed, fatal, "a motor turns too fast",
              "look at the regulator's parameters, then reset"),
  MRROC_FAULT(following_error, fatal, "a motor does not follow its set position",
              "look for a collision or a blocked joint, then reset"),
  MRROC_FAULT(limit_switch, fatal, "a limit switch is pressed",
              "reset, then move the joint away from the switch"),
  MRROC_FAULT(synchro_switch_missing, fatal, "homing did not find the synchronisation switch of an axis",
              "look at the switch and its cable, then reset and SYNCHRO"),
  MRROC_FAULT(synchro_switch_stuck, fatal, "the synchronisation switch of an axis is pressed where it must not be",
              "look at the switch and its cam, then reset and SYNCHRO"),
  MRROC_FAULT(encoder_index_missing, fatal, "the encoder of an axis gives no zero mark",
              "look at the encoder and its cable, then reset and SYNCHRO"),

  MRROC_FAULT(force_saturated, fatal, "the force sensor is at the end of its range",
              "unload the tool, then reset"),
  MRROC_FAULT(force_stuck, fatal, "the force sensor repeats the same reading",
              "look at the sensor's cable and power; force_stuck_after = 0 if its readings have no noise"),
  MRROC_FAULT(force_not_finite, fatal, "a component of the force sensor's reading is not a number",
              "look at the sensor's electronics, then reset"),
  MRROC_FAULT(sensor_silent, fatal, "a sensor of the effector gives no readings",
              "look at the sensor's cable or process, then reset"),
  MRROC_FAULT(no_contact, non_fatal, "the tool did not meet a surface in time",
              "look at the surface, at the tool and at the sensor that should have told of the touch"),
  MRROC_FAULT(contact_unstable, non_fatal, "the contact force swings and does not die away; the arm was stopped",
              "lower B of the behaviour, or soften the contact: `ui_cli stability` tells by how much"),

  MRROC_FAULT(start_failed, system, "a process could not be started",
              "build with `./run build` and look at messages.log in the run folder"),
  MRROC_FAULT(not_ready, system, "a process did not become ready in time",
              "look at its last lines in messages.log in the run folder"),
  MRROC_FAULT(process_died, system, "a process ended unexpectedly",
              "look at its last lines in messages.log in the run folder"),
  MRROC_FAULT(process_hung, system, "a process lives and says nothing",
              "look at its last lines in messages.log in the run folder"),
  MRROC_FAULT(peer_silent, system, "an expected message did not come in time",
              "look at the sender with `ui_cli status`"),
  MRROC_FAULT(hardware_silent, system, "the world or the drives give no state",
              "look at the process `world`; the drives brake by themselves"),
  MRROC_FAULT(no_multicast, system, "this host has no route for multicast messages",
              "type `ip route add 224.0.0.0/4 dev lo` as root, or use --processes one"),
  MRROC_FAULT(session_in_use, system, "another system runs under the same session name",
              "choose another name with --session, or stop the other one"),
  MRROC_FAULT(malformed_message, system, "a message has a wrong size or type",
              "build all programs from the same version"),
  MRROC_FAULT(command_repeated_refused, system, "a command was refused again after it had been repeated",
              "look at the effector with `ui_cli status`"),
  MRROC_FAULT(cannot_write, system, "a file cannot be written",
              "look at the rights and the space left, or choose another --run-dir"),
  MRROC_FAULT(internal_error, system, "the program broke one of its own rules",
              "report it with the run folder"),

  MRROC_FAULT(bad_usage, non_fatal, "the command line is wrong",
              "look at --help"),
  MRROC_FAULT(bad_configuration, non_fatal, "the configuration is wrong",
              "correct the file or the --set option named"),
  MRROC_FAULT(bad_drawing, non_fatal, "the drawing cannot be used",
              "correct the SVG file, or change --size"),
  MRROC_FAULT(bad_recording, non_fatal, "the recording cannot be used",
              "teach it again with --save"),
  MRROC_FAULT(bad_trajectory, non_fatal, "a motion cannot be generated as asked",
              "correct the poses, times or limits, or the line of the file, that the text names"),
  MRROC_FAULT(bad_script, non_fatal, "the operator script cannot be used",
              "correct the line named"),
  MRROC_FAULT(bad_log, non_fatal, "the log of a run cannot be used",
              "name the events.lcmlog of a run folder"),
  MRROC_FAULT(no_such_session, non_fatal, "no task, or more than one, runs to attach to",
              "start a task, or name one with --session"),

  MRROC_FAULT(operator_stop, non_fatal, "the operator stopped the task",
              "start it again when ready"),
  MRROC_FAULT(emergency_stop, fatal, "the emergency stop was pressed",
              "release it, then reset"),
  MRROC_FAULT(interrupted, non_fatal, "a signal ended the task",
              "start it again when ready"),
};
// clang-format on
#undef MRROC_FAULT

}  // namespace mrroc
