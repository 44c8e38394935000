#include "tasks/move/motion_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/counted.hpp"
#include "base/joined.hpp"
#include "base/representation.hpp"
#include "tasks/move/plan.hpp"

namespace mrroc::any_motion {
namespace {

constexpr Bounds kShare{.min = 1e-4, .max = 1};
constexpr Bounds kTime{.min = 0, .max = 3600};
constexpr Bounds kPositions{.min = -1e5, .max = 1e5};
constexpr std::size_t kMostMotions = 900;  // of one arm: below kWorkDone

bool is_spline(Generator g) {
  return g == Generator::linear || g == Generator::cubic || g == Generator::quintic;
}
bool takes_lists(Generator g) { return g == Generator::trapezoid || g == Generator::polyline; }

/// Reads one motion.
class MotionReader {
 public:
  MotionReader(const Config& config, const std::string& name, std::optional<int> axes)
      : config_(config), axes_(axes) {
    m_.name = name;
  }

  MotionSpec read() {
    m_.generator = config_.choice("generator", Generator::trapezoid,
                                  {{"trapezoid", Generator::trapezoid},
                                   {"polyline", Generator::polyline},
                                   {"linear", Generator::linear},
                                   {"cubic", Generator::cubic},
                                   {"quintic", Generator::quintic},
                                   {"nurbs", Generator::nurbs},
                                   {"straight", Generator::straight},
                                   {"constant", Generator::constant},
                                   {"hold", Generator::hold},
                                   {"replay", Generator::replay}});
    if (m_.generator == Generator::hold) {
      m_.duration = config_.number("time", Config::kRequired, {0.02, kTime.max}, "s");
      return m_;
    }
    read_space();
    read_positions();
    read_timing();
    if (m_.generator == Generator::nurbs) read_nurbs();
    if (m_.generator == Generator::straight) read_path();
    if (m_.generator == Generator::replay) {
      read_forces();
      note_recording();
    }
    return m_;
  }

 private:
  void read_space() {
    const auto in_space = [](Representation r) { return !per_axis(r); };
    const bool straight = m_.generator == Generator::straight;
    m_.space = config_.choice("space", straight ? Representation::xyz_angle_axis : Representation::joints,
                              {{"motors", Representation::motors},
                               {"joints", Representation::joints},
                               {"frame", Representation::frame},
                               {"xyz_euler_zyz", Representation::xyz_euler_zyz},
                               {"xyz_angle_axis", Representation::xyz_angle_axis}});
    if (straight && !in_space(m_.space)) refuse_word("space", "straight lines are those of a pose in space");
    m_.reference = config_.choice("reference", Reference::absolute,
                                  {{"absolute", Reference::absolute}, {"relative", Reference::relative}});
    m_.mu = config_.choice("interpolation", Interpolation::mim,
                           {{"mim", Interpolation::mim}, {"tcim", Interpolation::tcim_pose}});
    if (m_.mu == Interpolation::tcim_pose && !in_space(m_.space))
      refuse_word("interpolation", "TCIM takes poses in space: frame, xyz_euler_zyz or xyz_angle_axis");
  }
  /// @throws ConfigError  at the place of a word
  void refuse_word(std::string_view key, const std::string& text) const {
    throw wrong_value(config_, key, "cannot be: " + text);
  }

  void read_positions() {
    const std::vector<double> numbers = config_.list("positions", std::nullopt, kPositions, "rad, m");
    if (!axes_ && per_axis(m_.space)) return;
    const auto each = static_cast<std::size_t>(numbers_used(m_.space, axes_.value_or(0)));
    if (numbers.size() % each != 0)
      throw wrong_value(config_, "positions",
                        fmt::format("has {} numbers, and a position has {}: position {} is cut off",
                                    numbers.size(), each, numbers.size() / each + 1));
    if (numbers.empty()) throw wrong_value(config_, "positions", "has no position");
    if (numbers.size() / each > kMostPositions)
      throw wrong_value(config_, "positions", fmt::format("has more than {} positions", kMostPositions));
    for (std::size_t k = 0; k < numbers.size(); k += each)
      m_.positions.push_back(position(&numbers[k], each));
    if (m_.generator == Generator::constant && m_.positions.size() != 1)
      throw wrong_value(config_, "positions", "must be one position: the motion has one velocity");
  }

