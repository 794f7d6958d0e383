/// The result of an object's bake, next to its pack: NAME.stamp, JSON. It tells a later run what is done, and
/// what to report.
///
/// Errors   an unreadable stamp is ignored: the object is baked again.
/// Threads  any.
#pragma once

#include "app/programs/batch/scan_summary.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::programs {

/// Status of an object at the end of a run.
enum class BatchStatus : std::uint8_t { Baked, Unchanged, Failed, Missing };
/// "baked", "unchanged", "failed", "missing".
[[nodiscard]] std::string_view name_of(BatchStatus status);

/// A row of the report.
struct BatchRow {
    std::string object;
    BatchStatus status = BatchStatus::Missing;
    double seconds = 0.0; ///< duration of the bake
    std::string sentence; ///< why it failed
    std::string title;
    std::size_t levels = 0;
    std::uint64_t bytes = 0;                               ///< size of the pack
    double mean_mm = 0.0, p95_mm = 0.0, colour_rmse = 0.0; ///< errors of the default level
    std::size_t silent = 0;                                ///< descriptions without speech
    bool has_page = false;
    ScanSummary scan{};
};

struct Stamp {
    std::string key;         ///< hash of the object, the program and the options
    std::string pack_sha256; ///< empty: the bake failed
    BatchRow row;
};

[[nodiscard]] std::optional<Stamp> read_stamp(const std::filesystem::path& file);
[[nodiscard]] Result<void> write_stamp(const std::filesystem::path& file, const Stamp& stamp);

/// Fills in the output of `frustumscreen-bake --json`; returns false for anything else.
[[nodiscard]] bool take_bake_report(std::string_view json, BatchRow& row);

} // namespace frustumscreen::programs
