#include "tasks/rubik/solve_command.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

struct Result {
  int status;
  std::string out, err;
};

Result run(std::vector<const char*> words, const std::string& input = "") {
  words.insert(words.begin(), {"cube_solve", "--tables-dir", test::tables_folder()});
  std::istringstream in(input);
  std::ostringstream out, err;
  const int status =
      run_cube_solve(static_cast<int>(words.size()), words.data(), {in, out, err}, TableSet::small);
  return {status, out.str(), err.str()};
}

/// @return whether the line is a solution of the cube, with its number of turns in front
bool solves(const std::string& line, const Cube& cube) {
  std::istringstream stream(line);
  std::size_t turns = 99;
  std::string rest;
  stream >> turns;
  std::getline(stream, rest);
  const Moves moves = parse_moves(rest);
  return moves.size() == turns && after(cube, moves) == Cube{};
}

const std::string kProven = "IDA*: proven to be a shortest solution\n";

TEST(SolveCommand, SolvesTurnsAndFacelets) {
  const Result turns = run({"R", "U'", "F2"});
  EXPECT_EQ(turns.status, 0);
  EXPECT_EQ(turns.out, "3 F2 U R'\n");
  EXPECT_EQ(turns.err, kProven);
  EXPECT_EQ(run({"R U\u2019 F2"}).out, turns.out);
  EXPECT_EQ(run({"R U' F2", "--optimal"}).out, turns.out);
  EXPECT_EQ(run({to_facelets(after({}, parse_moves("R U' F2"))).c_str(), "--optimal"}).out, turns.out);
  EXPECT_EQ(run({to_facelets({}).c_str()}).out, "0\n");
}

TEST(SolveCommand, GoesOnAfterAnImpossibleCubeAndNamesItsLine) {
  std::mt19937_64 random(1);
  const Cube first = random_cube(random), second = after({}, random_moves(6, random));
  std::string twisted = to_facelets({});
  twisted[8] = 'F', twisted[9] = 'U', twisted[20] = 'R';
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("cubes-" + std::to_string(::getpid()));
  std::ofstream(file) << "# cubes\n"
                      << to_facelets(first) << " some remark\n\n"
                      << twisted << "\nR U Q\n"
                      << to_facelets(second) << '\n';
  const Result result = run({"--file", file.c_str(), "--budget-ms", "1"});
  std::filesystem::remove(file);
  EXPECT_EQ(result.status, 2);
  std::istringstream out(result.out);
  std::string line;
  ASSERT_TRUE(std::getline(out, line));
  EXPECT_TRUE(solves(line, first)) << line;
  ASSERT_TRUE(std::getline(out, line));
  EXPECT_TRUE(solves(line, second)) << line;
  EXPECT_FALSE(std::getline(out, line));
  EXPECT_NE(result.err.find("error: bad_cube: line 4: the rule 'twist' is broken"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("error: bad_cube: line 5: 'Q' at character 5 is no turn"), std::string::npos);
}

TEST(SolveCommand, TellsWhichSearchFoundASolutionAndWhatIsProven) {
  std::mt19937_64 random(2);
  const std::string far = to_facelets(random_cube(random));
  const Result two_phase = run({"--budget-ms", "2", far.c_str()});
  EXPECT_EQ(two_phase.status, 0);
  EXPECT_EQ(two_phase.err.rfind("two-phase: not proven to be a shortest solution, at least ", 0), 0U)
      << two_phase.err;
  EXPECT_EQ(run({"--optimal", "R U"}).err, kProven);
  const Result lines = run({"--file", "-"}, "R U\n\nF2\n");
  EXPECT_EQ(lines.err, "line 1: " + kProven + "line 3: " + kProven);
}

TEST(SolveCommand, ReadsACubeALineFromTheStandardInput) {
  std::string grouped = to_facelets(after({}, parse_moves("F2")));
  for (std::size_t k = 45; k > 0; k -= 9) grouped.insert(k, " ");
  const Result result = run({"--file", "-"}, "R U\n# a remark\n" + grouped + " F2\n" + "R2");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "2 U' R'\n1 F2\n1 R2\n");
}

TEST(SolveCommand, TellsFaceletsThatAreNotWholeAsFacelets) {
  std::string facelets = to_facelets({});
  facelets[11] = 'x';
  EXPECT_NE(run({facelets.c_str()}).err.find("facelet R3, number 12, is 'x'"), std::string::npos);
  const Result shorter = run({"--file", "-"}, facelets.substr(12));
  EXPECT_EQ(shorter.status, 2);
  EXPECT_NE(shorter.err.find("line 1: the rule 'length' is broken: 42 facelets instead of 54"),
            std::string::npos)
      << shorter.err;
}

TEST(SolveCommand, ProvesShortSolutionsWhateverTheBudget) {
  const Result result = run({"--optimal", "--budget-ms", "1", "--threads", "2", "R U2 F L D' B2 R2 U F'"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(solves(result.out, after({}, parse_moves("R U2 F L D' B2 R2 U F'"))));
  EXPECT_EQ(result.err, kProven);
}

TEST(SolveCommand, RefusesBadUsage) {
  for (const std::vector<const char*>& words : {std::vector<const char*>{},
                                                {""},
                                                {" ", ""},
                                                {"--file", "-"},
                                                {"--tables", "huge", "R"},
                                                {"--budget-ms", "0", "R"},
                                                {"--threads", "0", "R"},
                                                {"--file", "/nowhere/cubes"},
                                                {"--file", "/nowhere/cubes", "R"},
                                                {"--fast", "R"}}) {
    const Result result = run(words);
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(result.out.empty());
    EXPECT_EQ(result.err.rfind("error: bad_usage: ", 0), 0U) << result.err;
  }
  EXPECT_EQ(run({"UUUUUUUUURRRRRRRRRFFFFFFFFFDDDDDDDDDLLLLLLLLLBBBBBBBB"}).status, 2);
  EXPECT_EQ(run({"--help"}).status, 0);
}

}  // namespace
}  // namespace mrroc::rubik
