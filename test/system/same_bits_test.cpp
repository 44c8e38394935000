// A run has the same bits whatever the processor can do: the same programs choose no other sin, exp, ... when the newest
// instructions are hidden from the libraries that choose.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariables[][2] = {
    {"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4"},
    {"OPENCV_CPU_DISABLE", "AVX,AVX2,FMA3,AVX512_SKX"},
    {"LP_NATIVE_VECTOR_WIDTH", "128"},
};

/// Hides AVX2 and FMA from the programs that are started while it lives.
class OldProcessor {
 public:
  OldProcessor() {
    for (const auto& [name, value] : kVariables) ::setenv(name, value, 1);
  }
  ~OldProcessor() {
    for (const auto& [name, value] : kVariables) ::unsetenv(name);
  }
  OldProcessor(const OldProcessor&) = delete;
  OldProcessor& operator=(const OldProcessor&) = delete;
};

struct Case {
  const char* task;
  std::vector<std::string> options;  // seconds of it are enough
};

class SameBits : public ::testing::TestWithParam<Case> {};

TEST_P(SameBits, OfARunOnAProcessorWithoutTheNewestInstructions) {
  if (kSanitized) GTEST_SKIP() << "of sanitized programs nobody compares runs";
  const auto& [task, options] = GetParam();
  const Folder folder(false);
  const auto hash_of = [&](const std::string& name) {
    std::vector<std::string> words{"--processes", "one", "--run-dir", (folder / name).string()};
    words.insert(words.end(), options.begin(), options.end());
    run(folder, task, words);
    return summary(folder / name).at("log_hash").get<std::string>();
  };
  const std::string here = hash_of("here");
  EXPECT_NE(here, std::string(16, '0'));
  const OldProcessor old;
  EXPECT_EQ(hash_of("old"), here);
}

// When the arm rests is heard at another moment in each run; what is sent until then is the same.
TEST(SameBits, OfRunsThatAStopHasEnded) {
  if (kSanitized) GTEST_SKIP() << "of sanitized programs nobody compares runs";
  const Folder folder(false);
  std::set<std::string> hashes;
  for (int k = 0; k < 8; ++k) {
    const fs::path place = folder / std::to_string(k);
    run(folder, "press", {"--max-time", "2.5", "--processes", "one", "--run-dir", place.string()});
    const nlohmann::json told = summary(place);
    EXPECT_EQ(told.at("fault").at("code"), "time_limit");
    hashes.insert(told.at("log_hash"));
  }
  EXPECT_EQ(hashes.size(), 1U);
  EXPECT_FALSE(hashes.contains(std::string(16, '0')));
}

INSTANTIATE_TEST_SUITE_P(Tasks, SameBits,
                         ::testing::Values(Case{"press", {}}, Case{"weigh", {}}, Case{"edge_follow", {}},
                                           Case{"drawing", {"--max-time", "20"}},
                                           Case{"haptic", {"--max-time", "6"}},
                                           Case{"ball", {"--max-time", "6"}},
                                           Case{"rubik", {"--scramble", "U", "--max-time", "6"}},
                                           Case{"visual_servo", {"--max-time", "4"}}),
                         [](const auto& tested) { return std::string(tested.param.task); });

}  // namespace
}  // namespace mrroc::test
