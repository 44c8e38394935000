// A fuzz target over the files of its corpus, and over seeded damage to them: what has been found once stays mended, and
// without the compiler that fuzzing needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "test/fuzz/fuzz.hpp"

namespace mrroc::fuzz {
namespace {

namespace fs = std::filesystem;

struct Input {
  std::string name;
  std::string bytes;
};

std::vector<Input> corpus() {
  std::vector<Input> inputs;
  for (const auto& entry : fs::directory_iterator(MRROC_FUZZ_CORPUS)) {
    std::ifstream file(entry.path(), std::ios::binary);
    inputs.push_back({entry.path().filename().string(), {std::istreambuf_iterator<char>(file), {}}});
  }
  std::ranges::sort(inputs, {}, &Input::name);
  return inputs;
}

void run(const std::string& bytes, const std::string& name) {
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  } catch (const std::exception& e) {
    ADD_FAILURE() << name << ": " << e.what() << "\n" << bytes.substr(0, 500);
  }
}

/// One thing that goes wrong with bytes.
std::string damaged(std::string bytes, const std::string& other, std::mt19937_64& random) {
  const std::size_t at = random() % (bytes.size() + 1);
  const std::size_t length = std::min<std::size_t>(random() % 40, bytes.size() - at);
  switch (random() % 6) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random());
      break;
    case 1:
      if (at < bytes.size())
        bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ 1U << random() % 8);
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 4:
      bytes.resize(at);
      break;
    default:
      bytes.insert(at, other.substr(random() % (other.size() + 1), 40));
  }
  return bytes;
}

TEST(MRROC_FUZZ_SUITE, KeepsItsContractForTheCorpus) {
  const std::vector<Input> inputs = corpus();
  ASSERT_GE(inputs.size(), 3U) << MRROC_FUZZ_CORPUS;
  run("", "nothing");
  for (const Input& input : inputs) run(input.bytes, input.name);
}

TEST(MRROC_FUZZ_SUITE, KeepsItsContractForDamagedFiles) {
  constexpr std::size_t kTrials = 2000;
  constexpr std::size_t kMostBytes = 20'000;  // larger ones are for the fuzzer
  std::mt19937_64 random(1);
  std::vector<Input> inputs = corpus();
  std::erase_if(inputs, [](const Input& input) { return input.bytes.size() > kMostBytes; });
  ASSERT_FALSE(inputs.empty());
  for (std::size_t k = 0; k < kTrials && !HasFailure(); ++k) {
    const Input& input = inputs[k % inputs.size()];
    std::string bytes = input.bytes;
    for (std::size_t n = 1 + random() % 4; n > 0; --n)
      bytes = damaged(bytes, inputs[random() % inputs.size()].bytes, random);
    run(bytes, input.name + ", damaged");
  }
}

}  // namespace
}  // namespace mrroc::fuzz