  [[nodiscard]] ecp::Coordinates position(const double* numbers, std::size_t count) const {
    if (m_.planned() == m_.space)
      return Eigen::Map<const Eigen::VectorXd>(numbers, static_cast<Eigen::Index>(count));
    PoseNumbers given{};
    std::copy_n(numbers, count, given.begin());
    const auto T = pose_from_numbers(m_.space, given);
    if (!T)
      throw wrong_value(config_, "positions",
                        fmt::format("has a position {} that is no homogeneous matrix with a rotation",
                                    m_.positions.size() + 1));
    return angle_axis_from_pose(*T);
  }

  /// Lists with one entry per position, or none of some.
  [[nodiscard]] bool one_each(std::size_t size) const {
    return m_.positions.empty() || size == m_.positions.size();
  }

  [[nodiscard]] std::vector<double> shares(std::string_view key, double fallback) const {
    std::vector<double> list = config_.list(key, std::vector<double>{fallback}, kShare, "of the limit");
    const bool several = takes_lists(m_.generator) && one_each(list.size());
    if (list.size() != 1 && !(several && !list.empty()))
      throw wrong_value(
          config_, key,
          takes_lists(m_.generator)
              ? fmt::format("must have one number, or one for each of {} positions", m_.positions.size())
              : "must have one number");
    return list;
  }

  void read_times(bool required) {
    m_.times =
        config_.list("times", required ? std::nullopt : std::optional(std::vector<double>{}), kTime, "s");
    if (m_.times.empty() && !required) return;
    if (!one_each(m_.times.size()) || m_.times.empty())
      throw wrong_value(
          config_, "times",
          fmt::format("has {} for {}, and each position has one", counted(m_.times.size(), "time"),
                      counted(m_.positions.size(), "position")));
    const bool from_zero = m_.generator == Generator::replay;  // its first position is where it begins
    for (std::size_t k = 0; k < m_.times.size(); ++k)
      if (!(m_.times[k] > (k > 0 ? m_.times[k - 1] : from_zero ? -1 : 0)))
        throw wrong_value(config_, "times", fmt::format("has a time {} that does not rise", k + 1));
  }

  void read_timing() {
    if (m_.generator == Generator::replay) return read_times(true);
    if (m_.generator == Generator::straight && !config_.has("times")) return;
    if (is_spline(m_.generator)) {
      read_times(false);
    } else if (config_.has("times")) {
      throw wrong_value(
          config_, "times",
          fmt::format("is for the generators linear, cubic, quintic and replay, and this one is {}",
                      to_string(m_.generator)));
    }
    if (m_.generator == Generator::nurbs)
      m_.duration = config_.number("time", 0, kTime, "s, 0: as fast as the shares permit");
    // The original's.
    m_.velocity = shares("velocity", m_.generator == Generator::constant ? 0.05 : 0.15);
    if (m_.generator != Generator::constant) m_.acceleration = shares("acceleration", 0.02);
    if (takes_lists(m_.generator)) m_.pass = config_.flag("pass", false);
  }

  void read_nurbs() {
    m_.degree = config_.integer("degree", 3, {1, 5});
    m_.weights =
        config_.list("weights", std::vector<double>{}, {1e-3, 1e3}, "one per position and one before");
    m_.knots = config_.list("knots", std::vector<double>{}, {-1e4, 1e4});
  }

  void read_path() {
    m_.path.velocity = config_.number("speed", m_.path.velocity, {1e-4, 0.5}, "m/s");
    m_.path.acceleration = config_.number("ramp", m_.path.acceleration, {1e-3, 5}, "m/s^2");
    m_.path.corner = config_.number("corner", m_.path.corner, {0, 1}, "m, 0: stops at each position");
    m_.path.lever = config_.number("lever", m_.path.lever, {0.01, 10}, "m per rad");
  }

