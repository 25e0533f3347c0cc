#pragma once

#include <string>

#include "adaptive_quadrotor_control/flight/flight_log.h"

namespace aqc {

/// The flight as CSV (RFC 4180): one header line with the names of flightColumns(), then a line a
/// sample. Numbers have as many digits as bring back the same bits; not-a-number is an empty field.
/// A flight that crashed has two more columns, the same in every line: crash_time [s],
/// crash_reason.
std::string flightCsv(const FlightLog& log);

/// The flight whose flightCsv() is `text`, bit for bit: samples, names of adaptive quantities and
/// the crash; not `controller`, the units of adaptive quantities (empty), `refusals`, `dwell_time`
/// and `real_time_factor`, which the file does not tell. What belongs to a set point is that of a
/// new sample while none is active. Line ends may be those of Windows. Throws std::runtime_error,
/// naming `file`, line and column, the value and what is expected, when a column is missing or
/// unknown, a line has too few or too many fields, a field is no number, times do not grow or
/// nothing is there.
FlightLog parseFlightCsv(const std::string& text, const std::string& file);

/// The same from a file; its name is the controller's, as fly writes it. Throws std::runtime_error.
FlightLog readFlightCsv(const std::string& path);

}  // namespace aqc
