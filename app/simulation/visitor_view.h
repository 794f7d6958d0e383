/// The visitor's view: the simulated table with the prop, lit by the projector's picture.
///
/// A separate path, to check the whole chain: it uses the projector's finished picture, the configuration and the
/// poses, but neither the artifact nor the collineation. A ray goes from the eye through each pixel to the prop or
/// the table; the point that it hits reflects the projector's pixel that lights it, if any. A flat screen behind the
/// table is a surface that shines by itself: a ray that meets it takes its picture's colour.
///
/// Frames   table T; metres. Pixels as in pinhole.h.
///
/// Light    linear inside, sRGB codes at input and output. With `light`, as in room_light.h. Without it, a
///          surface returns the projector's code unchanged, and black where no light falls.
/// Threads  uses all cores; deterministic. Offline only.
/// Errors   none.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/image/image.h"
#include "app/simulation/visitor_screen.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::simulation {

/// An object of the room, axis-aligned in the table frame, which only the room's light reaches.
struct RoomObject {
    glm::dvec3 low_m{0.0};
    glm::dvec3 high_m{0.0};
    double albedo = 0.3;
};

/// Everything around the visitor.
struct VisitorScene {
    geometry::Pinhole projector; ///< of the given picture, with its width and height
    geometry::RigidTransform table_from_projector;
    geometry::PropShape prop;
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0};
    glm::dvec2 table_size_m{0.8, 0.5};    ///< along X and Y
    std::vector<RoomObject> objects = {}; ///< they cast no shadows; empty for pictures that are measured
    std::optional<VisitorScreen> screen = std::nullopt;
    std::vector<glm::dvec3> beside_m = {}; ///< further places that a picture of the whole shows
};

struct VisitorCamera {
    geometry::Pinhole pinhole;
    geometry::RigidTransform table_from_camera;
};

/// The camera at the eye E that looks at the prop's centre C = table_from_prop (0, 0, height / 2):
///     forward = +Z = (C - E) / |C - E|,  right = +X = normalise(forward x table Z),
///     down = +Y = forward x right
/// (straight above: right = table X);
///     fx = fy = 0.62 * min(width, height) / 2 / tan(asin(r / |C - E|)),  cx = width / 2,  cy = height / 2,
/// where r is the distance from C to the prop's farthest corner: the prop's sphere takes 0.62 of the
/// picture's shorter side. r / |C - E| counts as at most 0.9.
[[nodiscard]] VisitorCamera visitor_camera(const geometry::PropShape& prop,
                                           const geometry::RigidTransform& table_from_prop,
                                           const glm::dvec3& eye_m, int width, int height);

/// The camera at the eye that has the prop and `beside_m` in its picture, and where there is a screen that and the table's
/// far edge, for a picture of the whole.
///
/// Method   no roll; it looks at the middle of what it shows, which takes 0.94 of the picture in the narrower direction.
[[nodiscard]] VisitorCamera whole_camera(const VisitorScene& scene, int width, int height);

struct VisitorViewOptions {
    bool light = true;
    /// Rays along each side of a pixel, averaged in linear light; 1 = only through the centre.
    int rays_per_side = 3;
    /// Takes the projector's nearest pixel instead of interpolating four.
    bool nearest = false;
};
/// Options for comparing with a ray cast, ray by ray: `--no-light`. The visitor's picture should not be finer
/// than the projector's: half its width and height suits the default prop.
[[nodiscard]] constexpr VisitorViewOptions exact_check() {
    return {false, 1, false};
}

[[nodiscard]] image::Image8 visitor_view(const VisitorScene& scene, const image::Image8& projected,
                                         const VisitorCamera& camera, const VisitorViewOptions& options = {});

/// One picture's camera, for the file next to the pictures.
struct VisitorFrame {
    int frame = 0;
    std::int64_t t_us = 0;
    glm::dvec3 eye_m{0.0};
    VisitorCamera camera;
};
/// This file exists only next to pictures of the visitor's view.
inline constexpr std::string_view visitor_cameras_name = "visitor_cameras.json";
/// {"frames": [{"frame", "t_us", "eye_m"[3], "width", "height", "fx", "fy", "cx", "cy",
/// "table_from_camera"[16, column-major]}]}; ends with a line break.
[[nodiscard]] std::string visitor_cameras_json(std::span<const VisitorFrame> frames);

} // namespace frustumscreen::simulation
