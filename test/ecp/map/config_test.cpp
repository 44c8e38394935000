#include "ecp/map/config.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "base/fault.hpp"

namespace mrroc::ecp {
namespace {

Config config_with(const std::vector<std::string>& settings) {
  Config c;
  for (const std::string& s : settings) c.set(s);
  return c;
}

TEST(MapConfig, MotionCaptureMeasuresAsOftenAsTheMapAgentHasPatienceFor) {
  try {
    std::ignore = read_map(config_with({"motion_capture.period=400"}));
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_NE(std::string(e.what()).find("map.timeout"), std::string::npos);
  }
  EXPECT_NO_THROW(std::ignore = read_map(config_with({"motion_capture.period=400", "map.timeout=0.8"})));
  EXPECT_THROW(std::ignore = read_map(config_with({"motion_capture.latency=151"})), ConfigError);
}

}  // namespace
}  // namespace mrroc::ecp
