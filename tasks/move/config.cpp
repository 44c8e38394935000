#include "tasks/move/config.hpp"

#include "ecp/solo.hpp"

namespace mrroc::any_motion {

std::vector<std::string> arms_of(const Config& config) {
  return config.texts("robots.order", Config::kRequired);
}

Plan read_plan(const Config& config, const MakeBody& make_body) {
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<const Body*> all;
  std::vector<ArmKey> keys;
  for (const std::string& arm : arms_of(config)) {
    bodies.push_back(make_body(config, arm));
    all.push_back(bodies.back().get());
    keys.push_back({arm, all.back()->axes()});
  }
  return make_plan(read_motions(config.section("task"), keys), all);
}

std::vector<std::string> settings_of(const Config& file, const std::vector<std::string>& arms) {
  std::vector<ArmKey> keys;
  for (const std::string& arm : arms) keys.push_back({arm, std::nullopt});
  std::ignore = read_motions(file, keys);
  file.check_all_used();
  std::vector<std::string> settings;
  for (const ConfigParameter& p : file.parameters()) settings.push_back("task." + p.key + "=" + p.value);
  return settings;
}

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments,
             const MakeBody& make_body) {
  const Plan plan = read_plan(config, make_body);
  Memory memory{.plan = {},
                .body = make_body(config, arguments.arm),
                .together = plan.together,
                .motion = 0,
                .path = {}};
  for (const ArmPlan& arm : plan.arms)
    if (arm.arm == arguments.arm) memory.plan = std::make_shared<const ArmPlan>(arm);
  ecp::run_solo_ecp<Arm>(process, config, arguments, [&](Arm::X& x, auto& port) {
    x.c = memory;
    return run_program(x, port);
  });
}

}  // namespace mrroc::any_motion
