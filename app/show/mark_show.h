/// A drift mark on the table, by which a camera measures whether the picture has moved (app/drift): small, soft, dim,
/// and shown for half a second. It overlaps nothing that visitors are shown.
///
/// Frames   table T, metres.
/// Threads  the render thread. Allocates nothing after `prepare`.
#pragma once

#include "app/drift/drift_watch.h"
#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "app/residency/on_table.h"
#include "app/settings/settings.h"

#include <optional>

namespace frustumscreen::show {

inline constexpr double mark_size_m = 0.016;    ///< across
inline constexpr double mark_brightness = 0.25; ///< fraction of the projector's light, in its middle

/// True if a mark is clear of the prop and of everything lit. `prop_m`: reach of the prop from its axis.
[[nodiscard]] bool has_space_for_mark(const glm::dvec2& place_m, const exhibit::Presentation& presentation,
                                      double prop_m);

class MarkShow {
public:
    /// Call before the first frame.
    [[nodiscard]] Result<void> prepare(render::GpuStore& store);
    void place(const std::optional<drift::ShownMark>& mark, residency::OnTable& on_table) const;
    [[nodiscard]] scene::TextureId texture() const { return texture_; }
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const;

private:
    scene::TextureId texture_ = scene::TextureId::None; ///< none: no camera uses marks
};

} // namespace frustumscreen::show
