#include "tasks/drawing/svg_style.hpp"

#include <algorithm>
#include <cctype>

#include "tasks/drawing/svg_shapes.hpp"
#include "tasks/drawing/svg_values.hpp"

namespace mrroc::drawing::svg {
namespace {

constexpr std::string_view kBlank = " \t\r\n\f";
constexpr std::size_t kWorkOfARule = 1000;   // its memory: so many bytes, at most, are worth no more
constexpr std::size_t kLongestKeyword = 20;  // values of display and visibility are shorter
constexpr int kMostParts = 32;               // of a selector

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string without_comments(std::string_view css) {
  std::string result;
  while (!css.empty()) {
    const std::size_t begin = css.find("/*");
    result += css.substr(0, begin);
    if (begin == std::string_view::npos) break;
    const std::size_t end = css.find("*/", begin + 2);
    css.remove_prefix(end == std::string_view::npos ? css.size() : end + 2);
  }
  return result;
}

// The end of a block that begins at text[0] == '{', behind its closing brace.
std::size_t block_end(std::string_view text) {
  int depth = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '{') ++depth;
    if (text[k] == '}' && --depth == 0) return k + 1;
  }
  return text.size();
}

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool has_word(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    list = trimmed(list);
    const std::size_t end = std::min(list.find_first_of(kBlank), list.size());
    if (list.substr(0, end) == word) return true;
    list.remove_prefix(end);
  }
  return false;
}

}  // namespace

void StyleSheet::add(std::string_view css) {
  work_.spend(css.size());
  const std::string plain = without_comments(css);
  std::string_view rest = plain;
  while (!(rest = trimmed(rest)).empty()) {
    if (rest[0] == '@') {  // to its semicolon or over its block
      const std::size_t end = std::min(rest.find_first_of(";{"), rest.size());
      rest.remove_prefix(end < rest.size() && rest[end] == '{' ? end + block_end(rest.substr(end))
                                                               : std::min(end + 1, rest.size()));
      continue;
    }
    const std::size_t open = rest.find('{');
    if (open == std::string_view::npos) return;
    std::string_view selectors = rest.substr(0, open);
    const std::size_t length = block_end(rest.substr(open));
    std::string_view block = rest.substr(open + 1, length - 1);
    if (!block.empty() && block.back() == '}') block.remove_suffix(1);
    rest.remove_prefix(open + length);
    const std::string_view display = style_property(block, "display");
    const std::string_view visibility = style_property(block, "visibility");
    if (display.empty() && visibility.empty()) continue;
    while (!selectors.empty()) {
      const std::size_t comma = std::min(selectors.find(','), selectors.size());
      add_rule(trimmed(selectors.substr(0, comma)), display, visibility);
      selectors.remove_prefix(std::min(comma + 1, selectors.size()));
    }
  }
}

void StyleSheet::add_rule(std::string_view selector, std::string_view display, std::string_view visibility) {
  work_.spend(kWorkOfARule);
  Rule rule;
  rule.display = display.substr(0, kLongestKeyword);
  rule.visibility = visibility.substr(0, kLongestKeyword);
  if (selector.empty()) return;
  for (int parts = 0; !selector.empty(); ++parts) {
    const char kind = selector[0] == '.' || selector[0] == '#' || selector[0] == '*' ? selector[0] : ' ';
    if (kind != ' ') selector.remove_prefix(1);
    std::size_t end = 0;
    while (end < selector.size() && is_name(selector[end])) ++end;
    const std::string name(selector.substr(0, end));
    selector.remove_prefix(end);
    if ((kind == '*') != name.empty() || parts == kMostParts) {
      ++not_understood_;
      return;
    }
    if (kind == '.') rule.classes.push_back(name);
    if (kind == '#') rule.id = name;
    if (kind == ' ') rule.element = name;
    rule.specificity += kind == '#' ? 10'000 : kind == '.' ? 100 : kind == ' ' ? 1 : 0;
  }
  rules_.push_back(std::move(rule));
}

bool StyleSheet::applies(const Rule& rule, const Asked& asked) const {
  if (!rule.element.empty() && rule.element != asked.element) return false;
  if (!rule.id.empty() && rule.id != asked.id) return false;
  return std::ranges::all_of(rule.classes, [&](const std::string& name) {
    work_.spend(asked.classes.size());
    return has_word(asked.classes, name);
  });
}

std::string_view StyleSheet::property(const pugi::xml_node& node, std::string_view element,
                                      const char* name) const {
  const std::string_view own = style_property(node.attribute("style").value(), name);
  if (!own.empty()) return own;
  work_.spend(rules_.size());
  const Asked asked{element, node.attribute("id").value(), node.attribute("class").value()};
  const bool display = std::string_view(name) == "display";
  std::string_view found;
  int specificity = -1;
  for (const Rule& rule : rules_) {
    const std::string_view value = display ? rule.display : rule.visibility;
    if (value.empty() || rule.specificity < specificity || !applies(rule, asked)) continue;
    found = value;
    specificity = rule.specificity;
  }
  return found.empty() ? svg::property(node, name) : found;
}

}  // namespace mrroc::drawing::svg
