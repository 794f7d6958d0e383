/// Properties of a scan and of its bake, in columns: `frustumscreen-bake --check` prints them, and the report of a
/// batch has the same.
///
/// Threads  pure; any.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

struct ScanSummary {
    std::string format; ///< empty: the scan was not read
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;               ///< different points
    std::vector<std::array<int, 2>> pictures; ///< width and height, texels, as in the files
    std::uint64_t materials = 0;
    bool has_colours = false; ///< at its vertices
    bool has_normals = false;
    std::array<double, 3> extents{}; ///< file units
    std::string unit;                ///< guessed: "m", "cm", "mm"; empty: none fits
    std::uint64_t estimated_bytes = 0;
    std::uint64_t estimated_triangles = 0; ///< of the level that is usually shown
    std::uint64_t lost = 0;                ///< number of losses
};

struct ScanColumn {
    std::string_view key;                                    ///< for programs
    std::string_view heading;                                ///< for people
    bool is_text = false;                                    ///< aligned to the left
    std::string (*plain)(const ScanSummary& scan) = nullptr; ///< for programs
    std::string (*shown)(const ScanSummary& scan) = nullptr; ///< for people
};
[[nodiscard]] std::span<const ScanColumn> scan_columns();

/// The columns by their keys, except `lost`, which stands beside it as sentences.
[[nodiscard]] nlohmann::ordered_json json_of(const ScanSummary& scan);
/// Throws an exception of the JSON library if a column is missing or of another type.
[[nodiscard]] ScanSummary summary_from(const nlohmann::ordered_json& json);

} // namespace frustumscreen::programs
