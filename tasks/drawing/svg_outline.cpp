#include "tasks/drawing/svg_outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::drawing::svg {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

Segment transformed(const Segment& segment, const Affine& T) {
  if (const Cubic* c = std::get_if<Cubic>(&segment))
    return Cubic{{T * c->p[0], T * c->p[1], T * c->p[2], T * c->p[3]}};
  const Arc& arc = std::get<Arc>(segment);
  return Arc{T * arc.centre, T.linear() * arc.a, T.linear() * arc.b, arc.from, arc.sweep};
}

Point at(const Cubic& c, double t) {
  const double u = 1 - t;
  return u * u * u * c.p[0] + 3 * u * u * t * c.p[1] + 3 * u * t * t * c.p[2] + t * t * t * c.p[3];
}

Point at(const Arc& arc, double t) {
  const double angle = arc.from + t * arc.sweep;
  return arc.centre + arc.a * std::cos(angle) + arc.b * std::sin(angle);
}

double curvature_bound(const Cubic& c) {
  return 6 * std::max((c.p[0] - 2 * c.p[1] + c.p[2]).norm(), (c.p[1] - 2 * c.p[2] + c.p[3]).norm());
}

double curvature_bound(const Arc& arc) {
  // |a cos + b sin| is at most the root of the sum of squares.
  return std::hypot(arc.a.norm(), arc.b.norm()) * arc.sweep * arc.sweep;
}

}  // namespace

void Outline::move_to(const Point& p) {
  if (!paths_.empty() && paths_.back().segments.empty()) paths_.pop_back();  // a bare move draws nothing
  paths_.push_back({p, {}});
  current_ = p;
  open_ = true;
}

void Outline::add(const Segment& segment, const Point& end) {
  if (++curves_ > kMaxCurves) throw BadValue(fmt::format("over {} curves in one element", kMaxCurves));
  if (!open_) {  // after a close the next sub-path begins where the closed one did
    const Point start = current_;
    move_to(start);
  }
  paths_.back().segments.push_back(segment);
  current_ = end;
}

void Outline::line_to(const Point& p) {
  add(Cubic{{current_, (2 * current_ + p) / 3, (current_ + 2 * p) / 3, p}}, p);
}

void Outline::quadratic_to(const Point& c, const Point& p) {
  add(Cubic{{current_, (current_ + 2 * c) / 3, (p + 2 * c) / 3, p}}, p);
}

void Outline::cubic_to(const Point& c1, const Point& c2, const Point& p) {
  add(Cubic{{current_, c1, c2, p}}, p);
}

void Outline::arc_to(double rx, double ry, double degrees, bool large, bool sweep, const Point& p) {
  rx = std::abs(rx);
  ry = std::abs(ry);
  if (rx == 0 || ry == 0 || p == current_) return line_to(p);
  // From end points to centre, SVG 2, B.2.4: in axes along the half axes, scaled to a unit circle.
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(degrees * std::numbers::pi / 180).toRotationMatrix();
  const Point half = (R.transpose() * (current_ - p) / 2).cwiseQuotient(Point(rx, ry));
  const double square = half.squaredNorm();
  if (!(square > 0)) return line_to(p);  // too short to be curved
  if (square > 1) {                      // no such ellipse reaches both ends: the smallest that does
    rx *= std::sqrt(square);
    ry *= std::sqrt(square);
  }
  const Point chord = square > 1 ? Point(half / std::sqrt(square)) : half;
  const double offset = std::sqrt(std::max(0.0, 1 / chord.squaredNorm() - 1)) * (large == sweep ? -1 : 1);
  const Point middle = offset * Point(chord.y(), -chord.x());
  const Point a = R.col(0) * rx;
  const Point b = R.col(1) * ry;
  const double from = std::atan2(chord.y() - middle.y(), chord.x() - middle.x());
  const double to = std::atan2(-chord.y() - middle.y(), -chord.x() - middle.x());
  double turn = std::fmod(to - from, kTwoPi);
  if (sweep && turn < 0) turn += kTwoPi;
  if (!sweep && turn > 0) turn -= kTwoPi;
  add(Arc{(current_ + p) / 2 + a * middle.x() + b * middle.y(), a, b, from, turn}, p);
}

void Outline::ellipse(const Point& centre, double rx, double ry, double from, double sweep) {
  const Arc arc{centre, Point(rx, 0), Point(0, ry), from, sweep};
  add(arc, at(arc, 1));
}

void Outline::close() {
  if (!open_) return;
  const Point start = paths_.back().start;
  if (current_ != start || paths_.back().segments.empty()) line_to(start);
  open_ = false;
}

std::vector<SubPath> Outline::sub_paths(const Affine& T) const {
  std::vector<SubPath> result;
  for (const SubPath& path : paths_) {
    if (path.segments.empty()) continue;
    SubPath& moved = result.emplace_back(SubPath{T * path.start, {}});
    for (const Segment& segment : path.segments) moved.segments.push_back(transformed(segment, T));
  }
  return result;
}

bool finite(const SubPath& path) {
  const auto ok = [](const Segment& segment) {
    if (const Cubic* c = std::get_if<Cubic>(&segment))
      return std::all_of(c->p.begin(), c->p.end(), [](const Point& p) { return p.allFinite(); });
    const Arc& arc = std::get<Arc>(segment);
    return arc.centre.allFinite() && arc.a.allFinite() && arc.b.allFinite() &&
           std::isfinite(arc.from + arc.sweep);
  };
  return path.start.allFinite() && std::all_of(path.segments.begin(), path.segments.end(), ok);
}

double pieces(const Segment& segment, double tolerance) {
  const double bound = std::visit([](const auto& s) { return curvature_bound(s); }, segment);
  return std::max(1.0, std::ceil(std::sqrt(bound / (8 * tolerance))));
}

void append(Stroke& stroke, const Segment& segment, int count) {
  for (int k = 1; k <= count; ++k)
    stroke.push_back(
        std::visit([&](const auto& s) { return at(s, static_cast<double>(k) / count); }, segment));
}

}  // namespace mrroc::drawing::svg
