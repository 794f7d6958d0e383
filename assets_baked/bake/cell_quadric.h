/// The surface within one cell of a grid, for the point that stands for it: the sum of its triangles' squared plane
/// distances (Garland & Heckbert 1997), and the mean of its vertices.
///
/// Frame    the cell: its middle at the origin, its edges 1.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

namespace frustumscreen {

class CellQuadric {
public:
    /// A plane through `on_plane`; `normal` has the triangle's area as its length.
    void add_plane(const glm::vec3& normal, const glm::vec3& on_plane);
    void add_vertex(const glm::vec3& position);

    /// The point of the cell nearest to all planes; along the surface, where planes do not fix it, the vertices' mean.
    [[nodiscard]] glm::vec3 best() const;

private:
    glm::vec3 diagonal_{0.0F}, mixed_{0.0F}; ///< of the sum of n nT: xx, yy, zz; yz, xz, xy
    glm::vec3 towards_{0.0F};                ///< sum of n (n . p)
    glm::vec3 sum_{0.0F};                    ///< of the vertices
    float count_ = 0.0F;
};

} // namespace frustumscreen
