// What a coordinator of two arms needs of the house around it, in one thread, with nobody at the other ends.
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/msg/convert.hpp"
#include "mp/task_run.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp {

/// A run of a task with two arms, whose reports the test gives.
class CoordinatorRig : public ::testing::Test {
 protected:
  CoordinatorRig();
  ~CoordinatorRig() override;
  static link::NodeContext context();
  /// Each arm reports that in macrostep i.
  void report_all(std::int64_t i, const Report& report = {.ready = true});

 private:
  std::vector<std::unique_ptr<link::Outbox<agent_report_t>>> reports_;
  std::filesystem::path folder_;

 protected:
  const std::vector<std::string> arms{"arm1", "arm2"};
  link::test::DirectBus bus;
  link::Process process{bus, context()};
  std::optional<TaskRun> run;
};

}  // namespace mrroc::mp
