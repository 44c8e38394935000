// Which process runs where, as a configuration says it.
#include "mp/hosts.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

std::vector<Part> parts() {
  return {{"world", "world", {}, {}}, {"edp-arm1", "edp", {}, {}}, {"ecp-arm1", "ecp", {}, {}}};
}

bool assigned(const std::string& toml, std::vector<Part>& all) {
  return assign_hosts(read_hosts(Config::parse(toml, "test.toml")), all);
}

std::string refusal(const std::string& toml) {
  auto all = parts();
  try {
    assigned(toml, all);
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    return e.what();
  }
  return "";
}

TEST(Hosts, EveryPartRunsHereUnlessAHostHasIt) {
  auto all = parts();
  EXPECT_FALSE(assigned("", all));
  for (const Part& p : all) EXPECT_TRUE(p.start.empty());
  EXPECT_TRUE(assigned("[hosts.far]\nprocesses = ['world', 'edp-arm1']\nstart = ['ssh', 'far']\n", all));
  const std::vector<std::string> start{"ssh", "far"};
  EXPECT_EQ(all[0].start, start);
  EXPECT_EQ(all[1].start, start);
  EXPECT_TRUE(all[2].start.empty());
}

TEST(Hosts, RefusesWhatCannotBeMeant) {
  EXPECT_NE(refusal("[hosts.far]\nprocesses = ['world']\n").find("words that make a program run there"),
            std::string::npos);
  const std::string unknown = refusal("[hosts.far]\nprocesses = ['wrld']\nstart = ['ssh', 'far']\n");
  EXPECT_NE(unknown.find("no process wrld; it has world, edp-arm1, ecp-arm1"), std::string::npos) << unknown;
  const std::string twice = refusal(
      "[hosts.a]\nprocesses = ['world']\nstart = ['ssh', 'a']\n[hosts.b]\nprocesses = ['world']\nstart = "
      "['ssh', 'b']\n");
  EXPECT_NE(twice.find("another host already"), std::string::npos) << twice;
}

}  // namespace
}  // namespace mrroc::mp
