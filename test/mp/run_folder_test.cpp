// The folder of a run is never overwritten; its summary is complete and valid JSON.
#include "mp/run_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

class RunFolder : public ::testing::Test {
 protected:
  RunFolder() : before_(fs::current_path()) {
    std::string pattern = (fs::temp_directory_path() / "run_folder_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    fs::current_path(folder_);
  }
  ~RunFolder() override {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  template <class F>
  static FaultCode code_of(F f) {
    try {
      f();
    } catch (const FaultError& e) {
      return e.fault().code;
    }
    return FaultCode::none;
  }
  nlohmann::json summary(const Summary& s) const {
    write_summary(folder_, s);
    std::ifstream in(folder_ / "summary.json");
    return nlohmann::json::parse(in);
  }
  fs::path before_, folder_;
};

TEST_F(RunFolder, IsMadeWhereItIsWanted) {
  const fs::path wanted = folder_ / "deep" / "run";
  const fs::path folder = name_run_folder(wanted, "drawing");
  EXPECT_EQ(folder, wanted);
  EXPECT_FALSE(fs::exists(folder));
  make_run_folder(folder);
  EXPECT_TRUE(fs::is_directory(folder / "plots"));
}

TEST_F(RunFolder, OneThatHoldsARunIsRefusedAndLeftAlone) {
  const fs::path folder = name_run_folder("run", "drawing");
  make_run_folder(folder);
  write_text(folder / "config.toml", "seed = 1\n");
  EXPECT_EQ(code_of([&] { name_run_folder("run", "drawing"); }), FaultCode::bad_usage);
  std::ifstream in(folder / "config.toml");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "seed = 1");
}

TEST_F(RunFolder, WithoutAWishItGetsANameThatIsFree) {
  std::vector<fs::path> names;
  for (int k = 0; k < 5; ++k) {
    names.push_back(name_run_folder({}, "drawing"));
    EXPECT_FALSE(fs::exists(names.back()));
    EXPECT_EQ(names.back().parent_path(), "runs");
    EXPECT_TRUE(names.back().filename().string().starts_with("drawing-"));
    make_run_folder(names.back());
  }
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST_F(RunFolder, WhatCannotBeWrittenIsSaid) {
  write_text("file", "x");
  EXPECT_EQ(code_of([] { make_run_folder("file/run"); }), FaultCode::cannot_write);
  EXPECT_EQ(code_of([] { write_text("no/such/folder/file", "x"); }), FaultCode::cannot_write);
}

TEST_F(RunFolder, SummaryOfARunThatIsDone) {
  Summary s;
  s.task = "drawing";
  s.sim_s = 12.5;
  s.wall_s = 2.5;
  s.log_hash = 0xabc;
  s.figures["nodes"] = 41.0;
  s.figures["per_arm"] = std::vector<double>{0.25, std::nan("")};
  s.figures["unknown"] = HUGE_VAL;
  const auto json = summary(s);
  EXPECT_EQ(json.at("task"), "drawing");
  EXPECT_EQ(json.at("outcome"), "done");
  EXPECT_TRUE(json.at("fault").is_null());
  EXPECT_EQ(json.at("sim_s"), 12.5);
  EXPECT_EQ(json.at("real_time_factor"), 5.0);
  EXPECT_EQ(json.at("log_hash"), "0000000000000abc");
  EXPECT_EQ(json.at("figures").at("nodes"), 41.0);
  EXPECT_EQ(json.at("figures").at("per_arm").at(0), 0.25);
  EXPECT_TRUE(json.at("figures").at("per_arm").at(1).is_null());
  EXPECT_TRUE(json.at("figures").at("unknown").is_null());
}

TEST_F(RunFolder, SummaryOfARunThatFailedNamesTheFault) {
  Summary s;
  s.fault = Fault{.code = FaultCode::process_died, .process = "edp-arm1"};
  s.fault->text = "edp-arm1 ended with signal 9 (Killed)";
  auto json = summary(s);
  EXPECT_EQ(json["outcome"], "fault");
  EXPECT_EQ(json["fault"]["code"], "process_died");
  EXPECT_EQ(json["fault"]["class"], "system");
  EXPECT_EQ(json["fault"]["process"], "edp-arm1");
  EXPECT_EQ(json["real_time_factor"], 0);
  s.stopped = true;
  EXPECT_EQ(summary(s)["outcome"], "stopped");
}

TEST_F(RunFolder, SummaryIsValidWhateverBytesAFaultHolds) {
  Summary s;
  s.fault = Fault{.code = FaultCode::internal_error, .process = "\xff\xfe"};
  s.fault->text = "caf\xe9 \x01 \"quoted\"";
  EXPECT_EQ(summary(s)["fault"]["code"], "internal_error");
}

TEST_F(RunFolder, TheSummaryTellsFaultsAfterWhichTheTaskWentOn) {
  Summary s;
  s.task = "manual";
  EXPECT_FALSE(summary(s).contains("survived"));
  s.survived.push_back({{.code = FaultCode::over_current, .process = "edp-arm1"}, 12.5});
  const auto json = summary(s);
  EXPECT_EQ(json.at("outcome"), "done");
  ASSERT_EQ(json.at("survived").size(), 1U);
  EXPECT_EQ(json.at("survived").at(0).at("code"), "over_current");
  EXPECT_EQ(json.at("survived").at(0).at("process"), "edp-arm1");
  EXPECT_EQ(json.at("survived").at(0).at("sim_s"), 12.5);
}

}  // namespace
}  // namespace mrroc::mp
