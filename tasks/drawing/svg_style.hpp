// Style sheets of an SVG document, as far as they decide what is drawn. Internal to the reader.
#pragma once
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/drawing/svg_work.hpp"

namespace mrroc::drawing::svg {

/// Rules with simple selectors (`*`, `path`, `.class`, `#id`, and these together without blanks, in lists) for
/// `display` and `visibility`. Everything else in a style sheet does not matter to a pen.
class StyleSheet {
 public:
  /// @param work  outlives this; what it costs to read and to ask
  explicit StyleSheet(Work& work) : work_(work) {}

  /// Adds the rules of one <style> element. Rules in media and the like are passed over.
  /// @throws FileError too much work
  void add(std::string_view css);

  /// @param element  the element's name without its prefix
  /// @return a property of an element: from its style attribute, the style sheets, or the attribute of that name,
  /// in this order, as CSS wants it; empty if nobody tells. Lives as long as the sheet and the node
  /// @throws FileError too much work
  /// @param name  display or visibility
  [[nodiscard]] std::string_view property(const pugi::xml_node& node, std::string_view element,
                                          const char* name) const;

  /// @return number of selectors with display or visibility that were not understood
  [[nodiscard]] int not_understood() const { return not_understood_; }

 private:
  struct Rule {
    std::string element, id;           // empty: any
    std::vector<std::string> classes;  // all of them
    int specificity{};
    std::string display, visibility;  // empty: the rule does not tell
  };
  /// Properties of an element that selectors test.
  struct Asked {
    std::string_view element, id, classes;
  };
  void add_rule(std::string_view selector, std::string_view display, std::string_view visibility);
  [[nodiscard]] bool applies(const Rule& rule, const Asked& asked) const;

  Work& work_;
  std::vector<Rule> rules_;
  int not_understood_{};
};

}  // namespace mrroc::drawing::svg
