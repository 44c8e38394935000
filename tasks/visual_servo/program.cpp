#include "tasks/visual_servo/program.hpp"

#include <algorithm>

#include "tasks/visual_servo/servo.hpp"

namespace mrroc::visual_servo {
namespace {

using X = Arm::X;
using Used = std::array<bool, kCameras>;

constexpr Used kNone{false, false}, kSac{true, false}, kEih{false, true}, kBoth{true, true};

// --- f_sigma -------------------------------------------------------------------------------------------------

bool neither(const X& x) { return !sees(x, Camera::sac) && !sees(x, Camera::eih); }  // (47)
bool only_sac(const X& x) { return sees(x, Camera::sac) && !sees(x, Camera::eih); }  // (45)
bool only_eih(const X& x) { return !sees(x, Camera::sac) && sees(x, Camera::eih); }
bool both(const X& x) { return sees(x, Camera::sac) && sees(x, Camera::eih); }

// --- f_tau ---------------------------------------------------------------------------------------------------

/// (46): a behaviour ends when its initial condition does not hold any more, or with the task.
template <bool (*f_sigma)(const X&)>
bool no_more(const X& x) {
  return !f_sigma(x) || done(x);
}
bool one_step(const X& x) { return ecp::age(x) >= 1; }  // (48)

// --- f_cc ----------------------------------------------------------------------------------------------------

template <const Used& uses>
Memory remember(const X& x) {
  const Conclusion concluded = conclude(x, uses);
  Memory c = x.c;
  c.track = concluded.track;
  c.taken = concluded.taken;
  c.e = concluded.e;
  c.before = c.under_way;
  c.under_way = concluded.T_dc;
  c.made_in = x.i;
  c.ease = concluded.ease;
  c.refused = concluded.refused;
  if (!neither(x)) c.seen_in = x.i;
  return c;
}

// --- f_ce ----------------------------------------------------------------------------------------------------

template <const Used& uses>
EffectorCommand servo(const X& x) {  // (49), (51), (53)
  return x.waiting > 0 ? ecp::idle() : ecp::displace(conclude(x, uses).T_dc, x.c.k.pacing);
}
EffectorCommand hold(const X&) { return ecp::idle(); }  // (55)

// --- f_cT ----------------------------------------------------------------------------------------------------

/// The sensor's state is the cameras that see: 1 sac, 2 eih, 3 both. What the driver could not do is told when it goes on.
Report tell(const X& x) {
  Report r = ecp::report_of(x, 0);
  r.sensor = (sees(x, Camera::sac) ? 1 : 0) + (sees(x, Camera::eih) ? 2 : 0);
  if (asked_too_much(x) && x.c.refused < kMostRefusals) {
    r.verdict = Verdict::none;
    r.fault = {};
  }
  return r;
}

Report not_seen(const X& x) {
  Report r = tell(x);
  r.verdict = Verdict::failed;
  r.fault.code = FaultCode::object_not_seen;
  r.fault.value = static_cast<double>(x.i - x.c.seen_in) * x.c.k.pacing.macrostep_s();
  r.fault.limit = static_cast<double>(x.c.k.patience) * x.c.k.pacing.macrostep_s();
  r.fault.text = "seconds";
  return r;
}
bool never(const X&) { return false; }

constexpr auto kRetain = ecp::retain<Arm>;
constexpr auto kNoSensor = ecp::no_sensor<Arm>;
constexpr std::string_view kSelected = "the initial condition of another behaviour holds";

}  // namespace

// clang-format off
const std::array<Selectable, 4> kBehaviours{{
  // f_sigma    m      name              entry   memory           command       receptors  coordinator  f_tau
  { neither,  { kIdle, "idle",           kRetain, remember<kNone>, hold,         kNoSensor, tell,        one_step, kSelected } },
  { only_sac, { 1,     "PB-SAC",         kRetain, remember<kSac>,  servo<kSac>,  kNoSensor, tell,        no_more<only_sac>, kSelected } },
  { only_eih, { 2,     "PB-EIH",         kRetain, remember<kEih>,  servo<kEih>,  kNoSensor, tell,        no_more<only_eih>, kSelected } },
  { both,     { 3,     "PB-SAC and EIH", kRetain, remember<kBoth>, servo<kBoth>, kNoSensor, tell,        no_more<both>, kSelected } },
}};
const Motion<Arm> kGiveUp{ 5, "give up", kRetain, kRetain, hold, kNoSensor, not_seen, never };
// clang-format on

const Motion<Arm>& select(const X& x) {
  return std::ranges::find_if(kBehaviours, [&](const Selectable& row) { return row.f_sigma(x); })->motion;
}

bool done(const X& x) { return x.i - x.c.begun >= x.c.k.duration; }

bool in_vain(const X& x) { return x.c.k.patience > 0 && neither(x) && x.i - x.c.seen_in >= x.c.k.patience; }

Memory begin(const Parameters& k, std::int64_t i) {
  Memory c;
  c.k = k;
  c.begun = c.seen_in = c.made_in = i;
  return c;
}

}  // namespace mrroc::visual_servo
