/// An artifact's hotspots on the table: a label and the thin line that leads to it.
///
/// Frames   table T, metres.
/// Threads  the render thread, with the display's context current. `place` allocates nothing.
/// Errors   the driver has no memory.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/pack/pack.h"
#include "app/render/gpu_store.h"
#include "app/residency/on_table.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::residency {

/// The triangles that decide which points a level hides, in the box frame.
[[nodiscard]] exhibit::ArtifactTriangles hiding_triangles(const pack::PackLevel& level,
                                                          const glm::dvec3& box_size, double metres_per_box);

/// Lays labels and lines on the table.
class HotspotShow {
public:
    HotspotShow() = default; ///< draws no lines
    [[nodiscard]] static Result<HotspotShow> create(render::GpuStore& store);

    /// `label`: the label's picture. `brightness`: of the texts.
    void place(const exhibit::PresentedHotspot& hotspot, scene::TextureId label, double brightness,
               const geometry::Pinhole& projector, const geometry::RigidTransform& table_from_projector,
               OnTable& on_table) const;
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const { return planned_gpu_bytes_; }

private:
    scene::TextureId line_ = scene::TextureId::None; ///< transparent towards its edges
    std::uint64_t planned_gpu_bytes_ = 0;
};

} // namespace frustumscreen::residency
