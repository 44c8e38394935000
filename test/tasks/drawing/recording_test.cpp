#include "tasks/drawing/recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "base/fault.hpp"
#include "test/tasks/drawing/folder.hpp"

namespace mrroc::drawing {
namespace {

Node numbered(double k) {
  return {{{k, -k, k / 3, 0, k * k, -0.0}}, kPenStates[static_cast<std::size_t>(k) % 4]};
}

Taught random_taught(unsigned seed, int nodes, int points) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> digits(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 2);
  const auto number = [&] { return digits(random) * std::pow(10.0, exponent(random)); };
  Taught taught{Recording(0.1 + 0.2), {}};
  for (int p = 0; p < nodes; ++p) {
    Node node;
    for (double& v : node.velocity.v) v = number();
    node.pen = kPenStates[random() % 4];
    taught.recording = taught.recording.appended(node);
  }
  taught.recording =
      taught.recording.appended({{{5e-324, -0.0, 1.0 / 3, 0.1, 1e300, 0}}, PenState::paper_surface});
  for (int k = 0; k < points; ++k) taught.ink.push_back({k / 10, 0.1 * k, number(), number()});
  return taught;
}

TEST(PenStates, HaveNamesThatReadBack) {
  for (const PenState s : kPenStates) EXPECT_EQ(pen_state_named(to_string(s)), s);
  EXPECT_FALSE(pen_state_named(""));
  EXPECT_FALSE(pen_state_named("Paper surface"));
}

TEST(Recording, AppendingLeavesEveryEarlierVersionAsItWas) {
  std::vector<Recording> versions{Recording(0.02)};
  for (int k = 0; k < 100; ++k) versions.push_back(versions.back().appended(numbered(k)));
  for (std::size_t v = 0; v < versions.size(); ++v) {
    ASSERT_EQ(versions[v].size(), v);
    for (std::size_t p = 0; p < v; ++p) EXPECT_EQ(versions[v][p], numbered(static_cast<double>(p)));
  }
}

TEST(Recording, BranchesFromOneVersionDoNotDisturbEachOther) {
  Recording trunk(0.02);
  for (int k = 0; k < 10; ++k) trunk = trunk.appended(numbered(k));
  const Recording left = trunk.appended(numbered(100));
  const Recording right = trunk.appended(numbered(200));
  const Recording longer = left.appended(numbered(101));
  EXPECT_EQ(left[10], numbered(100));
  EXPECT_EQ(right[10], numbered(200));
  EXPECT_EQ(longer[10], numbered(100));
  EXPECT_EQ(trunk.size(), 10u);
  EXPECT_NE(left, right);
  EXPECT_EQ(trunk.appended(numbered(100)), left);
}

TEST(Recording, EqualityLooksAtDurationAndNodes) {
  EXPECT_EQ(Recording(0.02), Recording(0.02));
  EXPECT_NE(Recording(0.02), Recording(0.01));
  EXPECT_NE(Recording(0.02).appended(numbered(1)), Recording(0.02));
}

TEST(Recording, AMillionAppendsShareOneBuffer) {  // copying each time would take hours
  Recording recording(0.02);
  for (int k = 0; k < 1'000'000; ++k) recording = recording.appended(numbered(k % 7));
  EXPECT_EQ(recording.size(), 1'000'000u);
}

TEST(RecordingFile, GivesBackEveryBit) {
  const Folder folder;
  for (unsigned seed = 1; seed < 20; ++seed) {
    const Taught taught = random_taught(seed, static_cast<int>(seed) * 7, seed % 2 ? 50 : 0);
    save(folder / "taught.txt", taught);
    const Taught read = load(folder / "taught.txt");
    EXPECT_EQ(read, taught);
    for (std::size_t p = 0; p < taught.recording.size(); ++p)
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_EQ(std::signbit(read.recording[p].velocity.v[k]),
                  std::signbit(taught.recording[p].velocity.v[k]));
  }
}

TEST(RecordingFile, IsReadableText) {
  const Folder folder;
  save(folder / "t.txt",
       {Recording(0.02).appended({{{0.5, 0, 0, 0, 0, 0}}, PenState::paper_surface}), {{0, 1.5, -2, 3}}});
  EXPECT_EQ(content(folder / "t.txt"),
            "mrroc-drawing-recording 1\nmacrostep_s 0.02\nnodes 1\nx y z ax ay az pen\n0.5 0 0 0 0 0 "
            "paper_surface\n"
            "ink 1\nstroke t x y\n0 1.5 -2 3\nend\n");
}

TEST(RecordingFile, DamageIsNamedWithFileAndLine) {
  const Folder folder;
  const std::string good =
      "mrroc-drawing-recording 1\nmacrostep_s 0.02\nnodes 2\nx y z ax ay az pen\n1 2 3 4 5 6 paper_surface\n"
      "1 2 3 4 5 6 lift_off\nink 2\nstroke t x y\n0 1 2 3\n1 1 2 3\nend\n";
  const auto error = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    std::ofstream(folder / "r.txt", std::ios::binary) << text;
    try {
      (void)load(folder / "r.txt");
    } catch (const FileError& e) {
      return e.what();
    }
    return "";
  };
  ASSERT_EQ(error("", ""), "");
  struct Case {
    std::string from, to, line, part;
  };
  for (const Case& c : std::vector<Case>{{"mrroc-drawing", "other", "1", "--save"},
                                         {"recording 1", "recording 2", "1", "version 1"},
                                         {"0.02", "0", "2", "macrostep"},
                                         {"0.02", "nan", "2", "finite"},
                                         {"0.02", "0.02 3", "2", "macrostep"},
                                         {"macrostep_s", "macrostep", "2", "macrostep_s"},
                                         {"nodes 2", "nodes -1", "3", "whole number"},
                                         {"nodes 2", "nodes 99999999", "3", "whole number"},
                                         {"nodes 2", "nodes 1", "6", "ink"},
                                         {"nodes 2", "nodes 3", "7", "finite number"},
                                         {"ax ay", "ay ax", "4", "x y z"},
                                         {"3 4 5", "3 nan 5", "5", "finite"},
                                         {"3 4 5", "3 inf 5", "5", "finite"},
                                         {"3 4 5", "3 1e999 5", "5", "finite"},
                                         {"3 4 5", "3  5", "5", "finite"},
                                         {"3 4 5", "3 4x 5", "5", "4x"},
                                         {"6 paper_surface", "6", "5", "pen state"},
                                         {"6 paper_surface", "6 above_paper", "6", "nothing to draw"},
                                         {"lift_off", "lift_off ", "6", "pen state"},
                                         {"ink 2", "ink 1", "10", "end"},
                                         {"ink 2", "ink 3", "11", "whole number"},
                                         {"0 1 2 3", "0 1 2", "9", "numbers"},
                                         {"0 1 2 3", "0 1 2 3 4", "9", "fields"},
                                         {"0 1 2 3", "0.5 1 2 3", "9", "whole number"},
                                         {"0 1 2 3", "2 1 2 3", "10", "goes back"},
                                         {"end\n", "end\nmore\n", "12", "behind the end"},
                                         {"end\n", "end", "11", "truncated"},
                                         {"end\n", "", "11", "truncated"}}) {
    const std::string what = error(c.from, c.to);
    EXPECT_NE(what.find("r.txt:" + c.line + ": "), std::string::npos) << what << " for " << c.to;
    EXPECT_NE(what.find(c.part), std::string::npos) << what << " for " << c.to;
  }
  for (std::size_t cut = 1; cut < good.size(); ++cut) EXPECT_NE(error(good.substr(cut), ""), "") << cut;
}

