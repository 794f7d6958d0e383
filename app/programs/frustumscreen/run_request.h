/// The options of `frustumscreen run`.
///
/// Threads  the main one.
#pragma once

#include "app/programs/frustumscreen/run_mode.h"
#include "app/show/artifact_show.h"
#include "app/show/installed_show.h"

#include <filesystem>
#include <optional>

namespace frustumscreen::programs {

struct RunRequest {
    RunPlaces places;
    std::filesystem::path out;
    std::filesystem::path status_file;
    std::filesystem::path staff_socket;
    std::filesystem::path calibrate_file;
    std::filesystem::path reset_file;
    std::filesystem::path copy_file;
    std::filesystem::path record;
    show::ArtifactShowOptions show;
    show::Trust trust = show::Trust::Newest; ///< in the installed sets
    double seconds = 0.0;                    ///< 0: until stopped
    int stills = 8;
    int changes = 0;
    bool headless = false;
    bool fast = false;
    bool pattern = false;
    bool full_redraw = false;
    bool json = false;
};

/// Reads the arguments after 'run'. Returns the exit status if the program ends there, as CommandLine.
[[nodiscard]] std::optional<int> read_run_arguments(int argc, const char* const* argv, RunRequest& request);

} // namespace frustumscreen::programs
