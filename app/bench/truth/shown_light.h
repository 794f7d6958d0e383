/// The light in which an exhibit shows its artifact, at one point of the prop.
///
/// The exhibit's target is defined in app/scene/light.h and edge_feather.h. Here it is computed from the
/// point on the prop that a ray lights, while the exhibit computes it from the pixel's position; soft edges
/// use the distance to the edge, while the exhibit draws strips.
///
/// Frames   prop P, metres; pixels as in `Pinhole`. Light in units of a surface square to the projector at 1
///          m.
/// Threads  `gain`: any, several at once.
#pragma once

#include "app/bench/truth/truth_view.h"
#include "app/geometry/prop_shape.h"

#include <array>
#include <optional>
#include <vector>

namespace frustumscreen::bench {

/// The exhibit's own numbers. Tests of app/scene and app/render check them; this code does not.
struct LightAim {
    double reference = 0.0; ///< every place is dimmed to this
    double exposure = 1.0;  ///< of the artifact
    /// Largest gain per face of the prop, less than 1 where the light grazes it.
    std::vector<double> most;
    bool soft_edges = true;
};

/// A place lit by the projector's ray through a pixel.
struct LitPlace {
    int face = 0; ///< index into PropShape::faces
    glm::dvec3 point_m{0.0};
    glm::dvec2 pixel{0.0};
};

class ShownLight {
public:
    /// `prop` must outlive this.
    ShownLight(LightAim aim, const geometry::PropShape& prop, const TruthView& view);
    /// Factor of linear light, including the exposure.
    [[nodiscard]] double gain(const LitPlace& place) const;

private:
    /// An edge of a face, in pixels of the ideal pinhole.
    struct SoftEdge {
        glm::dvec2 from_px{0.0}, along{0.0}, inward{0.0}; ///< unit
        double length_px = 0.0;
        std::optional<std::array<double, 2>> shares; ///< at its ends; nullopt: the prop is dark behind the
                                                     ///< edge
    };
    [[nodiscard]] double even(const LitPlace& place) const;
    [[nodiscard]] std::optional<SoftEdge> soft_edge(int face, std::size_t corner) const;
    [[nodiscard]] double softened(const LitPlace& place) const;

    LightAim aim_;
    const geometry::PropShape& prop_;
    TruthView view_;
    geometry::Pinhole ideal_;
    std::vector<std::vector<SoftEdge>> edges_; ///< per face
};

} // namespace frustumscreen::bench
