#include "tasks/drawing/svg_document.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <unordered_map>

#include "base/printable.hpp"
#include "tasks/drawing/svg_shapes.hpp"
#include "tasks/drawing/svg_style.hpp"

namespace mrroc::drawing::svg {
namespace {

constexpr int kMaxDepth = 256;  // of nested elements; a `use` that contains itself gets there
constexpr std::size_t kMaxElements = 1'000'000;  // visited, counting again what `use` repeats
constexpr std::size_t kOfANode = 10;             // steps of work
constexpr std::size_t kMostIgnored = 16;         // kinds of elements that are told
constexpr std::size_t kMostShown = 40;           // characters of a name in an error

// Properties that an element inherits.
struct Context {
  Affine T = Affine::Identity();
  Viewport viewport;
  bool visible{true};
  int depth{};
};

// Elements that never draw anything themselves, so that leaving them out is not worth a word.
bool is_silent(std::string_view name) {
  constexpr std::array kSilent{
      "animate",        "animateColor", "animateMotion", "animateTransform", "clipPath", "color-profile",
      "cursor",         "defs",         "desc",          "filter",           "font",     "font-face",
      "linearGradient", "marker",       "mask",          "metadata",         "pattern",  "radialGradient",
      "script",         "set",          "style",         "symbol",           "title",    "view"};
  return std::find(kSilent.begin(), kSilent.end(), name) != kSilent.end();
}

class Reader {
 public:
  Reader(std::string_view text, std::string name) : text_(text), name_(std::move(name)), work_(name_) {}

  Document read() {
    load();
    pugi::xml_node root;
    for (const pugi::xml_node node : xml_.children())
      if (node.type() == pugi::node_element) root = node;
    const std::string_view full = root.name();
    prefix_ = full.substr(0, full.find(':') == std::string_view::npos ? 0 : full.find(':') + 1);
    if (local_name(root) != "svg")
      throw FileError(name_, line_of(root.offset_debug()),
                      fmt::format("<{}> is not an SVG drawing", full.substr(0, kMostShown)),
                      "give an SVG file");
    remember(root);
    Context context;
    context.viewport = root_viewport(root);
    try {
      context = inherit(root, context);
    } catch (const BadValue& bad) {
      fail(root, bad.what(), "mend the value");
    }
    visit_children(root, context);
    return {std::move(paths_), ignored()};
  }

 private:
  void load() {
    if (text_.substr(0, 2) == "\x1f\x8b")
      throw FileError(name_, 0, "the file is compressed (.svgz)", "unpack it with gunzip");
    const pugi::xml_parse_result result = xml_.load_buffer(text_.data(), text_.size());
    utf8_ = result.encoding == pugi::encoding_utf8;
    if (result.status == pugi::status_no_document_element)
      throw FileError(name_, 0, "there is no XML element in it", "give an SVG file");
    if (!result)
      throw FileError(name_, line_of(result.offset),
                      fmt::format("not well-formed XML: {}", lower(result.description())),
                      "mend it or export it again");
  }

  static std::string lower(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
  }

