/// Bakes a source mesh into a pack: makes levels of simplified mesh, measures them and keeps the Pareto
/// front; and bakes layered relief for rasterization.
///
/// Frame    in: the file's; out: the box (pack.h).
/// Errors   one line for the curator.
/// Threads  uses all cores; `progress` is called on the caller's thread.
/// Memory   about 0.4 kB for each of a million source triangles or more, and 30 B for each texel of an atlas; the caller
///          reduces a larger scan first (reduce_scan.h).
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack.h"
#include "app/pack/pack_torches.h"
#include "assets_baked/bake/hotspots.h"
#include "assets_baked/bake/part_light.h"
#include "assets_baked/bake/source_mesh.h"
#include "assets_baked/bake/visibility.h"
#include "firmware_host/base/result.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bake {

/// The kind of prop that a pack is baked for, in any size.
struct BakedProp {
    std::string kind;
    geometry::PropShape shape; ///< of the usual size, which decides which errors a visitor would notice
    ViewingZone zone;
};
/// Stands on the table.
[[nodiscard]] BakedProp baked_frustum();
/// Held in the hand: seen from all around, also from below.
[[nodiscard]] BakedProp baked_cube();
/// A prop of any shape in the hand. Its pack is one for a cube; which errors a visitor would notice is decided by this shape.
[[nodiscard]] BakedProp baked_solid(geometry::PropShape shape);

/// A step of a bake that `progress` names, and the share of the whole work that is done when it begins, as measured with the
/// amphora of a million triangles.
struct BakeStage {
    std::string_view name;
    double begin = 0.0;
};
namespace stages {
inline constexpr BakeStage surface{"reading the surface", 0.0};
inline constexpr BakeStage seen{"what visitors can see", 0.07};
inline constexpr BakeStage levels{"simplified levels", 0.19};
inline constexpr BakeStage colours{"colours", 0.31};
inline constexpr BakeStage light{"light", 0.44};
inline constexpr BakeStage relief{"relief to be cast", 0.55};
inline constexpr BakeStage choice{"choice of the level", 0.92};
inline constexpr std::array all{surface, seen, levels, colours, light, relief, choice};
} // namespace stages

struct BakeOptions {
    int size = 512; ///< texels along the longest edge of a face, 16..4096
    bool unlit = false;
    bool relief = true; ///< the pack contains layered relief (measured_reliefs.h)
    bool far = false;   ///< and coarser ones, for the screen behind the table
    bool of_site =
        false; ///< the mesh is a region of a site, in which it is also seen small: coarser levels are kept
    BakedProp prop = baked_frustum();
    std::string up;            ///< empty: the format's own up axis
    double turn_deg = 0.0;     ///< about the vertical axis, counter-clockwise seen from above; best_turn.h
    double lift = 0.0;         ///< above the prop's bottom, in heights of the artifact
    double scale = 1.0;        ///< relative to the largest size inside the prop
    bool table_picture = true; ///< a picture to lie on the table; a part of an artifact needs none
    /// Share of the points and rays for measurements, 0..1: with fewer, a pack's errors are less exact.
    double measuring = 1.0;
    std::vector<GivenHotspot> hotspots;
    /// The contents of a torch, without the layers' parts: those of the mesh's layers are added, one for each
    /// and in their order, so also to an artifact without contents.
    pack::PackTorches torches;
    pack::TorchParts torch_parts;
    std::optional<PlaceInWhole> part; ///< the mesh is a part, which the whole shadows; none: it is the whole
    /// Called with the current step and the share of the whole work that is done, 0..1.
    std::function<void(std::string_view step, double done)> progress = [](std::string_view, double) {};
};

/// The caller fills in id, title, languages, captions and provenance.
[[nodiscard]] Result<pack::Pack> bake(const SourceMesh& mesh, const BakeOptions& options);

/// Disk space in bytes that a pack of this size (texels) may need. The largest pack measured, a helmet of
/// seven levels at 512, had 31 MB; this is about twice as much, and never more than a pack's limit.
[[nodiscard]] std::uintmax_t space_for_pack(int size);

/// Texels of a scan's pictures, all together, beyond which a pack of this size shows no more of them. The largest atlas
/// has 4 x 4 times `size` squared texels, each of which is the mean of four; 16 times as many as its texels allow for
/// pictures that are used in part.
[[nodiscard]] std::int64_t useful_picture_texels(int size);

} // namespace frustumscreen::bake
