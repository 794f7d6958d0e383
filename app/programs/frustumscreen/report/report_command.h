/// `frustumscreen report`: collects a report for the makers of a kiosk, as files in a folder.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'report'. Exit status: 0 it is written; 1 it is not; 2 wrong use.
[[nodiscard]] int report_command(int argc, char** argv);

} // namespace frustumscreen::programs
