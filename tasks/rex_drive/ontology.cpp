#include "tasks/rex_drive/ontology.hpp"

#include "base/latency.hpp"

namespace mrroc::rex_drive {
namespace {

using X = Ontology::X;

const Report& locomotion(const X& x) { return x.T.agent[kLocomotionAgent]; }
bool acknowledged(const X& x) { return locomotion(x).event == x.c.plan.number; }

// --- memory ----------------------------------------------------------------------------------------------------

OntologyMemory retain(const X& x) { return x.c; }
OntologyMemory watch(const X& x) {
  OntologyMemory c = x.c;
  const bool lost = (locomotion(x).sensor & kPositionLost) != 0;
  if (!lost) c.lost_in = 0;
  if (lost && c.lost_in == 0) c.lost_in = x.i;
  const bool stands = (locomotion(x).sensor & kStands) != 0 && x.i - x.i_0 >= latency::kLoop;
  if (!stands) c.stands_in = 0;
  if (stands && c.stands_in == 0) c.stands_in = x.i;
  if (c.acked_in == 0 && acknowledged(x)) c.acked_in = x.i;
  return c;
}

// --- orders ----------------------------------------------------------------------------------------------------

template <int m>
std::array<PlanOrder, kAgents> order(const X& x) {
  PlanOrder o;
  o.m = m;
  o.variant = x.t.paused ? kPaused : 0;
  o.plan = x.c.plan;
  return {o, o};
}

// --- terminal conditions ---------------------------------------------------------------------------------------

bool may_start(const X& x) { return locomotion(x).ready && x.T.agent[kMapAgent].ready && x.T.h.started; }
bool taken(const X& x) {
  const bool executes = locomotion(x).m == 2 && x.i - x.i_0 >= latency::kLoop;
  return executes || acknowledged(x) || in_vain(x);
}
bool ack_came(const X& x) { return (x.c.acked_in > 0 && x.i - x.c.acked_in >= x.c.k.think) || in_vain(x); }
/// Long enough that everybody has told of it.
bool has_stood(const X& x) {
  constexpr std::int64_t kRest = 25;
  return (x.c.stands_in > 0 && x.i - x.c.stands_in >= kRest) || in_vain(x);
}

None nothing(const X&) { return {}; }

}  // namespace

// clang-format off
const Motion<Ontology> kStart     { 0, "wait for start",   retain, retain, nothing, nothing, order<0>, may_start, "both agents are ready and start was given"};
const Motion<Ontology> kSendPlan  { 1, "send a plan",      retain, watch,  nothing, nothing, order<1>, taken,     "the platform executes it"};
const Motion<Ontology> kAwaitAck  { 2, "plan is executed", retain, watch,  nothing, nothing, order<2>, ack_came,  "it is acknowledged"};
const Motion<Ontology> kComeToRest{ 3, "come to rest",     retain, watch,  nothing, nothing, order<3>, has_stood, "the platform stands"};
// clang-format on

bool in_vain(const X& x) {
  return x.c.k.timeout > 0 && x.c.lost_in > 0 && x.i - x.c.lost_in >= x.c.k.timeout;
}

int point_of(const Report& report) { return report.sensor % kPicturesStand / kPointUnit; }

}  // namespace mrroc::rex_drive
