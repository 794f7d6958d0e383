/// Time, memory and pack of bakes against the number of source triangles. Each scan is made, and baked, by a program of its
/// own, so that the memory is that of a bake alone.
///
/// Errors   a program that cannot be started, or fails: its sentence.
/// Threads  one caller; waits for the programs.
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::bench {

/// The figures of one bake, from its own report (`frustumscreen-bake --json`).
struct ScalingBake {
    std::uint64_t triangles = 0; ///< of the scan
    std::uint64_t scan_bytes = 0;
    double seconds = 0.0;
    double processor_seconds = 0.0;
    std::uint64_t memory_bytes = 0; ///< peak
    std::uint64_t pack_bytes = 0;
    double shown_mean_mm = 0.0; ///< mean error of the level that is usually shown
    double min_mean_mm = 0.0;   ///< of the finest level
    std::size_t levels = 0;
};

/// Makes the built-in amphora of about `triangles` triangles in `folder`, bakes it, and removes both files.
/// `programs`: the folder of frustumscreen-artifact and frustumscreen-bake.
[[nodiscard]] Result<ScalingBake> bake_of_amphora(std::int64_t triangles, int size,
                                                  const std::filesystem::path& programs,
                                                  const std::filesystem::path& folder);
/// The same of a scan's file, which stays.
[[nodiscard]] Result<ScalingBake> bake_of_file(const std::filesystem::path& scan, int size,
                                               const std::filesystem::path& programs,
                                               const std::filesystem::path& folder);
[[nodiscard]] Result<ScalingBake> scaling_bake_from(std::string_view report_json);

[[nodiscard]] std::string bakes_csv(std::span<const ScalingBake> bakes);
/// With a line for each limit that a bake of this size has.
[[nodiscard]] std::string bakes_table(std::span<const ScalingBake> bakes);

} // namespace frustumscreen::bench
