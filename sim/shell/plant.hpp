// A part of the simulation, arms or platforms, as the loop of the simulator's shell steps it: readings go out to drivers,
// commands come in.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/effector.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/convert_platform.hpp"
#include "edp/recorder.hpp"

namespace mrroc::sim {

/// Robots of one kind and their world. Robots are counted from 0.
class Plant {
 public:
  virtual ~Plant() = default;

  /// @return how many robots there are
  [[nodiscard]] virtual std::size_t robots() const = 0;
  /// @return name of the process that drives a robot; empty: it is not simulated, and stands
  [[nodiscard]] virtual const std::string& driver(std::size_t robot) const = 0;

  /// Tells what is measured at a step.
  /// @param macrostep  under way @param begins  whether it begins with this step
  virtual void publish(std::int64_t step, std::int64_t macrostep, bool begins) = 0;

  /// Tells where all robots have come to rest, when no driver is left who would count macrosteps.
  /// @param macrostep  that there is none any more
  virtual void publish_rest(std::int64_t /*macrostep*/) {}

  /// @return where the commands for a robot come from
  [[nodiscard]] virtual const link::InboxBase* source(std::size_t robot) const = 0;
  /// @return whether the command for that step has come
  [[nodiscard]] virtual bool has_command(std::size_t robot, std::int64_t step) const = 0;
  /// Takes the command for that step. @return whether there is one that can be obeyed
  virtual bool take_command(std::size_t robot, std::int64_t step) = 0;
  /// The drives of a robot brake from now on, until it takes a command.
  virtual void brake(std::size_t robot) = 0;
  /// @return whether its drives brake
  [[nodiscard]] virtual bool braked(std::size_t robot) const = 0;
  /// @return of its driver's next step, as its last command told
  [[nodiscard]] virtual std::int64_t macrostep(std::size_t robot) const = 0;
  /// @return what its encoders count [increments]
  [[nodiscard]] virtual std::span<const std::int32_t> encoders(std::size_t robot) const = 0;

  /// Keeps readings and commands of a step: the memory of a driver that dies dies with it.
  /// @param dump  a fault has stopped the system: they are written down
  virtual void record(std::int64_t step, bool dump) = 0;
  /// The run has ended with a fault: what has not been written is.
  virtual void dump_on_abort() = 0;

  /// Advances by a step, with the commands taken.
  virtual void step() = 0;
};

/// @param folder  of the run, or none @return when a plant writes down what it has recorded
[[nodiscard]] inline edp::Recording recording_in(const std::filesystem::path& folder) {
  return folder.empty() ? edp::Recording::never : edp::Recording::on_fault;
}

/// The links of such robots with their drivers: channels ROBOT.hardware_state and ROBOT.hardware_command.
template <Effector E>
class DrivenPlant : public Plant {
 public:
  [[nodiscard]] std::size_t robots() const final { return drivers_.size(); }
  [[nodiscard]] const std::string& driver(std::size_t robot) const final { return drivers_[robot]; }
  [[nodiscard]] const link::InboxBase* source(std::size_t robot) const final {
    return command_in_[robot].get();
  }
  [[nodiscard]] bool has_command(std::size_t robot, std::int64_t step) const final {
    return command_in_[robot]->at(step);
  }
  bool take_command(std::size_t robot, std::int64_t step) final {
    const Command* const m = command_in_[robot]->at(step);
    if (!m || !obeyable(*m)) return false;
    drives_[robot] = from_message(*m);
    return true;
  }
  [[nodiscard]] bool braked(std::size_t robot) const final { return !drives_[robot].enabled; }
  [[nodiscard]] std::int64_t macrostep(std::size_t robot) const final { return drives_[robot].macrostep; }

 protected:
  using Drive = typename E::Drive;
  using Reading = typename E::Reading;
  using State = link::MessageOf<Reading>;
  using Command = link::MessageOf<Drive>;

  /// @param drivers  of the robots, see driver()
  explicit DrivenPlant(std::vector<std::string> drivers)
      : drivers_(std::move(drivers)), drives_(drivers_.size()) {}

  /// Makes the links. @param keys  of the robots
  void connect(link::Process& process, const std::vector<std::string>& keys) {
    for (std::size_t robot = 0; robot < keys.size(); ++robot) {
      // What the hardware of a robot is that is not simulated, another plant says.
      state_out_.push_back(drivers_[robot].empty() ? nullptr
                                                   : process.outbox<State>(keys[robot] + ".hardware_state",
                                                                           link::Group::servo_state));
      command_in_.push_back(
          process.inbox<Command>(keys[robot] + ".hardware_command", link::Group::servo_command));
    }
  }
  void publish_reading(std::size_t robot, const Reading& reading, std::int64_t step, std::int64_t macrostep) {
    if (!state_out_[robot]) return;
    State state = to_message(reading);
    state.begun = macrostep + 1;
    state_out_[robot]->publish(state, step);
  }
  /// @return the commands taken, one per robot
  std::vector<Drive>& drives() { return drives_; }

 private:
  [[nodiscard]] virtual bool obeyable(const Command& command) const = 0;

  std::vector<std::string> drivers_;
  std::vector<Drive> drives_;
  std::vector<std::unique_ptr<link::Outbox<State>>> state_out_;  // null: not simulated
  std::vector<std::unique_ptr<link::Inbox<Command>>> command_in_;
};

}  // namespace mrroc::sim
