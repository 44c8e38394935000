#include "base/msg/message_type.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>

#include "base/big_endian.hpp"
#include "base/fault.hpp"
#include "base/msg/message_sources.hpp"

namespace mrroc {
namespace {

constexpr std::size_t kFingerprint = 8;

struct Primitive {
  std::string_view name;
  FieldKind kind;
  std::size_t size;
};
constexpr std::array kPrimitives{
    Primitive{"int8_t", FieldKind::int8, 1},   Primitive{"int16_t", FieldKind::int16, 2},
    Primitive{"int32_t", FieldKind::int32, 4}, Primitive{"int64_t", FieldKind::int64, 8},
    Primitive{"byte", FieldKind::byte, 1},     Primitive{"boolean", FieldKind::int8, 1},
    Primitive{"float", FieldKind::float32, 4}, Primitive{"double", FieldKind::float64, 8}};

/// One line of a definition: TYPE NAME[n]...;
struct Member {
  std::string type, name;
  std::vector<std::size_t> shape;
};

Member parse_member(const std::string& line) {
  static const std::regex pattern(R"(\s*(\w+)\s+(\w+)\s*((?:\[\d+\]\s*)*);\s*)");
  std::smatch found;
  if (!std::regex_match(line, found, pattern))
    throw FaultError(FaultCode::internal_error, fmt::format("'{}' is no field of fixed size", line));
  Member m{found[1], found[2], {}};
  const std::string shape = found[3];
  for (std::size_t at = shape.find('['); at != std::string::npos; at = shape.find('[', at + 1))
    m.shape.push_back(std::stoul(shape.substr(at + 1)));
  return m;
}

/// @return "[0][0]", "[0][1]", ... for every element of an array; one empty text for a single value
std::vector<std::string> indices(const std::vector<std::size_t>& shape) {
  std::vector<std::string> all{""};
  for (const std::size_t n : shape) {
    std::vector<std::string> longer;
    for (const std::string& begin : all)
      for (std::size_t k = 0; k < n; ++k) longer.push_back(fmt::format("{}[{}]", begin, k));
    all = std::move(longer);
  }
  return all;
}

void append(MessageType& type, const Member& m, std::span<const MessageType> known) {
  const auto primitive = std::ranges::find(kPrimitives, std::string_view(m.type), &Primitive::name);
  if (primitive != kPrimitives.end() && primitive->kind == FieldKind::int8 && !m.shape.empty()) {
    std::vector<std::size_t> outer = m.shape;
    outer.pop_back();
    for (const std::string& index : indices(outer)) {
      type.fields.push_back({m.name + index, FieldKind::text, type.size, m.shape.back()});
      type.size += m.shape.back();
    }
    return;
  }
  const auto nested = std::ranges::find(known, m.type, &MessageType::name);
  for (const std::string& index : indices(m.shape)) {
    if (primitive != kPrimitives.end()) {
      type.fields.push_back({m.name + index, primitive->kind, type.size, primitive->size});
      type.size += primitive->size;
    } else if (nested != known.end()) {
      for (Field f : nested->fields) {
        f.name = m.name + index + "." + f.name;
        f.offset = f.offset - kFingerprint + type.size;
        type.fields.push_back(std::move(f));
      }
      type.size += nested->size - kFingerprint;
    } else {
      throw FaultError(FaultCode::internal_error,
                       fmt::format("{}: the type {} is not known", type.name, m.type));
    }
  }
}

/// Reads what the line of the header says: "... // time: FIELD [UNIT]", or "... // time: none".
void read_time(MessageType& type, const std::string& line) {
  static const std::regex pattern(R"(.*// time: (none|(\S+) \[(steps|macrosteps)\])\s*)");
  std::smatch found;
  if (!std::regex_match(line, found, pattern))
    throw FaultError(FaultCode::internal_error,
                     fmt::format("{}: '{}' does not tell the time that a message is for", type.name, line));
  if (found[1] == "none") return;
  type.time = found[2];
  type.time_unit = found[3] == "steps" ? TimeUnit::steps : TimeUnit::macrosteps;
}

/// Definitions in an order in which each is made of those before it.
std::vector<MessageType> parse_all() {
  std::vector<MessageType> known;
  std::vector<MessageSource> left = message_sources();
  while (!left.empty()) {
    const std::size_t before = left.size();
    std::string why;
    std::erase_if(left, [&](const MessageSource& source) {
      try {
        MessageType type = parse_message_type(source.definition, known);
        type.fingerprint = source.fingerprint;
        known.push_back(std::move(type));
        return true;
      } catch (const FaultError& e) {
        why = e.what();
        return false;
      }
    });
    if (left.size() == before) throw FaultError(FaultCode::internal_error, why);
  }
  std::ranges::sort(known, {}, &MessageType::name);
  return known;
}

std::int64_t integer_in(std::span<const std::uint8_t> bytes, const Field& f) {
  const std::uint64_t raw = big_endian(bytes.subspan(f.offset, f.size));
  switch (f.kind) {
    case FieldKind::int8:
      return static_cast<std::int8_t>(raw);
    case FieldKind::int16:
      return static_cast<std::int16_t>(raw);
    case FieldKind::int32:
      return static_cast<std::int32_t>(raw);
    default:
      return static_cast<std::int64_t>(raw);
  }
}

}  // namespace

const Field* MessageType::field(std::string_view field_name) const {
  const auto found = std::ranges::find(fields, field_name, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

MessageType parse_message_type(std::string_view package_text, std::span<const MessageType> known) {
  MessageType type;
  type.size = kFingerprint;
  std::istringstream lines{std::string(package_text)};
  for (std::string whole; std::getline(lines, whole);) {
    const std::string line = whole.substr(0, whole.find("//"));
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line.substr(begin).starts_with("package") || line[begin] == '}')
      continue;
    if (line.substr(begin).starts_with("struct")) {
      std::istringstream words(line.substr(begin));
      words >> type.name >> type.name;
      type.name = type.name.substr(0, type.name.find('{'));
    } else if (line[begin] != '{') {
      const Member member = parse_member(line);
      if (member.type == "header_t") read_time(type, whole);
      append(type, member, known);
    }
  }
  if (!type.time.empty() && !type.field(type.time))
    throw FaultError(FaultCode::internal_error,
                     fmt::format("{} has no field '{}' that could tell its time", type.name, type.time));
  return type;
}

const std::vector<MessageType>& message_types() {
  static const std::vector<MessageType> all = parse_all();
  return all;
}

const MessageType* type_of(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kFingerprint) return nullptr;
  const auto fingerprint = static_cast<std::int64_t>(big_endian(bytes.first(kFingerprint)));
  const auto& all = message_types();
  const auto found = std::ranges::find(all, fingerprint, &MessageType::fingerprint);
  return found == all.end() || found->size != bytes.size() ? nullptr : &*found;
}

double number_in(std::span<const std::uint8_t> bytes, const Field& field) {
  const auto raw = [&] { return big_endian(bytes.subspan(field.offset, field.size)); };
  switch (field.kind) {
    case FieldKind::text:
      return std::numeric_limits<double>::quiet_NaN();
    case FieldKind::float32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(raw()));
    case FieldKind::float64:
      return std::bit_cast<double>(raw());
    default:
      return static_cast<double>(integer_in(bytes, field));
  }
}

std::string value_in(std::span<const std::uint8_t> bytes, const Field& field) {
  switch (field.kind) {
    case FieldKind::text: {
      std::string text = "\"";
      for (const std::uint8_t c : bytes.subspan(field.offset, field.size)) {
        if (c == 0) break;
        if (c == '"' || c == '\\') text += '\\';
        text += c < 0x20 || c > 0x7e ? '?' : static_cast<char>(c);
      }
      return text + '"';
    }
    case FieldKind::float32:
    case FieldKind::float64:
      return fmt::format("{}", number_in(bytes, field));
    default:
      return fmt::format("{}", integer_in(bytes, field));
  }
}

}  // namespace mrroc
