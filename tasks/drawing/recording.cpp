#include "tasks/drawing/recording.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/text_file.hpp"

namespace mrroc::drawing {
namespace {

constexpr std::string_view kFormat = "mrroc-drawing-recording";
constexpr std::string_view kNodeColumns = "x y z ax ay az pen";
constexpr std::string_view kInkColumns = "stroke t x y";
constexpr std::size_t kMaxRows = 1'000'000;  // nodes: five hours at 20 ms
constexpr std::size_t kMaxFileBytes = 400'000'000;

// The rest of a line that begins with a keyword.
std::string_view after(Lines& lines, std::string_view keyword) {
  const std::string_view line = lines.next();
  if (line.substr(0, keyword.size()) != keyword || line.substr(keyword.size(), 1) != " ")
    lines.fail(fmt::format("expected '{} ...' instead of '{:.40}'", keyword, line));
  return line.substr(keyword.size() + 1);
}

void expect(Lines& lines, std::string_view wanted) {
  const std::string_view line = lines.next();
  if (line != wanted) lines.fail(fmt::format("expected '{}' instead of '{:.40}'", wanted, line));
}

Node read_node(Lines& lines) {
  Node node;
  const std::string_view pen = lines.numbers(lines.next(), ' ', node.velocity.v);
  const std::optional<PenState> state = pen_state_named(pen.substr(std::min<std::size_t>(1, pen.size())));
  if (!state) lines.fail(fmt::format("'{:.40}' is not a pen state", pen));
  node.pen = *state;
  return node;
}

Recording read_nodes(Lines& lines, double macrostep_s) {
  const std::size_t count = lines.count(after(lines, "nodes"), kMaxRows);
  expect(lines, kNodeColumns);
  Recording recording(macrostep_s);
  bool draws = false;
  for (std::size_t p = 0; p < count; ++p) {
    const Node node = read_node(lines);
    draws = draws || node.pen == PenState::paper_surface;
    recording = recording.appended(node);
  }
  if (!draws) lines.fail("no node has the pen on the paper, so there is nothing to draw", "teach it again");
  return recording;
}

}  // namespace

Recording Recording::appended(const Node& node) const {
  Recording next = *this;
  const bool newest = nodes_ && nodes_->size() == size_;
  if (!newest) {  // a later version owns the place behind the last node, or there is no buffer yet
    next.nodes_ = std::make_shared<std::vector<Node>>();
    if (nodes_) next.nodes_->assign(nodes_->begin(), nodes_->begin() + static_cast<std::ptrdiff_t>(size_));
  }
  next.nodes_->push_back(node);
  ++next.size_;
  return next;
}

Recording without_false_touches(const Recording& recording) {
  const auto paper = [&](std::size_t n) { return recording[n].pen == PenState::paper_surface; };
  std::vector<Node> nodes;
  bool drawn = false;
  std::size_t taken_back = 0;
  for (std::size_t n = 0; n < recording.size();) {
    std::size_t end = n + 1;
    while (end < recording.size() && paper(end) == paper(n)) ++end;
    const bool none = paper(n) && end < recording.size() && recording[end].pen == PenState::lowering;
    taken_back += none;
    drawn = drawn || (paper(n) && !none);
    for (; n < end; ++n)
      if (drawn || taken_back == 0)
        nodes.push_back({recording[n].velocity, none ? PenState::lowering : recording[n].pen});
    if (!drawn && taken_back > 0) nodes.clear();
  }
  if (taken_back == 0) return recording;
  Recording revised(recording.macrostep_s());
  for (const Node& node : nodes) revised = revised.appended(node);
  return revised;
}

bool operator==(const Recording& a, const Recording& b) {
  if (a.macrostep_s_ != b.macrostep_s_ || a.size_ != b.size_) return false;
  return a.nodes_ == b.nodes_ ||
         std::equal(a.nodes_->begin(), a.nodes_->begin() + static_cast<std::ptrdiff_t>(a.size_),
                    b.nodes_->begin());
}

std::string recording_text(const Taught& taught, const std::string& name) {
  const auto finite_or_throw = [&](bool ok) {
    if (!ok) throw FileError(name, 0, "a recording with a number that is not finite cannot be saved", "");
  };
  const Recording& recording = taught.recording;
  std::string text = fmt::format("{} {}\nmacrostep_s {:.17g}\nnodes {}\n{}\n", kFormat, kRecordingVersion,
                                 recording.macrostep_s(), recording.size(), kNodeColumns);
  for (std::size_t p = 0; p < recording.size(); ++p) {
    const Node node = recording[p];
    finite_or_throw(finite(node.velocity));
    for (const double v : node.velocity.v) text += fmt::format("{:.17g} ", v);
    text += fmt::format("{}\n", to_string(node.pen));
  }
  text += fmt::format("ink {}\n{}\n", taught.ink.size(), kInkColumns);
  for (const InkPoint& p : taught.ink) {
    finite_or_throw(std::isfinite(p.t) && std::isfinite(p.x) && std::isfinite(p.y));
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", p.stroke, p.t, p.x, p.y);
  }
  return text + "end\n";
}

Taught parse_recording(std::string_view text, const std::string& name) {
  Lines lines(text, name);
  const std::string_view head = lines.next();
  if (head.substr(0, kFormat.size()) != kFormat)
    lines.fail(fmt::format("the file does not begin with '{}'", kFormat), "give a file made with --save");
  if (head != fmt::format("{} {}", kFormat, kRecordingVersion))
    lines.fail(fmt::format("'{:.60}' is not version {}", head, kRecordingVersion), "teach the drawing again");
  double macrostep_s = 0;
  const std::string_view rest = lines.numbers(after(lines, "macrostep_s"), ' ', {&macrostep_s, 1});
  if (!rest.empty() || !(macrostep_s > 0 && macrostep_s <= 1))
    lines.fail("a macrostep lasts more than 0 and up to 1 s");
  Taught taught;
  taught.recording = read_nodes(lines, macrostep_s);
  const std::size_t count = lines.count(after(lines, "ink"), kMaxRows);
  expect(lines, kInkColumns);
  for (std::size_t k = 0; k < count; ++k) append_ink_row(taught.ink, lines, lines.next(), ' ');
  expect(lines, "end");
  if (!lines.done()) {
    (void)lines.next();
    lines.fail("text behind the end");
  }
  return taught;
}

void save(const std::filesystem::path& file, const Taught& taught) {
  write_text_file(file, recording_text(taught, file.string()));
}

Taught load(const std::filesystem::path& file) {
  return parse_recording(read_text_file(file, kMaxFileBytes), file.string());
}

}  // namespace mrroc::drawing
