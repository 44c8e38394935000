#include "tasks/ball/ball_run.hpp"

#include <fmt/core.h>

#include "tasks/ball/grip.hpp"
#include "tasks/ball/law.hpp"
#include "tasks/ball/path.hpp"
#include "tasks/ball/vocabulary.hpp"

namespace mrroc::ball {
namespace {

Fault made(FaultCode code, const std::string& text) {
  Fault fault{.code = code};
  fault.text = text;
  return fault;
}

}  // namespace

Fault fault_of(const Coordinator::X& x) {
  const Parameters& k = x.c.k;
  const PairState s = pair_state(k, x.T.agent);
  switch (x.c.failure) {
    case Failure::no_contact:
      return made(kObjectNotAsTold,
                  fmt::format("the palms are {:.0f} mm apart and do not both touch the object of {:.0f} mm",
                              1e3 * s.distance, 1e3 * k.body.size));
    case Failure::not_as_told:
      return made(kObjectNotAsTold, fmt::format("the palms closed at {:.0f} mm, free_body.size is {:.0f} mm",
                                                1e3 * x.c.closed, 1e3 * k.body.size));
    case Failure::too_heavy:
      return made(kObjectTooHeavy,
                  fmt::format("the palms bear {:.1f} N, with {:g} N they may bear {:.1f} N", x.c.load,
                              k.force, most_load(k.force, k.body.friction, k.margin)));
    case Failure::stayed:
      return made(kObjectLost,
                  fmt::format("the palms bear {:.1f} N of the {:.1f} N of the object: it has stayed",
                              x.c.load, kGravity * k.body.mass));
    case Failure::lost:
      return made(kObjectLost, fmt::format("the palms feel {:.1f} N and {:.1f} N, and are {:.0f} mm apart",
                                           s.press[0], s.press[1], 1e3 * s.distance));
    case Failure::crushed:
      return made(kObjectCrushed, fmt::format("the palms feel {:.1f} N and {:.1f} N, the object bears {:g} N",
                                              s.press[0], s.press[1], k.most_force));
    case Failure::none:
      break;
  }
  return {};
}

BallRun::BallRun(mp::TaskRun& run, const mp::CoordinatedParameters& links, const Parameters& parameters)
    : k_(parameters), links_(run, links), record_(run.process()) {}

Outcome BallRun::execute() {
  const auto observer = [this](const Motion<Coordinator>& motion, const Coordinator::X& x) {
    links_.observe(motion.m, motion.name, motion.until, x.T.agent);
    record_.collect(x.i, motion.m, path(k_, motion.m, x.c.age), x.c.yielded);
  };
  mp::CoordinatorPort<Coordinator, decltype(observer)> port(links_.links(), observer);
  Coordinator::X x;
  x.c.k = k_;
  if (const Outcome o = links_.begin(); o != Outcome::terminated) return o;
  port.read(x);
  const Outcome o = run_program(x, port);
  if (o == Outcome::terminated) links_.finish();
  if (o == Outcome::faulted) {
    fault_ = links_.links().fault();
    if (!fault_) fault_ = fault_of(x);
  }
  return o;
}

}  // namespace mrroc::ball
