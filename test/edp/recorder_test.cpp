// The reader of the driver: which steps it keeps, and which files they become.
#include "edp/recorder.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "edp/step_record.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

namespace fs = std::filesystem;

class Records : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  /// Steps first..last as the shell gives them: files are written every ten.
  static void pass(RecordFiles& files, std::int64_t first, std::int64_t last,
                   FaultCode fault = FaultCode::none) {
    for (std::int64_t step = first; step <= last; ++step) {
      files.add({.step = step, .state = DriverState::executing, .fault = fault});
      if (step % 10 == 9) files.write();
    }
  }
  std::vector<std::string> lines(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::vector<std::string> all;
    for (std::string line; std::getline(file, line);) all.push_back(line);
    return all;
  }
  static std::int64_t step_of(const std::string& line) { return std::stoll(line); }
  static auto columns(const std::string& line) { return std::ranges::count(line, ','); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Records, RingKeepsTheNewestInTheirOrder) {
  Recorder ring(4);
  for (std::int64_t step = 0; step < 11; ++step) ring.add({.step = step});
  ASSERT_EQ(ring.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(ring[k].step, 7 + static_cast<std::int64_t>(k));
}

TEST_F(Records, RingThatIsNotFullAndOneForNothingHoldWhatThereIs) {
  Recorder ring(4);
  EXPECT_EQ(ring.size(), 0U);
  for (std::int64_t step = 0; step < 3; ++step) ring.add({.step = step});
  ASSERT_EQ(ring.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(ring[k].step, static_cast<std::int64_t>(k));
  Recorder least(0);
  least.add({.step = 5});
  least.add({.step = 6});
  ASSERT_EQ(least.size(), 1U);
  EXPECT_EQ(least[0].step, 6);
}

TEST_F(Records, ARecordIsWhatTheDriverReadAndCommandedInTheStep) {
  Rig rig;
  rig.world.stiffness[0] = 2000;
  rig.synchronise();
  rig.macrostep(rig.velocity({u(0.05), u(-0.02), u(), u(), u(), u()}));
  HardwareReading reading = rig.world.reading();
  for (std::size_t k = 0; k < reading.current.size(); ++k)
    reading.current[k] = 0.01 * static_cast<double>(k + 1);
  const HardwareCommand command = rig.driver.step(reading);
  const StepRecord r = record_of(rig.driver, reading, command);
  EXPECT_EQ(r.step, reading.step);
  EXPECT_EQ(r.state, rig.driver.state());
  EXPECT_EQ(r.fault, FaultCode::none);
  EXPECT_EQ(r.encoder, reading.encoder);
  EXPECT_EQ(r.current, reading.current);
  EXPECT_EQ(r.pwm, command.pwm);
  EXPECT_EQ(r.S_F_m, reading.S_F_m);
  const SetPoint& set = rig.driver.set_point();
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(r.set_motor[k], set.axes.motors[static_cast<int>(k)]);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(r.set_position[k], set.T_0E.p[static_cast<int>(k)]);
    EXPECT_NEAR(r.position[k], rig.world.T_0E().p[static_cast<int>(k)], 2e-3);
  }
  EXPECT_EQ(r.F_a, rig.driver.samples().back().F_a);
  EXPECT_NE(r.F_a[Axis::x], 0);
}

TEST_F(Records, ALineHasTheFieldsThatTheHeaderNames) {
  Recorder ring(2);
  StepRecord r{.step = 500, .state = DriverState::executing, .fault = FaultCode::over_speed};
  for (std::size_t k = 0; k < 3; ++k) {
    r.set_motor[k] = 10 + static_cast<double>(k);
    r.encoder[k] = 20 + static_cast<std::int32_t>(k);
    r.current[k] = 30 + static_cast<double>(k);
    r.pwm[k] = 40 + static_cast<double>(k);
    r.set_position[k] = 50 + static_cast<double>(k);
    r.position[k] = 60 + static_cast<double>(k);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    r.F_a.v[k] = 70 + static_cast<double>(k);
    r.S_F_m.v[k] = 80 + static_cast<double>(k);
  }
  ring.add(r);
  EXPECT_EQ(StepFormat(2).header(),
            "step,t,state,fault,set_m1,set_m2,enc1,enc2,current1,current2,pwm1,pwm2,set_x,set_y,set_z,x,y,z,"
            "Fx,Fy,Fz,Nx,Ny,Nz,raw_Fx,raw_Fy,raw_Fz,raw_Nx,raw_Ny,raw_Nz\n");
  EXPECT_EQ(record_lines(ring, StepFormat(2), 0.002),
            "500,1.0000,executing,over_speed,10,11,20,21,30,31,40,41,50,51,52,60,61,62,70,71,72,73,74,75,"
            "80,81,82,83,84,85\n");
}

TEST_F(Records, FaultBringsTheStepsBeforeItAndAfterIt) {
  {
    RecordFiles files(Recording::on_fault, folder_, "arm1", 6, 0.002);
    pass(files, 0, 9999);
    pass(files, 10'000, 10'999, FaultCode::over_current);
  }
  const auto all = lines("arm1-fault-10000.csv");
  ASSERT_GE(all.size(), 1 + RecordFiles::kBefore + RecordFiles::kAfter);
  EXPECT_LE(step_of(all[1]), 10'000 - static_cast<std::int64_t>(RecordFiles::kBefore));
  EXPECT_GE(step_of(all.back()), 10'000 + RecordFiles::kAfter);
  for (std::size_t k = 2; k < all.size(); ++k) {
    ASSERT_EQ(step_of(all[k]), step_of(all[k - 1]) + 1);
    ASSERT_EQ(columns(all[k]), columns(all[0]));
  }
  EXPECT_EQ(files(), 1U) << "a fault that stands is one fault";
}

TEST_F(Records, FaultAtTheVeryEndIsWrittenAllTheSame) {
  {
    RecordFiles files(Recording::on_fault, folder_, "arm2", 7, 0.002);
    pass(files, 0, 20);
    pass(files, 21, 21, FaultCode::over_speed);
  }
  EXPECT_EQ(step_of(lines("arm2-fault-21.csv").back()), 21);
}

TEST_F(Records, AFaultElsewhereBringsOneFileToo) {
  {
    RecordFiles files(Recording::on_fault, folder_, "arm1", 6, 0.002);
    pass(files, 0, 4999);
    files.trigger();
    pass(files, 5000, 5099);
    files.dump_on_abort();
  }
  EXPECT_EQ(step_of(lines("arm1-fault-5000.csv").back()), 5059) << "and the steps after it";
  EXPECT_EQ(files(), 1U) << "these steps are written already";
  {
    RecordFiles files(Recording::on_fault, folder_, "arm2", 6, 0.002);
    pass(files, 0, 7000, FaultCode::none);
    files.dump_on_abort();
  }
  EXPECT_EQ(step_of(lines("arm2-fault-7000.csv").back()), 7000) << "no more steps came";
  RecordFiles empty(Recording::on_fault, folder_, "arm3", 6, 0.002);
  empty.dump_on_abort();
  EXPECT_EQ(files(), 2U) << "there is nothing to write";
}

TEST_F(Records, ManyFaultsMakeFewFiles) {
  {
    RecordFiles files(Recording::on_fault, folder_, "arm1", 6, 0.002);
    for (std::int64_t k = 0; k < 20; ++k) {
      pass(files, 200 * k, 200 * k + 99);
      pass(files, 200 * k + 100, 200 * k + 199, FaultCode::force_limit);
    }
  }
  EXPECT_EQ(files(), static_cast<std::size_t>(RecordFiles::kMostFiles));
}

TEST_F(Records, WhatHappensElsewhereMakesNoFileMoreThanTheMost) {
  {
    RecordFiles files(Recording::on_fault, folder_, "arm1", 6, 0.002);
    std::int64_t step = 0;
    for (int k = 0; k < RecordFiles::kMostFiles; ++k) {
      pass(files, step, step + 99);
      pass(files, step + 100, step + 199, FaultCode::force_limit);
      step += 200;
    }
    const auto long_after = static_cast<std::int64_t>(RecordFiles::kBefore) + 200;
    pass(files, step, step + long_after);
    files.trigger();
    pass(files, step + long_after + 1, step + 2 * long_after);
    files.dump_on_abort();
  }
  EXPECT_EQ(files(), static_cast<std::size_t>(RecordFiles::kMostFiles));
}

TEST_F(Records, AlwaysIsEveryStepOnce) {
  {
    RecordFiles files(Recording::always, folder_, "arm1", 6, 0.002);
    pass(files, 0, 999);
  }
  const auto all = lines("arm1-steps.csv");
  ASSERT_EQ(all.size(), 1001U);
  for (std::size_t k = 1; k < all.size(); ++k) ASSERT_EQ(step_of(all[k]), static_cast<std::int64_t>(k) - 1);
}

TEST_F(Records, NeverIsNothing) {
  {
    RecordFiles files(Recording::never, folder_, "arm1", 6, 0.002);
    pass(files, 0, 99, FaultCode::over_speed);
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(Records, FolderThatIsGoneEndsNothing) {
  RecordFiles files(Recording::always, folder_ / "gone", "arm1", 6, 0.002);
  EXPECT_NO_THROW(pass(files, 0, 99));
}

}  // namespace
}  // namespace mrroc::edp::test
