/// How large a scan is, and an estimate of what a bake makes of it, without simplifying it or casting rays.
///
/// Estimate   does not depend on the turn, which a bake chooses by itself; docs/measurements.md says how well it hits
///            ("What a check estimates").
/// Errors     those of the bake that do not need its work: no extent, no surface.
/// Threads    pure; any.
#pragma once

#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string_view>

namespace frustumscreen::bake {

struct ScanMeasures {
    std::size_t points = 0;                ///< different ones that triangles use
    glm::dvec3 extents{0.0};               ///< of the bounding box, in the file's axes and units
    std::uint64_t estimated_bytes = 0;     ///< of the pack, without texts and speech
    std::uint64_t estimated_triangles = 0; ///< of the level that is usually shown
};

[[nodiscard]] Result<ScanMeasures> measure_scan(const SourceMesh& mesh, const BakeOptions& options);

/// The unit, "m", "cm" or "mm", in which a museum object of this longest extent is most likely measured; empty if no unit
/// makes it between 5 mm and 20 m. `format` is that of SourceContents: glTF means metres, and is believed if it can be.
[[nodiscard]] std::string_view guessed_unit(std::string_view format, double longest);

} // namespace frustumscreen::bake
