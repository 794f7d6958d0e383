/// An artifact's hotspots as pictures: their labels in each language that is shown, and the thin lines that lead to them.
///
/// Frames   table T, metres.
/// Threads  the render thread, with the display's context current. `place` allocates nothing.
/// Errors   the driver has no memory. A label that the bake could not set is not there.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/pack/pack.h"
#include "app/pack/pack_texts.h"
#include "app/render/gpu_store.h"
#include "app/show/on_table.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// The labels of one artifact.
struct HotspotPictures {
    HotspotSet set;                               ///< for the exhibit
    std::vector<std::vector<TextureId>> textures; ///< [hotspot][language]
    std::uint64_t planned_gpu_bytes = 0;
    void release(GpuStore& store);
};

struct HotspotRequest {
    std::span<const std::string> languages; ///< the artifact's, as the catalogue has them
    std::span<const SetLanguage> texts;
    double metres_per_box = 1.0;
    double em_m = 0.010;
    double texels_per_m = 2400.0;
};
[[nodiscard]] Result<HotspotPictures> upload_hotspots(std::span<const PackHotspot> hotspots,
                                                      const HotspotRequest& request, GpuStore& store);

/// What says which points a level hides, in the box frame.
[[nodiscard]] ArtifactTriangles hiding_triangles(const PackLevel& level, const glm::dvec3& box_size,
                                                 double metres_per_box);

/// Lays labels and lines on the table.
class HotspotShow {
public:
    HotspotShow() = default; ///< draws no lines
    [[nodiscard]] static Result<HotspotShow> create(GpuStore& store);

    /// `brightness`: of its texts.
    void place(const PresentedHotspot& hotspot, const HotspotPictures& pictures, double brightness,
               const Pinhole& projector, const RigidTransform& table_from_projector, OnTable& on_table) const;
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const { return planned_gpu_bytes_; }

private:
    TextureId line_ = TextureId::None; ///< soft on all sides
    std::uint64_t planned_gpu_bytes_ = 0;
};

} // namespace frustumscreen
