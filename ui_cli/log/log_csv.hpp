// `ui_cli log csv`: the messages of one channel as a table.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Writes `t` and the fields of every message of the channel, a row per message: t in seconds of simulated time,
/// empty where the channel tells no time; numbers so that they can be read back exactly.
/// @param fields  names of fields, or beginnings of names such as "F_a"; empty: all
/// @param json    an array of objects instead
/// @throws FaultError bad_usage: no such channel or field
void write_channel(const RunRecord& run, const std::string& channel, const std::vector<std::string>& fields,
                   bool json, std::ostream& out);

/// Writes what a log holds: channel, type, number of messages, first and last time.
void write_channels(const RunRecord& run, bool json, std::ostream& out);

}  // namespace mrroc::ui