TEST(RecordingFile, RefusesWhatIsNotFiniteAndWhereItCannotWrite) {
  const Folder folder;
  const Taught bad{Recording(0.02).appended({{{std::nan("")}}, PenState::paper_surface}), {}};
  EXPECT_THROW(save(folder / "r.txt", bad), FileError);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.txt"));
  EXPECT_THROW(save(folder / "no" / "such" / "r.txt", random_taught(1, 3, 3)), FaultError);
  EXPECT_THROW((void)load(folder / "none.txt"), FileError);
}

TEST(InkTable, ReadsBackToItsLastDigit) {
  const Folder folder;
  const Ink ink{{0, 0.002, -12.3456, 78.9}, {0, 0.004, -12.4, 79}, {3, 0.004, 1, 2}};
  write_ink(folder / "ink.csv", ink);
  EXPECT_EQ(read_ink(folder / "ink.csv"), ink);
  EXPECT_EQ(content(folder / "ink.csv").substr(0, 13), "stroke,t,x,y\n");
  write_ink(folder / "none.csv", {});
  EXPECT_TRUE(read_ink(folder / "none.csv").empty());
}

TEST(InkTable, DamageIsNamedWithItsLine) {
  const Folder folder;
  const auto error = [&](const std::string& rows) -> std::string {
    std::ofstream(folder / "i.csv", std::ios::binary) << "stroke,t,x,y\n0,1,2,3\n" + rows;
    try {
      (void)read_ink(folder / "i.csv");
    } catch (const FileError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error("0,1,2,3\n"), "");
  for (const std::string row : {"0,1,2\n", "0,1,2,3,4\n", "0,1,2,3,\n", "0,1,nan,3\n", "-1,1,2,3\n",
                                "0,0.5,2,3\n", "\n", "0,1,2,3", "99999999,1,2,3\n"})
    EXPECT_NE(error(row).find("i.csv:3: "), std::string::npos) << row << error(row);
  EXPECT_NE(error("1,1,2,3\n0,1,2,3\n").find("i.csv:4: "), std::string::npos);
}

TEST(Ink, StrokesAndInkAreTheSameThingTwice) {
  const Drawing drawing = arrow();
  EXPECT_EQ(strokes_of(ink_of(drawing)), drawing);
  EXPECT_EQ(strokes_of({{2, 0, 1, 1}}).size(), 3u);
}

}  // namespace
}  // namespace mrroc::drawing
