// The fields of a message, known at run time: for logs, tables and comparisons. Made from the definitions of
// the messages, so that a new message is known without another line of code. Not for the servo step.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mrroc {

/// Kind of a field. text: an array int8_t[n], n > 1, of characters that ends with the first zero.
enum class FieldKind : std::uint8_t { int8, int16, int32, int64, byte, float32, float64, text };

/// One number or text of a message.
struct Field {
  std::string name;      ///< "header.stamp", "arm.axis[2].velocity"
  FieldKind kind{};      ///< of the number, or text
  std::size_t offset{};  ///< from the beginning of the message on the wire [bytes]
  std::size_t size{};    ///< [bytes]
};

/// Unit in which a message tells the simulated time that it is for. none: it is for no time.
enum class TimeUnit : std::uint8_t { none, steps, macrosteps };

/// One type of messages.
struct MessageType {
  std::string name;            ///< "agent_order_t"
  std::int64_t fingerprint{};  ///< LCM's, at the beginning of every message on the wire
  std::size_t size{};          ///< of a message on the wire, fingerprint included [bytes]
  std::vector<Field> fields;   ///< all of them, arrays and nested messages taken apart, in their order
  TimeUnit time_unit{};        ///< of the field `time`
  std::string time;            ///< name of the field that tells the simulated time; empty: it is for no time

  /// @return the field with that name, or null
  [[nodiscard]] const Field* field(std::string_view field_name) const;
};

/// @param package_text  a definition: lines of a .lcm file with fields of fixed size
/// @param known         types that it may be made of
/// @return the type, without its fingerprint. The line of the header ends with "// time: FIELD [UNIT]", such as
///         "header.stamp [macrosteps]" or "motion.step [steps]", or with "// time: none"
/// @throws FaultError internal_error when a line is no field of fixed size, a type is not known, or the type has a header
///         whose line does not tell the time
[[nodiscard]] MessageType parse_message_type(std::string_view package_text,
                                             std::span<const MessageType> known);

/// @return every message of the project, by name
[[nodiscard]] const std::vector<MessageType>& message_types();

/// @return the type of the bytes, from their fingerprint and their size, or null when they are none
[[nodiscard]] const MessageType* type_of(std::span<const std::uint8_t> bytes);

/// @param bytes  a message that has the field @return its value; NaN for a text
[[nodiscard]] double number_in(std::span<const std::uint8_t> bytes, const Field& field);

/// @return its value so that it can be read back exactly; a text in quotation marks
[[nodiscard]] std::string value_in(std::span<const std::uint8_t> bytes, const Field& field);

}  // namespace mrroc
