// docs/tables.md shows the papers' tables beside what the code's own tables command, and both are the same but where
// the document says why.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "test/docs/paper_tables.hpp"

namespace mrroc::test {
namespace {

TEST(PaperTables, AreWhatTheBehavioursCommandButWhereANoteSaysWhy) {
  const auto tables = paper_tables();
  EXPECT_EQ(tables.size(), 16U);
  for (const PaperTable& t : tables) {
    const Commanded code = t.code();
    std::size_t k = 0;
    for (const char* name : {"x", "y", "z", "ax", "ay", "az"}) {
      const std::string& printed = t.printed[k];
      EXPECT_EQ(same(printed, code.frame[kAxes[k]]), !t.notes.contains(name))
          << t.name << ", " << name << ": printed " << printed << ", commanded "
          << written(code.frame[kAxes[k]]);
      ++k;
    }
    EXPECT_EQ(code.jaws.has_value(), !t.printed_jaws.empty()) << t.name;
    if (code.jaws) {
      EXPECT_NEAR(*code.jaws, std::stod(t.printed_jaws), 1e-12) << t.name;
    }
  }
}

TEST(PaperTables, ARowIsTheSameOnlyWhenAllItsEntriesAre) {
  EXPECT_TRUE(same("g - 0.01 5 0.0025", g(0.01, 5, 0.0025)));
  EXPECT_FALSE(same("g - 0.01 5 0.0025", g(0.01, 5, 0.005)));
  EXPECT_FALSE(same("u - 0 - -", c(0, 20, 0.005)));
  EXPECT_TRUE(same("u - node - -", u(0.003)));
  EXPECT_FALSE(same("u - node - -", u()));
}

TEST(PaperTables, DocumentIsMadeFromThem) {
  const std::string file = MRROC_SOURCE_DIR "/docs/tables.md";
  if (std::getenv("MRROC_UPDATE_DOCS") != nullptr) std::ofstream(file) << tables_document();
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text, tables_document()) << "run: MRROC_UPDATE_DOCS=1 ./run test -R PaperTables";
}

}  // namespace
}  // namespace mrroc::test
