/// The files of a report on this machine's exhibit.
///
/// Names    none of a person: comments and keys of the settings are left out, and so are the label of the latest
///          stick and the serial numbers of USB devices.
/// Threads  the main one; reads files, and starts journalctl.
/// Errors   none: a file that cannot be made says why.
#pragma once

#include "app/report/write_report.h"
#include "app/status/known_exhibit.h"

#include <filesystem>
#include <vector>

namespace frustumscreen::programs {

struct ReportPlaces {
    std::filesystem::path config = "/etc/frustumscreen/kiosk.toml";
    std::filesystem::path counts = "/var/lib/frustumscreen/counts";
    std::filesystem::path faults = "/var/lib/frustumscreen-watchdog/faults";
    std::filesystem::path journal; ///< folder; empty: this machine's own
    status::StatusPlaces status;
};

/// The texts of a report, the shortest file first.
[[nodiscard]] std::vector<report::ReportFile> report_files(const ReportPlaces& places);

} // namespace frustumscreen::programs
