// The reader of the driver: which steps it keeps, and which files they become.
#include "edp/recorder.hpp"

#include <gtest/gtest.h>

#include <fstream>

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
    files.throw_down();
  }
  EXPECT_EQ(step_of(lines("arm1-fault-5000.csv").back()), 5059) << "and the steps after it";
  EXPECT_EQ(files(), 1U) << "these steps are written already";
  {
    RecordFiles files(Recording::on_fault, folder_, "arm2", 6, 0.002);
    pass(files, 0, 7000, FaultCode::none);
    files.throw_down();
  }
  EXPECT_EQ(step_of(lines("arm2-fault-7000.csv").back()), 7000) << "no more steps came";
  RecordFiles empty(Recording::on_fault, folder_, "arm3", 6, 0.002);
  empty.throw_down();
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
