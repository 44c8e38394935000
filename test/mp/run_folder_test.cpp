// The folder of a run is never overwritten; its summary is complete and valid JSON.
#include "mp/run_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "mp/figure_table.hpp"

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

TEST_F(RunFolder, ANameThatCannotBeOneIsAWrongWordAndNoMistakeOfTheProgram) {
  fs::create_directories("runs");
  for (const std::string& name : {std::string(300, 'a'), std::string(5000, 'a')})
    for (const fs::path& folder : {fs::path(name), fs::path("runs") / name}) try {
        name_run_folder(folder, "drawing");
        FAIL() << name.size();
      } catch (const FaultError& e) {
        EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
        EXPECT_LT(std::string(e.what()).size(), 200U) << "the reason can be read";
      }
}

TEST_F(RunFolder, ASummaryThatIsThereStaysWholeWhenAnotherCannotBeWritten) {
  Summary s;
  s.task = "first";
  write_summary(folder_, s);
  fs::create_directories(folder_ / "summary.json.new" / "in the way");
  s.task = "second";
  EXPECT_EQ(code_of([&] { write_summary(folder_, s); }), FaultCode::cannot_write);
  std::ifstream in(folder_ / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(in).at("task"), "first");
}

TEST_F(RunFolder, ASummaryThatIsWrittenInPartIsNotLeft) {
  Summary s;
  s.task = "first";
  write_summary(folder_, s);
  fs::create_symlink("/dev/full", folder_ / "summary.json.new");
  EXPECT_EQ(code_of([&] { write_summary(folder_, s); }), FaultCode::cannot_write);
  EXPECT_FALSE(fs::is_symlink(folder_ / "summary.json.new"));
  std::ifstream in(folder_ / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(in).at("task"), "first");
}

TEST_F(RunFolder, TheSummaryHasWhatIsWantedOfItsFigures) {
  constexpr std::array kKnown{
      FigureInfo{.key = "low", .words = "", .unit = {}, .low = 1},
      FigureInfo{.key = "high", .words = "", .unit = {}, .high = 0.5},
      FigureInfo{.key = "both", .words = "", .unit = {}, .low = 0.9, .high = 1.1},
      FigureInfo{.key = "nothing", .words = "", .unit = {}},
      FigureInfo{.key = "elsewhere", .words = "", .unit = {}, .high = 7},
  };
  Summary s;
  s.figures = {
      {"low", 2.0}, {"high", 0.1}, {"both", std::vector{1.0, 1.05}}, {"nothing", 3.0}, {"unknown", 4.0}};
  s.wanted = bounds_of(s.figures, kKnown);
  EXPECT_EQ(summary(s).at("wanted"),
            nlohmann::json::parse(R"({"low": [1.0, null], "high": [null, 0.5], "both": [0.9, 1.1]})"));
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

TEST_F(RunFolder, WhyOneCannotBeUsedIsSaidWithWhatToDo) {
  const auto said = [&](const fs::path& wanted) -> std::string {
    try {
      name_run_folder(wanted, "drawing");
    } catch (const FaultError& e) {
      return e.error_line();
    }
    return "";
  };
  fs::create_directories("full");
  EXPECT_EQ(said("full"), "") << "an empty folder can be used";
  write_text("full/notes", "x");
  EXPECT_NE(said("full").find("full is not empty; choose another --run-dir or delete it"), std::string::npos)
      << said("full");
  EXPECT_NE(said("full/notes").find("full/notes is a file, and a folder is wanted"), std::string::npos)
      << said("full/notes");
  write_text("full/config.toml", "x");
  EXPECT_NE(said("full").find("full holds a run already; choose another --run-dir or delete it"),
            std::string::npos)
      << said("full");
  const std::string name(300, 'a');
  EXPECT_NE(said(name).find(" " + std::string(60, 'a') + "... cannot be a run folder: "), std::string::npos)
      << said(name);
  EXPECT_NE(said(name).find("; choose another --run-dir"), std::string::npos) << said(name);
  EXPECT_TRUE(said(name).starts_with("error: bad_usage: ")) << said(name);
  fs::create_directories("x");
  const std::string long_and_short = std::string("x/") + std::string(300, 'b');
  EXPECT_NE(said(long_and_short).find("x/" + std::string(58, 'b') + "... cannot"), std::string::npos);
}

TEST_F(RunFolder, ASecondOneOfTheSameSecondHasANumber) {
  const auto once = [&] {
    const fs::path first = name_run_folder({}, "press");
    make_run_folder(first);
    const fs::path second = name_run_folder({}, "press");
    make_run_folder(second);
    const fs::path third = name_run_folder({}, "press");
    const bool same = second == first.string() + "-2" && third == first.string() + "-3";
    fs::remove_all("runs");
    return same;
  };
  EXPECT_TRUE(once() || once() || once()) << "unless a second ends just then";
}

TEST_F(RunFolder, OneThatDidNotBeginIsRemovedAndNothingElse) {
  make_run_folder("run");
  discard_run_folder("run");
  EXPECT_TRUE(fs::exists("run")) << "it has no configuration: it is no run";
  write_text("run/config.toml", "x");
  discard_run_folder("run");
  EXPECT_FALSE(fs::exists("run"));
  discard_run_folder("nowhere");
}

TEST_F(RunFolder, WhatCannotBeMadeOrWrittenIsNamed) {
  const auto said = [](const std::function<void()>& f) -> std::string {
    try {
      f();
    } catch (const FaultError& e) {
      return std::string(e.fault().text.view());
    }
    return "";
  };
  write_text("file", "x");
  EXPECT_TRUE(said([] { make_run_folder("file/run"); }).starts_with("cannot make file/run: "));
  EXPECT_EQ(said([] { write_text("no/file", "x"); }), "cannot write no/file");
  fs::create_directories("there/summary.json/in the way");
  EXPECT_EQ(said([] { write_summary("there", {}); }), "cannot write there/summary.json");
  EXPECT_EQ(said([] { write_summary("nowhere", {}); }), "cannot write nowhere/summary.json.new");
}

TEST_F(RunFolder, TheSummaryHasEveryFieldAndNoFileButItself) {
  Summary s;
  s.task = "press";
  s.wall_s = 4;
  s.sim_s = 2;
  s.fault = Fault{.code = FaultCode::joint_limit, .process = "edp-arm1"};
  s.black_box = {"black_box/mp.txt", "arm1.csv"};
  const auto json = summary(s);
  EXPECT_EQ(json.at("wall_s"), 4.0);
  EXPECT_EQ(json.at("real_time_factor"), 0.5);
  EXPECT_EQ(json.at("log_hash"), "0000000000000000");
  EXPECT_EQ(json.at("black_box"), (nlohmann::json{"black_box/mp.txt", "arm1.csv"}));
  EXPECT_EQ(json.at("fault").at("text"), what_happened(*s.fault));
  EXPECT_TRUE(json.at("figures").is_object());
  EXPECT_FALSE(fs::exists(folder_ / "summary.json.new"));
  std::ifstream in(folder_ / "summary.json");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(text.starts_with("{\n  \"task\": \"press\",\n")) << text;
  EXPECT_TRUE(text.ends_with("}\n"));
  s.black_box.clear();
  EXPECT_FALSE(summary(s).contains("black_box"));
}

}  // namespace
}  // namespace mrroc::mp
