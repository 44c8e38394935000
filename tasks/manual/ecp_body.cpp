#include "ecp/solo.hpp"
#include "mrroc/manual_order_t.hpp"
#include "tasks/manual/config.hpp"

namespace mrroc::manual {
namespace {

/// The solo port, and the operator's orders.
class ManualPort {
 public:
  ManualPort(ecp::SoloPort<Arm>& arm, const link::Inbox<manual_order_t>& orders)
      : arm_(arm), orders_(orders) {}

  void dispatch(const Motion<Arm>& motion, const Arm::Y& y) { arm_.dispatch(motion, y); }
  Outcome wait() { return arm_.wait(); }
  void read(Arm::X& x) const {
    arm_.read(x);
    const std::int64_t i = arm_.links().i();
    const manual_order_t* const exact = orders_.at(i);
    if (const manual_order_t* const m = exact ? exact : orders_.newest()) x.T.manual = from_message(*m);
  }

 private:
  ecp::SoloPort<Arm>& arm_;
  const link::Inbox<manual_order_t>& orders_;
};

}  // namespace

void run_ecp(link::Process& process, const Config& config, const link::PartArguments& arguments,
             const Reach& reach) {
  const auto orders = process.inbox<manual_order_t>(arguments.arm + ".manual");
  const ecp::OtherLinks others{{orders.get()},
                               [&](std::int64_t i, std::int64_t) { return orders->at(i) != nullptr; }};
  Memory memory = read_memory(config, arguments.arm);
  memory.reach = &reach;
  ecp::run_ecp<Arm>(process, {.robot = arguments.arm, .sensor = {}, .others = others}, {.by_program = true},
                    [&](Arm::X& x, ecp::ArmPort<Arm>& arm) {
                      ecp::SoloPort<Arm> solo(arm.links());
                      ManualPort port(solo, *orders);
                      port.read(x);
                      x.c = memory;
                      return run_program(x, port);
                    });
}

}  // namespace mrroc::manual
