// The structure figures of REX in docs/rex.md are made from the code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/file_content.hpp"
#include "test/docs/rex_data_flow.hpp"
#include "test/docs/rex_tables.hpp"

namespace mrroc::test {
namespace {

/// @return what an output of a behaviour is made of, below x
std::vector<std::string> made_of(int m, const std::string& output) {
  std::vector<std::string> names;
  for (const Flow& flow : data_flows())
    if (flow.m == m && flow.output.here == output)
      for (const BufferName& input : flow.inputs) names.push_back(input.here);
  return names;
}
bool reads(int m, const std::string& output, const std::string& input) {
  const auto inputs = made_of(m, output);
  return std::ranges::find(inputs, input) != inputs.end();
}

TEST(RexDocument, DataFlowsHaveWhatTheAlgorithmsOfThePaperRead) {
  // Algorithm 4: desired_plan, trajgen, q~.
  for (const char* output : {"y.c.plan", "y.c.traj", "y.c.trajgen", "y.c.new_plan"})
    EXPECT_TRUE(reads(1, output, "x.T.desired")) << output;
  EXPECT_TRUE(reads(1, "y.c.trajgen", "x.c.trajgen"));
  EXPECT_TRUE(reads(1, "y.c.trajgen", "x.e.estimate"));
  // Algorithm 5: desired_plan.
  EXPECT_TRUE(reads(1, "y.T.event", "x.T.desired"));
  // Algorithm 6: traj, trajgen, plan, new, ready.
  for (const char* input : {"x.c.traj", "x.c.trajgen", "x.e.notified"})
    EXPECT_TRUE(reads(2, "y.c.traj", input)) << input;
  for (const char* input : {"x.c.plan", "x.c.trajgen", "x.c.new_plan"})
    EXPECT_TRUE(reads(2, "y.c.trajgen", input)) << input;
  // Algorithm 7: ready, traj.
  for (const char* output : {"y.e.fragment.knot", "y.e.fragment.steps", "y.e.fragment.notify"})
    for (const char* input : {"x.c.traj", "x.e.notified"})
      EXPECT_TRUE(reads(2, output, input)) << output << ", " << input;
}

TEST(RexDocument, DataFlowsHaveWhatThePaceAndTheHandoverDependOn) {
  for (const int m : {1, 2, 3}) {
    EXPECT_TRUE(reads(m, "y.c.pace", "x.e.estimate")) << "a position that is not known well enough";
    EXPECT_TRUE(reads(m, "y.c.pace", "x.T.variant"));
    EXPECT_EQ(made_of(m, "y.e.pace"), std::vector<std::string>{"x.c.pace"});
  }
  for (const char* output : {"y.c.handed", "y.c.traj", "y.e.fragment.knot"})
    for (const char* input : {"x.c.end", "x.e.remaining"})
      EXPECT_TRUE(reads(2, output, input))
          << output << ", " << input << ": a fragment from rest waits for it";
}

TEST(RexDocument, WhatComesThroughIsRoutedInEveryBehaviour) {
  for (const int m : {1, 2, 3}) {
    EXPECT_EQ(made_of(m, "y.e.map"), std::vector<std::string>{"x.T.map"}) << m;
    EXPECT_EQ(made_of(m, "y.e.odometry"), std::vector<std::string>{"x.V"}) << m;
    EXPECT_EQ(made_of(m, "y.T.estimate"), std::vector<std::string>{"x.e.estimate"}) << m;
  }
}

TEST(RexDocument, AFragmentGoesOutInTheSecondBehaviourOnly) {
  for (const int m : {1, 3}) EXPECT_TRUE(made_of(m, "y.e.fragment.knot").empty()) << m;
}

TEST(RexDocument, TablesHaveNoFunctionWithoutAName) {
  for (const MadePart& part : rex_tables())
    EXPECT_EQ(part.text.find("| ? |"), std::string::npos) << part.name;
}

TEST(RexDocument, PartsComeIntoTheirPlacesAndNoWhereElse) {
  const std::string empty = "a\n<!-- made: b -->\n<!-- end: b -->\nc\n";
  const std::string full = with_parts(empty, {{"b", "new\n"}});
  EXPECT_EQ(full, "a\n<!-- made: b -->\n\nnew\n\n<!-- end: b -->\nc\n");
  EXPECT_EQ(with_parts(full, {{"b", "new\n"}}), full);
  EXPECT_THROW(std::ignore = with_parts(empty, {{"d", ""}}), std::runtime_error);
}

TEST(RexDocument, IsMadeFromTheCode) {
  const std::string file = MRROC_SOURCE_DIR "/docs/rex.md";
  const std::string document = with_parts(file_content(file), rex_tables());
  if (std::getenv("MRROC_UPDATE_DOCS") != nullptr) std::ofstream(file) << document;
  EXPECT_EQ(file_content(file), document) << "run: MRROC_UPDATE_DOCS=1 ./run test -R RexDocument";
}

}  // namespace
}  // namespace mrroc::test
