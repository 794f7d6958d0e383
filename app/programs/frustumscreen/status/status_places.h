/// The options that say where the status of an exhibit is read, for each command that reads it.
///
/// Threads  the main one.
#pragma once

#include "app/programs/common/command_line.h"
#include "app/status/known_exhibit.h"

namespace frustumscreen::programs {

/// The defaults are those of `places`.
inline void add_status_places(CommandLine& app, status::StatusPlaces& places) {
    app.add_option("--status-file", places.status_file, "the exhibit's status file").capture_default_str();
    app.add_option("--watchdog-file", places.watchdog_file, "the watchdog's status file")
        .capture_default_str();
    app.add_option("--boot-folder", places.boot_folder, "folder of what the appliance's start has reported")
        .capture_default_str();
    app.add_option("--crash-folder", places.crash_folder, "folder of crash records").capture_default_str();
}

} // namespace frustumscreen::programs
