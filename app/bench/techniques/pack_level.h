/// A level or a relief of a pack, drawn by the exhibit's own plan and renderer, as a technique of the bench.
///
/// Cost     the plan is made again for every picture: it is part of the frame.
/// Threads  the one whose context is current; the pack and kiosk must outlive the technique.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/pack/pack_file.h"
#include "app/render/renderer.h"

#include <memory>

namespace frustumscreen::bench {

/// Options of the exhibit's renderer for the pictures that are measured.
struct PictureOptions {
    int samples = 0; ///< per pixel; 0 = the pack's own number
    /// Even light and exposure, as visitors see it; otherwise the colours of the ray cast.
    bool lit = false;
    bool timed_lit = false; ///< lit only while it is timed
    bool feathered = true;  ///< of a lit picture; false: sharp edges between faces, for comparison
    /// Both eyes in the settings' layout, of a head that looks at the prop; the framebuffer has the layout's size.
    bool both_eyes = false;
    /// As the exhibit, draws only what changed since the technique's last picture, which the framebuffer must still hold;
    /// otherwise every picture is drawn whole.
    bool only_changes = false;
};

[[nodiscard]] Result<std::unique_ptr<Technique>> make_pack_level(const Kiosk& kiosk, const pack::Pack& pack,
                                                                 std::uint32_t level,
                                                                 const PictureOptions& options,
                                                                 std::string name);

/// A relief in the pack's box, rasterized as in the exhibit, or drawn by the GPU if `on_gpu`. `seen`: the
/// pack's own errors of it, if it has any.
[[nodiscard]] Result<std::unique_ptr<Technique>>
make_pack_relief(const Kiosk& kiosk, const pack::Pack& pack,
                 std::shared_ptr<const relief::BlockRelief> relief, std::optional<scene::SeenLevel> seen,
                 const PictureOptions& options, std::string name, bool on_gpu = false);

} // namespace frustumscreen::bench
