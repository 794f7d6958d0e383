/// A level of a pack, or a relief, through the exhibit's own plan and renderer, as the bench sees it.
///
/// Cost     the plan is made anew for every picture: it is part of the frame.
/// Threads  the one whose context is current; the pack and stage must outlive the technique.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/pack/pack_file.h"
#include "app/render/renderer.h"

#include <memory>

namespace frustumscreen {

/// Options of the exhibit's renderer for the pictures that are measured.
struct PictureOptions {
    int samples = 0; ///< a pixel; 0 = what the pack asks for
    /// Even light and exposure, as visitors see it; else the colours are those of the ray cast.
    bool lit = false;
    bool timed_lit = false; ///< only when it is timed
    bool feathered = true;  ///< of a lit picture; false: sharp edges between faces, to be compared with
};

[[nodiscard]] Result<std::unique_ptr<Technique>> make_pack_level(const Stage& stage, const Pack& pack,
                                                                 std::uint32_t level,
                                                                 const PictureOptions& options,
                                                                 std::string name);

/// A relief in the pack's box, cast as the exhibit casts it, or `on_gpu` as it has the GPU draw it. `seen`: what the pack says of its errors;
/// nothing: it says nothing.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_pack_relief(const Stage& stage, const Pack& pack,
                                                                  std::shared_ptr<const BlockRelief> relief,
                                                                  std::optional<SeenLevel> seen,
                                                                  const PictureOptions& options,
                                                                  std::string name, bool on_gpu = false);

} // namespace frustumscreen
