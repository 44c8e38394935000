#include "tasks/drawing/svg_path.hpp"

#include <fmt/core.h>

namespace mrroc::drawing::svg {
namespace {

// Executes path commands one after the other. `control` is the last control point while a curve of the same
// degree may be continued smoothly (S after C or S, T after Q or T).
class PathReader {
 public:
  explicit PathReader(std::string_view d) : s_(d) {}

  Outline read() {
    if (s_.done()) return {};
    char command = s_.take();
    if (command != 'M' && command != 'm') {
      throw BadValue("path data has to begin with M or m");
    }
    while (true) {
      const bool closes = command == 'Z' || command == 'z';
      execute(command);
      const bool comma = s_.pass_separator();
      if (comma && (closes || !s_.at_number())) s_.fail("expected a number after the comma");
      if (s_.done()) return out_;
      if (s_.at_number() && !closes) {  // more numbers repeat the command; after a move they are lines
        if (command == 'M') command = 'L';
        if (command == 'm') command = 'l';
      } else {
        command = s_.take();
      }
    }
  }

 private:
  void execute(char command) {
    relative_ = command >= 'a';
    const char kind = relative_ ? static_cast<char>(command - 'a' + 'A') : command;
    const Point here = out_.current();
    const Point mirrored = 2 * here - control_;
    const char before = kind_;
    kind_ = kind;
    switch (kind) {
      case 'M':
        return out_.move_to(point());
      case 'L':
        return out_.line_to(point());
      case 'H':
        return out_.line_to({coordinate(here.x()), here.y()});
      case 'V':
        return out_.line_to({here.x(), coordinate(here.y())});
      case 'C':
        return cubic(point());
      case 'S':
        return cubic(before == 'C' || before == 'S' ? mirrored : here);
      case 'Q':
        return quadratic(point());
      case 'T':
        return quadratic(before == 'Q' || before == 'T' ? mirrored : here);
      case 'A':
        return arc();
      case 'Z':
        return out_.close();
      default:
        throw BadValue(fmt::format("unknown path command '{}'", command));
    }
  }

  void cubic(const Point& c1) {
    const Point c2 = point();
    out_.cubic_to(c1, c2, point());
    control_ = c2;
  }

  void quadratic(const Point& c) {
    out_.quadratic_to(c, point());
    control_ = c;
  }

  void arc() {
    const double rx = number();
    const double ry = number();
    const double degrees = number();
    s_.pass_separator();
    const bool large = s_.flag();
    s_.pass_separator();
    const bool sweep = s_.flag();
    out_.arc_to(rx, ry, degrees, large, sweep, point());
  }

  double number() {
    s_.pass_separator();
    return s_.number();
  }
  double coordinate(double here) { return number() + (relative_ ? here : 0); }
  Point point() {
    const double x = coordinate(out_.current().x());
    return {x, coordinate(out_.current().y())};
  }

  Scanner s_;
  Outline out_;
  Point control_{0, 0};
  char kind_{};
  bool relative_{false};
};

}  // namespace

Outline path_data(std::string_view d) {
  if (d == "none") return {};
  return PathReader(d).read();
}

}  // namespace mrroc::drawing::svg
