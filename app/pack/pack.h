/// The contents of a pack, in memory. FORMAT.md defines the bytes.
///
/// Frames   box: the artifact turned so that its up axis is +Z, its bounding box centred on the Z axis and
///          standing on z = 0, scaled so that the box's longest edge is 1. One pack serves every prop: the
///          placement into the prop is computed from the configured prop when it is loaded.
/// Errors   stored in box units; times the placement's scale they are metres on the configured prop.
/// Threads  values; any.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace frustumscreen::pack {

/// The artifact's texts in one language. All but the language may be empty.
struct PackCaption {
    std::string language; ///< BCP 47
    std::string title;
    std::string text;
    std::string period{};
    std::string place{};
    std::string maker{};
    std::string credit{};      ///< the line that names the owner
    std::string description{}; ///< for listeners: what there is to see

    [[nodiscard]] bool operator==(const PackCaption&) const = default;
};

struct PackLabel {
    std::string language; ///< BCP 47
    std::string text;

    [[nodiscard]] bool operator==(const PackLabel&) const = default;
};

/// A point of the artifact with a label.
struct PackHotspot {
    glm::dvec3 point{0.0};            ///< on the surface, box frame
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< of the surface there: unit, outward, box frame
    std::vector<PackLabel> labels;

    [[nodiscard]] bool operator==(const PackHotspot&) const = default;
};

/// A section without a member in this description, interpreted by the code that knows its name.
struct PackSection {
    std::string name;
    std::string data = "{}";        ///< a JSON object, keys in order, without white space
    std::vector<std::string> parts; ///< names; their bytes are read separately (pack_sections.h)

    [[nodiscard]] bool operator==(const PackSection&) const = default;
};

struct PackProvenance {
    std::string source_name;   ///< file name without folders
    std::string source_sha256; ///< hexadecimal, over the file named
    std::string licence;       ///< SPDX expression or free text; empty: not stated
    std::uint64_t source_triangles = 0;

    [[nodiscard]] bool operator==(const PackProvenance&) const = default;
};

/// The direction from which a chart of the relief is seen: the normals of a prop's box.
/// In-plane axes (u, v): +-X: (y, z); +-Y: (x, z); +-Z: (x, y).
enum class ReliefDirection : std::uint8_t { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

/// A rectangle of the atlas that holds one piece of the layered relief.
struct ReliefChart {
    ReliefDirection direction = ReliefDirection::PlusZ;
    std::uint16_t x = 0, y = 0, width = 0, height = 0; ///< texels in the atlas
    float u0_box = 0.0F, v0_box = 0.0F;                ///< in-plane position of the centre of texel (x, y)
};

/// Layered relief (layered depth images in the directions of the prop's faces; Kim 2008, Shade 1998) as one
/// packed atlas.
/// relief: coordinate along the direction's axis, 0: box minimum, 65534: box maximum, 65535: empty.
struct ReliefAtlas {
    float texel_box = 0.0F; ///< edge of a texel, box units
    std::vector<ReliefChart> charts;
    image::Image16 relief;
};

/// position: 0..65535 over the box's extent on each axis. uv: 0..65535 over the level's colour texture.
struct PackVertex {
    std::array<std::uint16_t, 3> position{};
    std::uint16_t reserved = 0;
    std::array<std::uint16_t, 2> uv{};
};
static_assert(sizeof(PackVertex) == 12);

/// A run of triangles that are drawn or culled together (box frame).
struct PackCluster {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0; ///< multiple of 3
    glm::vec3 centre{0.0F};
    float radius = 0.0F;
    /// Back-facing from an eye e if dot(normalize(cone_apex - e), cone_axis) >= cone_cutoff.
    /// A cut-off above 1: never back-facing.
    glm::vec3 cone_apex{0.0F};
    glm::vec3 cone_axis{0.0F, 0.0F, 1.0F};
    float cone_cutoff = 2.0F;
};

enum class LevelTechnique { Relief, Mesh };

/// Distance between a level's surface and the source's, both ways, over the surface that a visitor can see.
/// Box units.
struct LevelError {
    float mean_box = 0.0F;
    float p95_box = 0.0F;
    float max_box = 0.0F;
    float colour_rmse = 0.0F; ///< 8-bit sRGB codes against the source's colour, 0..255

    [[nodiscard]] bool operator==(const LevelError&) const = default;
};

/// One mesh of the artifact, at one cost: clusters of counter-clockwise triangles with one colour texture.
struct PackLevel {
    LevelTechnique technique = LevelTechnique::Mesh;
    LevelError error;
    std::uint32_t texture = 0; ///< index into Pack::textures
    std::vector<PackVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<PackCluster> clusters; ///< cover `indices` in order, without gaps
};

/// A pack without its pictures and triangles.
struct PackDescription {
    std::string id; ///< of the artifact, the same in each pack that replaces another; empty: none
    std::string title;
    std::vector<std::string> languages;
    std::vector<PackCaption> captions;
    std::vector<PackHotspot> hotspots;
    std::vector<PackSection> sections;
    PackProvenance provenance;
    std::string prop_kind = "frustum"; ///< the prop whose directions were used to bake the relief
    bool unlit = false;
    /// Samples per pixel that keep this artifact's outlines and texture smooth, as measured by the bake: 1, 2, 4
    /// or 8.
    int samples = 4;
    int relief_size = 0;              ///< --size: texels along the longest edge of a face
    glm::dvec3 box_size{1.0};         ///< extents; the longest is 1
    glm::dmat4 box_from_file{1.0};    ///< the file's own coordinates (glTF: scene) to the box
    std::vector<glm::dvec3> extremes; ///< box frame: outermost vertices, for the largest scale inside a prop
    double scale = 1.0;               ///< relative to the largest size inside the prop
    std::uint32_t default_level = 0;

    [[nodiscard]] bool operator==(const PackDescription&) const = default;
};

struct Pack : PackDescription {
    std::vector<image::Image8> textures; ///< sRGB colour
    ReliefAtlas relief;                  ///< empty if no level is a relief
    std::vector<PackLevel> levels;       ///< coarse to fine
    /// The artifact cut out, for the table; empty: none. Not read with chosen levels: see load_pack_card.
    image::Image8 table_picture;
    /// Bytes of the sections' parts, by name; empty if only some levels were chosen.
    std::map<std::string, std::vector<std::byte>> section_parts;
};

} // namespace frustumscreen::pack
