// The ontology agent a_2, which is this task's coordinator: sends plans one after another, and waits for their ack.
#pragma once
#include <cstdint>
#include <vector>

#include "base/agent_images.hpp"
#include "base/motion.hpp"
#include "base/platform_transmission.hpp"
#include "tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {

/// Agents that a_2 speaks with: a_1, then a_3.
inline constexpr std::size_t kAgents = 2;
inline constexpr std::size_t kLocomotionAgent = 0;  ///< index of a_1
inline constexpr std::size_t kMapAgent = 1;         ///< index of a_3

/// Constant parameters of a_2.
struct OntologyParameters {
  std::int64_t think{10};      ///< after an ack until the next plan is sent [macrosteps]
  std::int64_t timeout{1500};  ///< for a platform that does not know its position [macrosteps]; 0: for ever
};

/// c_c2
struct OntologyMemory {
  OntologyParameters k;     ///< constant during a run
  Plan plan;                ///< that is sent; its number is 0 before the first one
  std::int64_t acked_in{};  ///< macrostep in which its ack came; 0: not yet
  std::int64_t
      lost_in{};  ///< macrostep from which on the platform has waited for its position; 0: it does not
  std::int64_t stands_in{};  ///< macrostep from which on the platform has stood; 0: it does not
};

/// Order with the plan that goes to a_1 on a link of its own.
struct PlanOrder : Order {
  Plan plan;  ///< T_y_c2,1[desired_plan]
};

/// Images of a_2.
struct Ontology : CoordinatorAgent<OntologyMemory, kAgents, None, None, Report, PlanOrder> {};

/// Behaviours of a_2. m of an order is that of its behaviour; Order::variant is kPaused while the operator has a pause.
extern const Motion<Ontology>
    kStart;  ///< m = 0: until both agents are ready and the operator has given start
extern const Motion<Ontology> kSendPlan;    ///< m = 1: until a_1 executes c.plan, or has acknowledged it
extern const Motion<Ontology> kAwaitAck;    ///< m = 2: until its ack and c.k.think macrosteps more
extern const Motion<Ontology> kComeToRest;  ///< m = 3: until the platform has stood for half a second

/// The platform has waited for its position for too long.
[[nodiscard]] bool in_vain(const Ontology::X& x);

/// @return the number of the plan's point that the platform is on its way to, from 1; 0: it is on the way to none
[[nodiscard]] int point_of(const Report& report);

/// Executes plans to their end. Stops before when in_vain().
template <class Port>
Outcome execute_plans(const std::vector<Plan>& plans, Ontology::X& x, Port& port) {
  Outcome o = move(kStart, x, port);
  const auto well = [&] { return o == Outcome::terminated && !in_vain(x); };
  for (std::size_t k = 0; well() && k < plans.size(); ++k) {
    x.c.plan = plans[k];
    x.c.acked_in = 0;
    o = move(kSendPlan, x, port);
    if (well()) o = move(kAwaitAck, x, port);
  }
  return well() ? move(kComeToRest, x, port) : o;
}

}  // namespace mrroc::rex_drive
