// The file of a recorded motion.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "base/text_file.hpp"
#include "ecp/generators/teach_in.hpp"

namespace mrroc::ecp {
namespace {

constexpr std::string_view kTitle = "mrroc-trajectory 1";
constexpr std::size_t kMaxBytes = 500'000'000;
constexpr std::size_t kMaxPoses = 10'000'000;

template <class T>
using Words = std::vector<std::pair<std::string_view, T>>;

const Words<Representation> kSpaces{{"motors", Representation::motors},
                                    {"joints", Representation::joints},
                                    {"xyz_euler_zyz", Representation::xyz_euler_zyz},
                                    {"xyz_angle_axis", Representation::xyz_angle_axis}};
const Words<Reference> kReferences{{"absolute", Reference::absolute}, {"relative", Reference::relative}};
const Words<bool> kYesNo{{"no", false}, {"yes", true}};

/// @return what stands behind the key at the beginning of the next line
std::string_view field(Lines& lines, std::string_view key) {
  std::string_view line = lines.next();
  if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ' ')
    lines.fail(fmt::format("'{} ...' is expected here", key));
  line.remove_prefix(key.size() + 1);
  return line;
}

template <class T>
T word(Lines& lines, std::string_view key, const Words<T>& words) {
  const std::string_view text = field(lines, key);
  const auto found = std::ranges::find(words, text, &std::pair<std::string_view, T>::first);
  if (found == words.end()) {
    std::string known;
    for (const auto& [name, value] : words) known += fmt::format("{}{}", known.empty() ? "" : " or ", name);
    lines.fail(fmt::format("'{:.40}' is no {}", text, key), fmt::format("it must be {}", known));
  }
  return found->second;
}

template <class T>
std::string_view name_of(T value, const Words<T>& words) {
  return std::ranges::find(words, value, &std::pair<std::string_view, T>::second)->first;
}

TaughtPose read_pose(Lines& lines, std::size_t numbers, bool with_force) {
  std::array<double, 1 + kMaxAxes + 6> v{};
  const std::size_t used = 1 + numbers + (with_force ? 6 : 0);
  if (!lines.numbers(lines.next(), ' ', std::span(v).first(used)).empty())
    lines.fail(fmt::format("more than {} numbers", used));
  TaughtPose pose;
  pose.t = v[0];
  pose.pose = Eigen::Map<const Eigen::VectorXd>(&v[1], static_cast<Eigen::Index>(numbers));
  if (with_force) std::copy_n(&v[1 + numbers], 6, pose.F.v.begin());
  return pose;
}

}  // namespace

void save(const std::filesystem::path& file, const TaughtPath& taught) {
  const auto numbers = taught.poses.empty() ? Eigen::Index{0} : taught.poses.front().pose.size();
  std::string text = fmt::format("{}\nspace {}\nreference {}\nnumbers {}\nforce {}\nposes {}\n", kTitle,
                                 name_of(taught.space, kSpaces), name_of(taught.reference, kReferences),
                                 numbers, name_of(taught.with_force, kYesNo), taught.poses.size());
  for (const TaughtPose& p : taught.poses) {
    if (!p.pose.allFinite() || !std::isfinite(p.t) || !finite(p.F))
      throw FileError(file.string(), 0, "the recording has a number that is not finite", "");
    text += fmt::format("{:.17g}", p.t);
    for (const double q : p.pose) text += fmt::format(" {:.17g}", q);
    if (taught.with_force)
      for (const double f : p.F.v) text += fmt::format(" {:.17g}", f);
    text += '\n';
  }
  write_text_file(file, text + "end\n");
}

TaughtPath load_taught_path(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, kMaxBytes);
  Lines lines(text, file.string());
  if (lines.next() != kTitle)
    lines.fail("this is no recorded motion of this version", fmt::format("it must begin with '{}'", kTitle));
  TaughtPath taught;
  taught.space = word(lines, "space", kSpaces);
  taught.reference = word(lines, "reference", kReferences);
  const std::size_t numbers = lines.count(field(lines, "numbers"), kMaxAxes);
  const bool pose_in_space =
      taught.space == Representation::xyz_euler_zyz || taught.space == Representation::xyz_angle_axis;
  if (numbers == 0 || (pose_in_space && numbers != 6))
    lines.fail(fmt::format("a pose cannot have {} numbers here", numbers));
  taught.with_force = word(lines, "force", kYesNo);
  const std::size_t poses = lines.count(field(lines, "poses"), kMaxPoses);
  if (poses < 2) lines.fail("a motion needs two poses or more");
  for (std::size_t k = 0; k < poses; ++k) {
    taught.poses.push_back(read_pose(lines, numbers, taught.with_force));
    if (k > 0 && !(taught.poses[k].t > taught.poses[k - 1].t)) lines.fail("time does not rise");
  }
  if (lines.next() != "end") lines.fail("'end' is expected here", "there are more poses than it says");
  if (!lines.done()) {
    lines.next();
    lines.fail("there is text behind the end", "remove it");
  }
  return taught;
}

}  // namespace mrroc::ecp
