#include "tasks/manual/config.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::manual {

/// A world in which orders come and drivers change their states.
inline void vary(Arm::X& x, std::mt19937& random) {
  contract::vary(x.e, random);
  if (contract::happens(0.3, random)) x.e.state = static_cast<DriverState>(random() % kDriverStates);
  if (contract::happens(0.05, random)) x.e.verdict = Verdict::refused;
  x.T.finished = x.T.finished || (x.i > 2000 && contract::happens(0.001, random));
  if (!contract::happens(0.008, random)) return;
  ManualOrder& o = x.T.manual;
  ++o.number;
  o.kind = static_cast<Kind>(random() % 11);
  o.space = random() % 2 == 0 ? Representation::joints : Representation::motors;
  o.reference = Reference::relative;
  o.value.fill(0.01);
}

}  // namespace mrroc::manual

namespace mrroc::contract {

struct Manual {
  using Agent = manual::Arm;
  static constexpr const char* kFolder = "tasks/manual";
  static auto behaviours() { return manual::kManual; }
  static Outcome run(Agent::X& x, auto& port) { return manual::run_program(x, port); }
  static void configure(const Config& config) { (void)manual::read_arms(config); }
  static auto seen(Agent::X& x) { return std::tie(x); }
  static bool same(const manual::Memory& a, const manual::Memory& b) {
    return a.doing == b.doing && a.done == b.done && a.fault.code == b.fault.code &&
           a.path.macrosteps() == b.path.macrosteps();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Manual, TaskContract, Manual);

}  // namespace mrroc::contract
