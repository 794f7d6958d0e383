/// The label of a hotspot: its place beside the prop, the line that leads to it, and the brightness of both.
///
/// Shows one hotspot at a time. The label is dark exactly where the hotspot's point faces away from the eye. It fades
/// where another part of the artifact hides the point, where the place of the prop through which it is seen is not
/// lit, and when another hotspot is shown.
///
/// Frames   as named; metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: a label without space, or without a way for its line, is not shown.
#pragma once

#include "app/exhibit/leader_line.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/geometry/triangle_tree.h"
#include "app/typography/captions.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

struct LabelledHotspot {
    Hotspot at; ///< prop frame
    /// By CatalogueEntry::languages; the height is 0 if there is no label in a language.
    std::vector<glm::dvec2> label_sizes_m;
};

/// The surface that hides an artifact's points.
struct ArtifactTriangles {
    std::shared_ptr<const geometry::TriangleTree>
        tree;                 ///< in the box frame (pack.h); none: nothing is hidden
    double tolerance_m = 0.0; ///< at least the triangles' error
};

/// The hotspots of one artifact.
struct HotspotSet {
    std::vector<LabelledHotspot> hotspots;
    ArtifactTriangles triangles; ///< set while the artifact is loaded
    double metres_per_box = 1.0;
};

struct PresentedHotspot {
    std::size_t artifact = 0; ///< index into the catalogue
    std::size_t hotspot = 0;  ///< index into HotspotSet::hotspots
    std::size_t language = 0; ///< index into CatalogueEntry::languages
    typography::TableRectangle label;
    std::optional<LeaderLine> line;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
};

class HotspotLabels {
public:
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(200); ///< fade out, or fade in

    explicit HotspotLabels(std::span<const glm::dvec2> area) : placer_(area) {}

    struct Input {
        const HotspotSet* set = nullptr; ///< of the artifact that is shown
        std::size_t artifact = 0;
        std::optional<std::size_t> hotspot; ///< nothing: none is to be shown
        std::size_t language = 0;
        double brightness = 1.0; ///< of the artifact and of its texts
        const geometry::PropShape* prop = nullptr;
        geometry::RigidTransform table_from_prop;
        glm::dvec3 eye_m{0.0};                                 ///< table frame
        glm::dvec3 lens_m{0.0};                                ///< table frame
        std::span<const geometry::Plane> picture_edges;        ///< as LitPlaces
        std::span<const typography::TableRectangle> obstacles; ///< everything else on the table
        std::optional<typography::TableRectangle> caption;     ///< also in `obstacles`
        int quarter_turns = 0;                                 ///< the reader's side
    };
    [[nodiscard]] std::optional<PresentedHotspot> step(MonotonicTime now, const Input& input);
    /// True while a brightness changes by itself.
    [[nodiscard]] bool changing() const { return changing_; }

private:
    struct Key {
        std::size_t artifact = 0;
        std::size_t hotspot = 0;
        std::size_t language = 0;
        [[nodiscard]] bool operator==(const Key&) const = default;
    };
    [[nodiscard]] static std::optional<Key> wanted(const Input& input);
    void keep_clear(const Input& input);
    void turn_to(const std::optional<Key>& key, const Input& input);

    typography::CaptionPlacer placer_;
    std::optional<Key> key_; ///< the one that the placer holds
    double presence_ = 0.0;  ///< 0..1
    std::optional<MonotonicTime> last_;
    bool changing_ = false;
};

/// The prop's faces that are turned to the lens, as a set.
[[nodiscard]] std::uint32_t faces_lit_from(const geometry::PropShape& prop, const glm::dvec3& lens_in_prop_m);

} // namespace frustumscreen::exhibit
