/// Texts of a kiosk as they go to the makers: short enough, readable, without what names a person's device.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace frustumscreen::report {

/// A journal's lines, as journalctl prints them: the newest, at most `max_bytes`, without those that have the serial
/// number of a USB device or the label of a disk.
[[nodiscard]] std::string shared_journal(std::string_view journal, std::size_t max_bytes);

/// The watchdog's ring of faults (watchdog/fault_book.h), which is written in turn: its lines in the order of their
/// numbers, without the blanks that pad them.
[[nodiscard]] std::string faults_in_order(std::string_view ring);

} // namespace frustumscreen::report
