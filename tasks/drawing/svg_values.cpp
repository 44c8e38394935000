#include "tasks/drawing/svg_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace mrroc::drawing::svg {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

Affine matrix(double a, double b, double c, double d, double e, double f) {
  Affine T;
  T.matrix() << a, c, e, b, d, f, 0, 0, 1;
  return T;
}

Affine turn(double degrees) {
  return Affine(Eigen::Rotation2Dd(degrees * std::numbers::pi / 180).toRotationMatrix());
}

Affine function(const Scanner& s, std::string_view name, const std::vector<double>& v) {
  const auto tangent = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180); };
  const std::size_t n = v.size();
  if (name == "matrix" && n == 6) return matrix(v[0], v[1], v[2], v[3], v[4], v[5]);
  if (name == "translate" && (n == 1 || n == 2)) return matrix(1, 0, 0, 1, v[0], n == 2 ? v[1] : 0);
  if (name == "scale" && (n == 1 || n == 2)) return matrix(v[0], 0, 0, v[n - 1], 0, 0);
  if (name == "rotate" && n == 1) return turn(v[0]);
  if (name == "rotate" && n == 3)
    return matrix(1, 0, 0, 1, v[1], v[2]) * turn(v[0]) * matrix(1, 0, 0, 1, -v[1], -v[2]);
  if (name == "skewX" && n == 1) return matrix(1, 0, tangent(v[0]), 1, 0, 0);
  if (name == "skewY" && n == 1) return matrix(1, tangent(v[0]), 0, 1, 0, 0);
  s.fail(fmt::format("'{:.40}' with {} numbers is not a transform", name, n));
}

// Offset of the box in a viewport that is larger or smaller by `room`.
double aligned(std::string_view preserve, std::string_view low, std::string_view high, double room) {
  if (preserve.find(low) != std::string_view::npos) return 0;
  return preserve.find(high) != std::string_view::npos ? room : room / 2;
}

}  // namespace

bool Scanner::done() {
  at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
  return at_ == text_.size();
}

bool Scanner::pass(char c) {
  if (done() || text_[at_] != c) return false;
  ++at_;
  return true;
}

bool Scanner::pass_separator() {
  const bool comma = pass(',');
  done();
  return comma;
}

bool Scanner::at_number() const {
  return at_ < text_.size() &&
         (is_digit(text_[at_]) || std::string_view("+-.").find(text_[at_]) != std::string_view::npos);
}

double Scanner::number() {
  std::size_t digits = at_;
  if (digits < text_.size() && text_[digits] == '+') ++digits;  // from_chars takes no plus
  std::size_t first = digits;
  if (first == at_ && first < text_.size() && text_[first] == '-') ++first;
  // from_chars would also take "inf" and "nan".
  if (first >= text_.size() || !(is_digit(text_[first]) || text_[first] == '.')) fail("expected a number");
  double value = 0;
  const char* const end = text_.data() + text_.size();
  const auto [stop, error] = std::from_chars(text_.data() + digits, end, value);
  if (error == std::errc::result_out_of_range) fail("a number too large or too small");
  if (error != std::errc()) fail("expected a number");
  at_ = static_cast<std::size_t>(stop - text_.data());
  return value;
}

bool Scanner::flag() {
  if (at_ >= text_.size() || (text_[at_] != '0' && text_[at_] != '1')) fail("expected an arc flag, 0 or 1");
  return take() == '1';
}

std::string_view Scanner::word() {
  const std::size_t first = at_;
  while (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '%')) ++at_;
  return text_.substr(first, at_ - first);
}

void Scanner::fail(std::string_view wrong) const {
  if (at_ >= text_.size()) throw BadValue(fmt::format("{} at its end", wrong));
  throw BadValue(fmt::format("{} at character {}: '{}'", wrong, at_ + 1, text_.substr(at_, 20)));
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  Scanner s(text);
  bool comma = false;
  while (!s.done() || comma) {
    values.push_back(s.number());
    comma = s.pass_separator();
  }
  return values;
}

double length_of(std::string_view text, double whole) {
  struct Unit {
    std::string_view name;
    double px;
  };
  constexpr std::array kUnits{Unit{"", 1},           Unit{"px", 1},         Unit{"in", 96},
                              Unit{"cm", 96 / 2.54}, Unit{"mm", 96 / 25.4}, Unit{"Q", 96 / 101.6},
                              Unit{"pt", 96.0 / 72}, Unit{"pc", 16}};
  Scanner s(text);
  s.done();
  const double value = s.number();
  const std::string_view unit = s.word();
  if (!s.done()) s.fail("unexpected text");
  if (unit == "%") {
    if (!std::isfinite(whole)) throw BadValue("per cent of a page whose size is not given");
    return value / 100 * whole;
  }
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return u.name == unit; });
  if (found == kUnits.end()) throw BadValue(fmt::format("the unit '{:.40}' is not supported", unit));
  return value * found->px;
}

Affine transform(std::string_view text) {
  Affine total = Affine::Identity();
  Scanner s(text);
  if (trimmed(text) == "none") return total;
  while (!s.done()) {
    const std::string_view name = s.word();
    if (name.empty() || !s.pass('(')) s.fail("expected a transform such as rotate(30)");
    std::vector<double> values;
    bool comma = false;
    while (comma || !s.pass(')')) {
      s.done();
      values.push_back(s.number());
      comma = s.pass_separator();
    }
    total = total * function(s, name, values);
    s.pass_separator();
  }
  return total;
}

Affine view_box(const std::vector<double>& box, std::string_view preserve, double width, double height) {
  double sx = width / box[2];
  double sy = height / box[3];
  if (preserve.find("none") == std::string_view::npos)
    sx = sy = preserve.find("slice") == std::string_view::npos ? std::min(sx, sy) : std::max(sx, sy);
  const double x = aligned(preserve, "xMin", "xMax", width - sx * box[2]);
  const double y = aligned(preserve, "YMin", "YMax", height - sy * box[3]);
  return matrix(sx, 0, 0, sy, x - sx * box[0], y - sy * box[1]);
}

std::string_view style_property(std::string_view style, std::string_view name) {
  std::string_view value;
  while (!style.empty()) {
    const std::string_view rule = style.substr(0, style.find(';'));
    style.remove_prefix(std::min(rule.size() + 1, style.size()));
    const std::size_t colon = rule.find(':');
    if (colon != std::string_view::npos && trimmed(rule.substr(0, colon)) == name)
      value = trimmed(rule.substr(colon + 1));  // the last one counts
  }
  return trimmed(value.substr(0, value.find('!')));
}

}  // namespace mrroc::drawing::svg
