// Assignment of processes to hosts by a configuration.
#include "mp/hosts.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

std::vector<NodeSpec> node_specs() {
  return {{"simulator", "simulator", {}, {}}, {"edp-arm1", "edp", {}, {}}, {"ecp-arm1", "ecp", {}, {}}};
}

using Words = std::vector<std::string>;

bool assigned(const std::string& toml, std::vector<NodeSpec>& all, const Words& given) {
  return assign_hosts(read_hosts(Config::parse(toml, "test.toml"), given), all);
}

/// @return code and text of what is wrong; no code when nothing is
std::pair<FaultCode, std::string> refusal(const std::string& toml, const Words& given) {
  auto all = node_specs();
  try {
    assigned(toml, all, given);
  } catch (const FaultError& e) {
    return {e.fault().code, e.what()};
  }
  return {FaultCode::none, ""};
}

TEST(Hosts, EveryNodeRunsHereUnlessAHostHasIt) {
  auto all = node_specs();
  EXPECT_FALSE(assigned("", all, {}));
  for (const NodeSpec& p : all) EXPECT_TRUE(p.start.empty());
  EXPECT_TRUE(assigned("[hosts.far]\nprocesses = ['simulator', 'edp-arm1']\n", all, {"far=ssh  -p 22 far"}));
  const Words start{"ssh", "-p", "22", "far"};
  EXPECT_EQ(all[0].start, start);
  EXPECT_EQ(all[1].start, start);
  EXPECT_TRUE(all[2].start.empty());
}

TEST(Hosts, WhatIsRunIsNotTakenFromAConfiguration) {
  const std::string toml = "[hosts.far]\nprocesses = ['simulator']\nstart = ['sh', '-c', 'anything']\n";
  for (const Words& given : {Words{}, Words{"far=ssh far"}}) {
    const auto [code, text] = refusal(toml, given);
    EXPECT_EQ(code, FaultCode::bad_configuration);
    EXPECT_NE(text.find("give --host \"far=WORDS\""), std::string::npos) << text;
    EXPECT_NE(text.find("test.toml:3"), std::string::npos) << text;
    EXPECT_NE(text.find("hosts.far.start"), std::string::npos) << text;
  }
  EXPECT_EQ(refusal("[hosts.far]\nstart = ['sh']\n", {}).first, FaultCode::bad_configuration)
      << "nor where nothing is to run";
}

TEST(Hosts, WhatIsRunIsSaidBefore) {
  const auto hosts = read_hosts(
      Config::parse("[hosts.far]\nprocesses = ['simulator', 'edp-arm1']\n", "test.toml"), {"far=ssh far"});
  ASSERT_EQ(hosts.size(), 1U);
  EXPECT_EQ(announcement(hosts[0]),
            "host far: simulator, edp-arm1 will be started with `ssh far PROGRAM ...`");
}

TEST(Hosts, RefusesWhatCannotBeMeant) {
  const std::string far = "[hosts.far]\nprocesses = ['simulator']\n";
  const auto [missing, what] = refusal(far, {});
  EXPECT_EQ(missing, FaultCode::bad_configuration);
  EXPECT_NE(what.find("how a program starts there"), std::string::npos) << what;
  for (const Words& given : {Words{"far"}, Words{"far="}, Words{"far= "}, Words{"=ssh"}, Words{""},
                             Words{"far=a", "far=b"}, Words{"far=a", "near=b"}})
    EXPECT_EQ(refusal(far, given).first, FaultCode::bad_usage) << given.back();
  const std::string unknown = refusal("[hosts.far]\nprocesses = ['wrld']\n", {"far=ssh far"}).second;
  EXPECT_NE(
      unknown.find("hosts.far.processes: the task has no process wrld; it has simulator, edp-arm1, ecp-arm1"),
      std::string::npos)
      << unknown;
  const std::string twice =
      refusal("[hosts.a]\nprocesses = ['simulator']\n[hosts.b]\nprocesses = ['simulator']\n", {"a=x", "b=y"})
          .second;
  EXPECT_NE(twice.find("hosts.b.processes: simulator has another host already"), std::string::npos) << twice;
}

}  // namespace
}  // namespace mrroc::mp
