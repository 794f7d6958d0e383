/// The light that an exhibit shows its artifact in, at one point of the prop.
///
/// What an exhibit aims at is said in app/scene/light.h and edge_feather.h. Here it is worked out from the point on the prop that a ray
/// lights, where the exhibit works it out from the pixel's place; soft edges by the distance to the edge, where the exhibit draws strips.
///
/// Frames   prop P, metres; pixels as `Pinhole` has them. Light in units of a surface square to the projector at 1 m.
/// Threads  `gain`: any, several at once.
#pragma once

#include "app/bench/truth/truth_view.h"
#include "app/geometry/prop_shape.h"

#include <array>
#include <optional>
#include <vector>

namespace frustumscreen {

/// The exhibit's own numbers. Errors in them are found by tests of app/scene and app/render, and not here.
struct LightAim {
    double reference = 0.0; ///< every place is dimmed to it
    double exposure = 1.0;  ///< of the artifact
    std::vector<double>
        most; ///< of each face of the prop: the largest gain, less than 1 where the light grazes it
    bool soft_edges = true;
};

/// A place that the projector's ray through a pixel lights.
struct LitPlace {
    int face = 0; ///< index into PropShape::faces
    glm::dvec3 point_m{0.0};
    glm::dvec2 pixel{0.0};
};

class ShownLight {
public:
    /// `prop` must outlive it.
    ShownLight(LightAim aim, const PropShape& prop, const TruthView& view);
    /// Factor of linear light, exposure in it.
    [[nodiscard]] double gain(const LitPlace& place) const;

private:
    /// An edge of a face, in pixels of the ideal pinhole.
    struct SoftEdge {
        glm::dvec2 from_px{0.0}, along{0.0}, inward{0.0}; ///< unit
        double length_px = 0.0;
        std::optional<std::array<double, 2>> shares; ///< at its ends; none: behind it the prop is dark
    };
    [[nodiscard]] double even(const LitPlace& place) const;
    [[nodiscard]] std::optional<SoftEdge> soft_edge(int face, std::size_t corner) const;
    [[nodiscard]] double softened(const LitPlace& place) const;

    LightAim aim_;
    const PropShape& prop_;
    TruthView view_;
    Pinhole ideal_;
    std::vector<std::vector<SoftEdge>> edges_; ///< of each face
};

} // namespace frustumscreen
