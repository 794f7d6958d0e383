/// Selects the triangles of a level that may show on one face of the prop: clusters first, then triangle by
/// triangle.
///
/// A software renderer or a small GPU spends more on a triangle that it discards than this code spends on
/// finding it: about half of a level faces away from the eye, and each face of the prop shows a different
/// part of the rest.
///
/// Frames   box (pack.h).
/// Threads  pure; any. Allocates nothing if `indices` has the capacity.
#pragma once

#include "app/geometry/per_corner.h"
#include "app/pack/pack.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::scene {

/// A triangle this close to edge-on is kept, because the planes are in single precision and the positions
/// quantised.
inline constexpr float edge_on_box = 1e-5F;

/// A level's triangles as culling needs them; made once, when the level is loaded.
struct LevelTriangles {
    struct Extent {
        glm::vec3 low{0.0F}, high{0.0F};
    };
    std::vector<pack::PackCluster> clusters;
    std::vector<Extent> extents; ///< of the clusters
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec3> positions; ///< of the vertices
    /// For each triangle: n.X = d, with n the outward unit normal, as four arrays. A triangle without area
    /// counts as facing everywhere.
    std::vector<float> normal_x, normal_y, normal_z, distance;
};
/// Bytes of main memory.
[[nodiscard]] std::uint64_t bytes_of(const LevelTriangles& level);
/// Computes the planes from indices and positions.
void find_planes(LevelTriangles& level);
/// Computes the extents from clusters, indices and positions.
void find_extents(LevelTriangles& level);
[[nodiscard]] LevelTriangles triangles_of(const pack::PackLevel& level, const glm::dvec3& box_size);

/// The volume that one face shows: the half spaces a.X + d >= 0 (a unit) of the face's pyramid and the
/// picture's four edges.
struct FaceVolume {
    /// The face's edges, the plane before the projector, the picture's edges and the face's own plane.
    static constexpr std::size_t max_half_spaces = geometry::max_face_corners + 6;
    std::array<glm::dvec4, max_half_spaces> half_spaces{};
    std::size_t count = 0;

    /// Normalises the half space; a degenerate or non-finite one is skipped.
    void add(const glm::dvec4& half_space);
};

/// A level's triangles that face one eye, cluster by cluster: found once for all faces that share the eye.
class FrontTriangles {
public:
    /// Reserves memory for levels of up to `indices` indices.
    void reserve(std::size_t indices);
    /// Which eyes see triangles from behind too: none, as at the beginning, those within the box around a level, or all.
    enum class Backs : std::uint8_t { Never, FromWithin, Always };
    void keep_backs(Backs backs) { backs_ = backs; }
    /// Discards the triangles found so far.
    void forget() { level_ = nullptr; }
    /// Finds the triangles again if the eye or the level has changed. A triangle within rounding of edge-on
    /// counts as facing the eye.
    void update(const LevelTriangles& level, const glm::dvec3& eye_box);
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cluster) const {
        return std::span(indices_).subspan(first_[cluster], first_[cluster + 1] - first_[cluster]);
    }

private:
    const LevelTriangles* level_ = nullptr;
    Backs backs_ = Backs::Never;
    glm::dvec3 eye_box_{0.0};
    std::vector<std::uint32_t> indices_;
    std::vector<std::size_t> first_; ///< start of each cluster in `indices_`, and the end
};

/// Appends the indices of the cluster's triangles that may show; returns the number of triangles appended.
/// Conservative: a triangle of `front` that is left out has no point inside the volume widened by
/// `margin_box`, which covers the rasterizer's rounding.
std::size_t append_visible(const FaceVolume& volume, const LevelTriangles& level, const FrontTriangles& front,
                           std::size_t cluster, std::vector<std::uint32_t>& indices,
                           double margin_box = 1e-3);

} // namespace frustumscreen::scene