  // Offsets count bytes of the text as UTF-8, so they say nothing about a text in another encoding.
  [[nodiscard]] int line_of(std::ptrdiff_t offset) const {
    if (!utf8_ || offset < 0 || offset > static_cast<std::ptrdiff_t>(text_.size())) return 0;
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + offset, '\n'));
  }

  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& wrong,
                         const std::string& remedy) const {
    const std::string_view id = node.attribute("id").value();
    const std::string_view name = std::string_view(node.name()).substr(0, kMostShown);
    const std::string element = id.empty() ? fmt::format("<{}>", name)
                                           : fmt::format("<{} id=\"{}\">", name, id.substr(0, kMostShown));
    throw FileError(name_, line_of(node.offset_debug()), fmt::format("{}: {}", element, wrong), remedy);
  }

  // The name of an SVG element; elements of other vocabularies, as editors leave them, have none.
  [[nodiscard]] std::string_view local_name(const pugi::xml_node& node) const {
    const std::string_view full = node.name();
    if (full.substr(0, prefix_.size()) != prefix_) return {};
    const std::string_view local = full.substr(prefix_.size());
    return local.find(':') == std::string_view::npos ? local : std::string_view{};
  }

  // Elements by their names, and the style sheets, which count wherever they stand.
  void remember(const pugi::xml_node& root) {
    pugi::xml_node node = root;
    while (node) {  // in document order, without recursion
      if (const pugi::xml_attribute id = node.attribute("id")) ids_.emplace(id.value(), node);
      if (local_name(node) == "style")
        for (const pugi::xml_node text : node.children()) sheet_.add(text.value());
      if (node.first_child()) {
        node = node.first_child();
        continue;
      }
      while (node != root && !node.next_sibling()) node = node.parent();
      node = node == root ? pugi::xml_node() : node.next_sibling();
    }
  }

  Context inherit(const pugi::xml_node& node, Context context) {
    context.T = context.T * transform(node.attribute("transform").value());
    const std::string_view visibility = sheet_.property(node, local_name(node), "visibility");
    if (!visibility.empty() && visibility != "inherit") context.visible = visibility == "visible";
    if (++context.depth > kMaxDepth)
      fail(node, fmt::format("nested deeper than {} elements", kMaxDepth),
           "look for a <use> that contains itself");
    if (++elements_ > kMaxElements)
      fail(node, fmt::format("over {} elements", kMaxElements), "simplify the drawing");
    return context;
  }

  void visit_children(const pugi::xml_node& node, const Context& context) {
    for (const pugi::xml_node child : node.children()) {
      work_.spend(kOfANode);
      if (child.type() == pugi::node_element) visit(child, context);
    }
  }

  /// Cost of reading an element's attributes, each time that it is drawn.
  void spend(const pugi::xml_node& node) {
    constexpr std::size_t kOfAnAttribute = 20;  // some twenty of them are looked for, one after the other
    constexpr std::size_t kOfACharacter = 4;    // most are of numbers
    for (const pugi::xml_attribute attribute : node.attributes())
      work_.spend(kOfAnAttribute + kOfACharacter * std::string_view(attribute.value()).size());
  }

  void visit(const pugi::xml_node& node, const Context& parent) {
    spend(node);
    const std::string_view name = local_name(node);
    if (name.empty() || is_silent(name) || sheet_.property(node, name, "display") == "none") return;
    try {
      const Context context = inherit(node, parent);
      if (name == "g" || name == "a" || name == "switch")
        visit_children(node, context);
      else if (name == "svg")
        visit_viewport(node, node, context);
      else if (name == "use")
        visit_use(node, context);
      else if (context.visible)
        draw(node, name, context);
    } catch (const BadValue& bad) {
      fail(node, bad.what(), "mend the value");
    }
  }

  void draw(const pugi::xml_node& node, std::string_view name, const Context& context) {
    const std::optional<Outline> outline = shape(node, name, context.viewport);
    if (!outline) {
      const std::string kind(name.substr(0, kMostShown));
      ++ignored_[ignored_.size() < kMostIgnored || ignored_.contains(kind) ? kind : "other elements"];
      return;
    }
    for (SubPath& path : outline->sub_paths(context.T)) {
      if (!finite(path)) throw BadValue("a number too large");
      curves_ += path.segments.size();
      paths_.push_back(std::move(path));
    }
    if (curves_ > kMaxCurves)
      throw FileError(name_, 0, fmt::format("over {} points after flattening", kMaxPoints),
                      "simplify the drawing");
  }

  void visit_use(const pugi::xml_node& node, Context context) {
    const pugi::xml_attribute plain = node.attribute("href");
    const std::string href = plain ? plain.value() : node.attribute("xlink:href").value();
    const auto found = ids_.find(href.empty() ? href : href.substr(1));
    if (href.substr(0, 1) != "#" || found == ids_.end())
      fail(node, fmt::format("refers to '{}', which is not in this file", href.substr(0, kMostShown)),
           "add it or remove the <use>");
    const pugi::xml_node target = found->second;
    spend(target);
    context.T.translate(Point(length_attribute(node, "x", context.viewport.width),
                              length_attribute(node, "y", context.viewport.height)));
    const std::string_view name = local_name(target);
    if (name != "symbol" && name != "svg") return visit(target, context);
    if (sheet_.property(target, name, "display") != "none")
      visit_viewport(target, node, inherit(target, context));
  }

  // A nested svg or a symbol: its own coordinates in a viewport, whose size `sizes` may tell.
  void visit_viewport(const pugi::xml_node& node, const pugi::xml_node& sizes, Context context) {
    context.T.translate(Point(length_attribute(node, "x", context.viewport.width),
                              length_attribute(node, "y", context.viewport.height)));
    const auto size = [&](const char* name, double whole) {
      const pugi::xml_attribute own = node.attribute(name);
      const pugi::xml_attribute given = sizes.attribute(name) ? sizes.attribute(name) : own;
      return given ? length_of(given.value(), whole) : whole;
    };
    Viewport inner{size("width", context.viewport.width), size("height", context.viewport.height)};
    if (const pugi::xml_attribute attribute = node.attribute("viewBox")) {
      const std::vector<double> box = numbers(attribute.value());
      if (box.size() != 4) throw BadValue("viewBox needs four numbers");
      if (!(box[2] > 0 && box[3] > 0)) return;  // disables rendering
      if (std::isfinite(inner.width) && std::isfinite(inner.height))
        context.T = context.T *
                    view_box(box, node.attribute("preserveAspectRatio").value(), inner.width, inner.height);
      inner = {box[2], box[3]};
    }
    context.viewport = inner;
    visit_children(node, context);
  }

  // The outermost size matters for percentages only.
  Viewport root_viewport(const pugi::xml_node& root) const {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    try {
      const std::vector<double> box = numbers(root.attribute("viewBox").value());
      if (box.size() == 4) return {box[2], box[3]};
      const auto size = [&](const char* name) {
        const pugi::xml_attribute given = root.attribute(name);
        return given ? length_of(given.value(), kUnknown) : kUnknown;
      };
      return {size("width"), size("height")};
    } catch (const BadValue&) {
      return {kUnknown, kUnknown};
    }
  }

  [[nodiscard]] std::string ignored() const {
    std::string list;
    if (const int rules = sheet_.not_understood(); rules > 0) list = fmt::format("style rule ({})", rules);
    for (const auto& [name, count] : ignored_)
      list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", name, count);
    return without_controls(list);
  }

  std::string_view text_;
  std::string name_;
  Work work_;
  std::string_view prefix_;  // of SVG elements, with its colon
  bool utf8_{true};
  pugi::xml_document xml_;
  std::unordered_map<std::string, pugi::xml_node> ids_;
  StyleSheet sheet_{work_};
  std::vector<SubPath> paths_;
  std::map<std::string, int> ignored_;
  std::size_t curves_{};
  std::size_t elements_{};
};

}  // namespace

Document read_document(std::string_view text, const std::string& name) { return Reader(text, name).read(); }

}  // namespace mrroc::drawing::svg
