#include "tasks/visual_servo/program.hpp"

#include <algorithm>
#include <optional>

#include "tasks/visual_servo/servo.hpp"

namespace mrroc::visual_servo {
namespace {

using X = Arm::X;
using Used = std::array<bool, kCameras>;

constexpr Used kNone{false, false}, kSac{true, false}, kEih{false, true}, kBoth{true, true};

// --- f_sigma -------------------------------------------------------------------------------------------------

bool neither(const X& x) { return !sees(x, Camera::sac) && !sees(x, Camera::eih); }  // (47)
bool nothing(const X& x) { return neither(x) && !remembers(x); }
bool just_before(const X& x) { return neither(x) && remembers(x); }
bool only_sac(const X& x) { return sees(x, Camera::sac) && !sees(x, Camera::eih); }  // (45)
bool only_eih(const X& x) { return !sees(x, Camera::sac) && sees(x, Camera::eih); }
bool both(const X& x) { return sees(x, Camera::sac) && sees(x, Camera::eih); }

// --- f_tau ---------------------------------------------------------------------------------------------------

/// (46): a behaviour ends when its initial condition does not hold any more, or with the task.
template <bool (*f_sigma)(const X&)>
bool no_more(const X& x) {
  return !f_sigma(x) || done(x) || in_vain(x);
}
bool one_step(const X& x) { return ecp::age(x) >= 1; }  // (48)

/// @return the reason why nothing can be seen, if it is not the object but the host: every camera's newest picture is too old
std::optional<Fault> late_pictures(const X& x) {
  std::optional<Fault> fault;
  for (const Camera camera : {Camera::sac, Camera::eih}) {
    if (!x.c.k.camera[index(camera)].used) continue;
    const std::int64_t age = age_of_picture(x, camera), limit = oldest_believed(x.c.k, camera);
    if (age <= limit) return {};
    fault = Fault{.code = FaultCode::host_too_slow,
                  .value = static_cast<double>(age) * x.c.k.pacing.dt,
                  .limit = static_cast<double>(limit) * x.c.k.pacing.dt,
                  .text = "seconds that a camera's newest picture is old"};
  }
  return fault;
}

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
  if (!late_pictures(x)) c.in_time_in = x.i;
  return c;
}

// --- f_ce ----------------------------------------------------------------------------------------------------

template <const Used& uses>
EffectorCommand servo(const X& x) {  // (49), (51), (53)
  return x.waiting > 0 ? ecp::idle() : ecp::displace(conclude(x, uses).T_dc, x.c.k.pacing);
}
EffectorCommand hold(const X&) { return ecp::idle(); }  // (55)

// --- f_cT ----------------------------------------------------------------------------------------------------

/// The sensor's state is the cameras that see: 1 sac, 2 eih, 3 both.
Report tell(const X& x) {
  Report r = ecp::report_of(x, 0);
  r.sensor = (sees(x, Camera::sac) ? 1 : 0) + (sees(x, Camera::eih) ? 2 : 0);
  return r;
}

/// Why the task is given up.
Report reason(const X& x) {
  Report r = tell(x);
  r.verdict = Verdict::failed;
  if (x.c.refused >= kMostRefusals) {
    if (!r.fault) r.fault.code = FaultCode::command_repeated_refused;
    return r;
  }
  const std::optional<Fault> late = late_pictures(x);
  // In the beginning there is no picture yet that could be late.
  const bool mostly = 2 * (x.i - x.c.in_time_in) >= x.c.k.timeout;
  if (x.c.k.by_wall_clock && late && mostly) {
    r.fault = *late;
    return r;
  }
  r.fault.code = FaultCode::object_not_seen;
  r.fault.value = static_cast<double>(x.i - x.c.seen_in) * x.c.k.pacing.macrostep_s();
  r.fault.limit = static_cast<double>(x.c.k.timeout) * x.c.k.pacing.macrostep_s();
  r.fault.text = "seconds";
  return r;
}
bool never(const X&) { return false; }

constexpr auto kRetain = ecp::retain<Arm>;
constexpr auto kNoSensor = ecp::no_sensor<Arm>;
constexpr FaultPolicy kSlower = respond(Response::go_on);
constexpr std::string_view kSelected = "the initial condition of another behaviour holds";

}  // namespace

// clang-format off
const std::array<Selectable, 5> kBehaviours{{
  // f_sigma    m      name              entry   memory           command       receptors  coordinator  f_tau                        what a command that is not executed leads to
  { nothing,  { kIdle, "idle",           kRetain, remember<kNone>, hold,         kNoSensor, tell,        one_step, kSelected, kSlower } },
  { only_sac, { 1,     "PB-SAC",         kRetain, remember<kSac>,  servo<kSac>,  kNoSensor, tell,        no_more<only_sac>, kSelected, kSlower } },
  { only_eih, { 2,     "PB-EIH",         kRetain, remember<kEih>,  servo<kEih>,  kNoSensor, tell,        no_more<only_eih>, kSelected, kSlower } },
  { both,     { 3,     "PB-SAC and EIH", kRetain, remember<kBoth>, servo<kBoth>, kNoSensor, tell,        no_more<both>, kSelected, kSlower } },
  { just_before, { kFromMemory, "PB from memory", kRetain, remember<kNone>, servo<kNone>, kNoSensor, tell, no_more<just_before>, kSelected, kSlower } },
}};
const Motion<Arm> kGiveUp{ 5, "give up", kRetain, kRetain, hold, kNoSensor, reason, never };
// clang-format on

const Motion<Arm>& select(const X& x) {
  return std::ranges::find_if(kBehaviours, [&](const Selectable& row) { return row.f_sigma(x); })->motion;
}

bool done(const X& x) { return x.i - x.c.begun >= x.c.k.duration; }

bool in_vain(const X& x) {
  if (not_made(x) && x.c.refused >= kMostRefusals) return true;
  return x.c.k.timeout > 0 && neither(x) && x.i - x.c.seen_in >= x.c.k.timeout;
}

Memory begin(const Parameters& k, std::int64_t i) {
  Memory c;
  c.k = k;
  c.begun = c.seen_in = c.in_time_in = c.made_in = i;
  return c;
}

}  // namespace mrroc::visual_servo
