/// The files that a request asks for, a signed one or one that the staff's buttons confirmed: a copy of this machine's
/// exhibit, for a person to read and for another kiosk to take.
///
/// Names    settings.toml, calibration.toml and counts.csv are for a person; kiosk.fsk is the same for a kiosk
///          (kiosk_copy.h); packs are NUMBER-ID.fspack, in the order of the set that is shown.
/// Persons  a copy by the buttons is unsigned, so its settings lose their comments, which may name people.
/// Threads  the main one; reads files.
/// Errors   one sentence.
#pragma once

#include "app/kiosk_copy/copy_request.h"
#include "app/report/write_report.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::programs {

struct CopyPlaces {
    std::filesystem::path stick; ///< with the request; empty: no request
    bool confirmed = false;      ///< by the staff's buttons, where the request waits for them
    std::filesystem::path config;
    std::filesystem::path counts;
    std::filesystem::path calibration = "/var/lib/frustumscreen/calibration";
    std::filesystem::path library = "/var/lib/frustumscreen/library";
};

/// None: the stick asks for no copy. `clock`: the machine's day.
[[nodiscard]] tl::expected<std::optional<kiosk_copy::CopyRequest>, library::ImportFailure>
copy_asked_for(const CopyPlaces& places, std::chrono::sys_days clock);

struct CopyFiles {
    std::vector<report::ReportFile> texts;
    std::unique_ptr<WritableTree> library; ///< in which the packs are; may be null without packs
    std::vector<report::CopiedFile> packs;
};
[[nodiscard]] Result<CopyFiles> copy_files(const kiosk_copy::CopyRequest& request, const CopyPlaces& places);

} // namespace frustumscreen::programs