  void read_forces() {
    const auto numbers = config_.list("forces", std::vector<double>{}, {-130, 130}, "N, N m in E");
    for (std::size_t k = 0; k + 6 <= numbers.size(); k += 6) {
      Wrench F;
      std::copy_n(&numbers[k], 6, F.v.begin());
      m_.forces.push_back(F);
    }
    if (numbers.size() % 6 != 0 || (!m_.forces.empty() && !one_each(m_.forces.size())))
      throw wrong_value(config_, "forces",
                        fmt::format("has {} numbers, and must have six for each of {} positions",
                                    numbers.size(), m_.positions.size()));
    if (m_.forces.empty()) return;
    if (m_.mu != Interpolation::tcim_pose)
      throw wrong_value(config_, "forces", "needs interpolation = \"tcim\"");
    static const std::map<std::string, Axis> names{{"x", Axis::x},   {"y", Axis::y},   {"z", Axis::z},
                                                   {"ax", Axis::ax}, {"ay", Axis::ay}, {"az", Axis::az}};
    for (const std::string& word : config_.texts("contact", std::vector<std::string>{})) {
      const auto found = names.find(word);
      if (found == names.end())
        throw wrong_value(config_, "contact",
                          fmt::format("has '{:.20}', and axes are x, y, z, ax, ay, az", word));
      m_.contact.push_back(found->second);
    }
  }

  /// What a recording holds has been put into the other keys: here stands where it comes from.
  void note_recording() const {
    if (!config_.has("recording")) return;
    std::ignore = config_.text("recording", std::nullopt);
    for (const char* key : {"from", "to", "stretch"})
      if (config_.has(key)) std::ignore = config_.number(key, std::nullopt);
  }

  const Config& config_;
  std::optional<int> axes_;
  MotionSpec m_;
};

ArmMotions read_arm(const Config& config, const ArmKey& arm) {
  ArmMotions motions{.arm = arm.key, .start = {}, .motions = {}};
  const auto start = config.list("start", std::vector<double>{}, {-10, 10}, "rad, track m");
  if (!start.empty() && arm.axes && start.size() != static_cast<std::size_t>(*arm.axes))
    throw wrong_value(config, "start",
                      fmt::format("has {} numbers, and {} has {} joints", start.size(), arm.key, *arm.axes));
  if (start.size() > kMaxAxes) throw wrong_value(config, "start", "has more joints than an arm");
  if (!start.empty())
    motions.start = Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  const auto order = config.texts("order", std::vector<std::string>{});
  if (order.size() > kMostMotions)
    throw wrong_value(config, "order", fmt::format("has more than {} motions", kMostMotions));
  const std::vector<std::string> known = config.tables("");
  std::map<std::string, MotionSpec> specs;
  for (const std::string& name : order) {
    if (std::ranges::find(known, name) == known.end())
      throw wrong_value(config, "order",
                        fmt::format("has '{:.40}', and there is no table [{}.{:.40}]{}", name, arm.key, name,
                                    known.empty() ? "" : "; there are " + joined(known, ", ")));
    if (!specs.contains(name))
      specs.emplace(name, MotionReader(config.section(name), arm.key + "." + name, arm.axes).read());
    motions.motions.push_back(specs.at(name));
  }
  for (const std::string& name : known)  // what is not executed now is read, too: its errors are errors
    if (!specs.contains(name))
      std::ignore = MotionReader(config.section(name), arm.key + "." + name, arm.axes).read();
  return motions;
}

}  // namespace

ConfigError wrong_value(const Config& config, std::string_view key, const std::string& text) {
  try {
    std::ignore = config.list(key, std::nullopt, {}, "", SIZE_MAX);  // no list has so many: tells the place
  } catch (const ConfigError& e) {
    return {e.place(), e.key(), fmt::format("'{}' {}", e.key(), text)};
  }
  return {{}, std::string(key), text};
}

MotionFile read_motions(const Config& config, const std::vector<ArmKey>& arms) {
  MotionFile file;
  file.together = config.flag("together", false);
  for (const ArmKey& arm : arms) file.arms.push_back(read_arm(config.section(arm.key), arm));
  return file;
}

}  // namespace mrroc::any_motion
