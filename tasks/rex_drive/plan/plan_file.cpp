#include "tasks/rex_drive/plan/plan_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/fault.hpp"
#include "base/text_file.hpp"
#include "tasks/rex_drive/plan/proc.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr std::size_t kMaxFileBytes = 2'000'000;
constexpr double kFarthest = 1000;  // [m]
constexpr const char* kFormat = "a line has two numbers, x and y in metres";

[[noreturn]] void refuse(const std::string& name, int line, const std::string& wrong,
                         const std::string& remedy) {
  const FileError e(name, line, wrong, remedy);
  throw FaultError(FaultCode::bad_plan, e.wrong(), e.remedy());
}

double distance(const MapPoint& a, const MapPoint& b) { return std::hypot(b.x - a.x, b.y - a.y); }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Takes the first word of a text.
std::string_view next_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  text.remove_prefix(word.size());
  return word;
}

/// What std::from_chars() reads of a number with a sign.
std::string_view without_plus(std::string_view number) {
  const bool plus = number.starts_with('+') && !number.starts_with("+-");
  return plus ? number.substr(1) : number;
}

/// Reads the lines of a plan file one after another.
class Reader {
 public:
  explicit Reader(const std::string& name) { list_.name = name; }

  void take(std::string_view line) {
    ++line_;
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) return;
    std::string_view rest = line;
    const std::string_view word = next_word(rest);
    if (word == "start") {
      take_start(rest);
    } else if (word == "plan") {
      if (!trimmed(rest).empty()) fail("nothing stands behind 'plan'", "begin a new line behind it");
      end_plan();
    } else {
      take_point(line);
    }
    begun_ = true;
  }

  PlanList end() {
    end_plan();
    if (list_.plans.empty()) fail("there is no point in it", kFormat);
    return std::move(list_);
  }

 private:
  [[noreturn]] void fail(const std::string& wrong, const std::string& remedy) const {
    refuse(list_.name, line_, wrong, remedy);
  }

  template <std::size_t N>
  std::array<double, N> numbers(std::string_view text, const std::string& remedy) const {
    std::array<double, N> values{};
    for (double& value : values) {
      const std::string_view word = next_word(text);
      const std::string_view digits = without_plus(word);
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
      if (word.empty() || end != word.data() + word.size() || error == std::errc::invalid_argument)
        fail(word.empty() ? "a number is missing" : fmt::format("'{:.40}' is not a number", word), remedy);
      if (error == std::errc() && std::isnan(value)) fail("a number is not finite", remedy);
      if (error != std::errc() || !std::isfinite(value) || std::abs(value) > kFarthest)
        fail(fmt::format("{:.40} is beyond {} m", word, kFarthest), "give metres on the map");
    }
    if (!trimmed(text).empty()) fail(fmt::format("'{:.40}' is too much", trimmed(text)), remedy);
    return values;
  }

  void take_start(std::string_view rest) {
    if (begun_) fail("'start' is not the first line", "put it before the first point");
    const auto [x, y, phi] = numbers<3>(rest, "'start' has three numbers, x and y in metres and phi in rad");
    constexpr double kTurn = 2 * std::numbers::pi;
    if (std::abs(phi) > kTurn)
      fail(fmt::format("phi {} is more than a turn", phi), "give it in rad, not in degrees");
    list_.start = {x, y, wrap_angle(phi)};
    list_.start_line = line_;
  }

  void take_point(std::string_view line) {
    const auto [x, y] = numbers<2>(line, kFormat);
    if (++count_ > kMostPoints)
      fail(fmt::format("there are over {} points", kMostPoints),
           "leave some out: 0.3 m between them will do");
    points_.push_back({x, y, line_});
  }

  void end_plan() {
    if (points_.empty()) {
      if (begun_) fail("a plan has no points", "give two at least, or leave its line 'plan' out");
      return;
    }
    if (points_.size() == 1) refuse_single();
    const std::size_t n = points_.size(), parts = (n + kPointsOfPlan - 1) / kPointsOfPlan;
    for (std::size_t part = 0; part < parts; ++part) {
      const auto at = [&](std::size_t k) {
        return points_.begin() + static_cast<std::ptrdiff_t>(n * k / parts);
      };
      add_plan({at(part), at(part + 1)});
    }
    points_.clear();
  }

  /// A way has a beginning and an end.
  [[noreturn]] void refuse_single() const {
    const bool first = list_.plans.empty();
    const double x = first ? list_.start.x : list_.plans.back().back().x;
    const double y = first ? list_.start.y : list_.plans.back().back().y;
    fail("a plan has one point only, and a way has two at least",
         fmt::format("write '{:g} {:g}', where {}, on the line before it", x, y,
                     first ? "the platform stands" : "the plan before ends"));
  }

  void add_plan(MapPoints points) {
    const auto elsewhere = [&](const MapPoint& p) { return distance(points.front(), p) >= kSamePoint; };
    if (std::ranges::none_of(points, elsewhere))
      fail(fmt::format("the points of a plan are all within {} m", kSamePoint), "give points to drive to");
    list_.plans.push_back(std::move(points));
  }

  PlanList list_;
  MapPoints points_;  // of the plan that is being read
  std::size_t count_{};
  int line_{};
  bool begun_{};  // a line with content has been read
};

