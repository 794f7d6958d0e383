/// The visitor's view of the table, as surfaces for the window to draw: light and camera are those of a
/// sheet's visitor view, but fast, for a desktop's GPU. The prop is outlined, so it is visible in a dark
/// picture too.
///
/// Frames   table T, metres; pixels of the half from its top left corner.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/settings/settings.h"
#include "app/simulation/visitor_view.h"
#include "firmware_host/window/sdl_window.h"

#include <optional>

namespace frustumscreen::programs {

class VisitorHalf {
public:
    explicit VisitorHalf(const settings::Settings& settings);

    /// `visitor_camera` for a prop at the table's centre; constant while the prop slides about.
    [[nodiscard]] simulation::VisitorCamera camera(const glm::dvec3& eye_m, PixelSize half) const;
    /// Adds the table, the prop's shadow, its visible faces, and their edges.
    void see(const tracker::PoseSample& prop, const glm::dvec3& eye_m, PixelSize half,
             window::SeenSurfaces& seen) const;
    /// The point of the table at a pixel; nullopt above the horizon.
    [[nodiscard]] std::optional<glm::dvec2> on_table(const glm::dvec2& pixel, const glm::dvec3& eye_m,
                                                     PixelSize half) const;

private:
    settings::ProjectorSettings projector_;
    glm::dvec2 half_table_m_;
    geometry::PropShape prop_;
    double exposure_;
};

} // namespace frustumscreen::programs