/// @return direction of the last leg that is long enough to have one; none: there is no such leg
std::optional<double> last_direction(const MapPoints& points) {
  for (std::size_t k = points.size(); k-- > 1;)
    if (distance(points[k - 1], points.back()) >= kSamePoint)
      return std::atan2(points.back().y - points[k - 1].y, points.back().x - points[k - 1].x);
  return {};
}

std::optional<double> first_direction(const MapPoint& from, const MapPoints& points) {
  for (const MapPoint& p : points)
    if (distance(from, p) >= kSamePoint) return std::atan2(p.y - from.y, p.x - from.x);
  return {};
}

/// @return whether the way from one plan into the next one can be driven without a stop
bool flows(const MapPoints& plan, const MapPoints& next) {
  const std::optional<double> before = last_direction(plan), after = first_direction(plan.back(), next);
  return before && after && std::abs(wrap_angle(*after - *before)) < kPivotAngle;
}

/// Tells a plan how the next one begins.
void look_ahead(const MapPoints& next, Plan& plan) {
  plan.ahead = static_cast<std::int32_t>(std::min(kPlanAhead, next.size()));
  for (std::int32_t k = 0; k < plan.ahead; ++k) {
    const MapPoint& p = next[static_cast<std::size_t>(k)];
    plan.point[static_cast<std::size_t>(plan.n + k)] = {p.x, p.y};
  }
}

}  // namespace

std::size_t PlanList::points() const {
  std::size_t n = 0;
  for (const MapPoints& plan : plans) n += plan.size();
  return n;
}

PlanList parse_plans(std::string_view text, const std::string& name) {
  if (text.find('\0') != std::string_view::npos) refuse(name, 0, "this is not a text", kFormat);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Reader reader(name);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    reader.take(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return reader.end();
}

PlanList load_plans(const std::filesystem::path& file) {
  return parse_plans(read_input_file(file, kMaxFileBytes, FaultCode::bad_plan), file.string());
}

std::string to_text(const PlanList& plans) {
  std::string name = plans.name;
  std::ranges::replace_if(
      name, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }, '?');
  std::string text =
      fmt::format("# {}\nstart {} {} {}\n", name, plans.start.x, plans.start.y, plans.start.phi);
  for (const MapPoints& plan : plans.plans) {
    if (&plan != &plans.plans.front()) text += "plan\n";
    for (const MapPoint& p : plan) text += fmt::format("{} {}\n", p.x, p.y);
  }
  return text;
}

void check_start(const PlanList& plans, const LegCheck& check) {
  const MapPoint start{plans.start.x, plans.start.y, plans.start_line};
  if (const std::string wrong = check(start, start); !wrong.empty())
    refuse(plans.name, start.line, fmt::format("the start ({:g}, {:g}): {}", start.x, start.y, wrong),
           "begin in free space");
}

void check_legs(const PlanList& plans, const LegCheck& check) {
  MapPoint at{plans.start.x, plans.start.y, 0};
  const auto look = [&](const MapPoint& to) {
    if (const std::string wrong = check(at, to); !wrong.empty())
      refuse(plans.name, to.line,
             fmt::format("the way from ({:g}, {:g}) to ({:g}, {:g}): {}", at.x, at.y, to.x, to.y, wrong),
             "move the points into free space");
    at = to;
  };
  for (const MapPoints& plan : plans.plans)
    for (const MapPoint& p : plan) look(p);
}

std::vector<Plan> to_messages(const PlanList& plans, double speed) {
  std::vector<Plan> messages;
  for (std::size_t k = 0; k < plans.plans.size(); ++k) {
    const MapPoints& points = plans.plans[k];
    Plan& plan = messages.emplace_back();
    plan.number = static_cast<std::int64_t>(k + 1);
    plan.n = static_cast<std::int32_t>(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) plan.point[p] = {points[p].x, points[p].y};
    plan.speed = speed;
    if (k + 1 < plans.plans.size() && flows(points, plans.plans[k + 1])) look_ahead(plans.plans[k + 1], plan);
  }
  return messages;
}

}  // namespace mrroc::rex_drive
