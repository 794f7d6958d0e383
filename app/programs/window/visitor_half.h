/// The table as the visitor's eye sees it, as surfaces for the window to draw: the same light and camera as the visitor's
/// view of a sheet, but fast, for a desktop's GPU. The prop is outlined, so that it is seen in a dark picture too.
///
/// Frames   table T, metres; pixels of the half from its top left corner.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/settings/settings.h"
#include "app/simulation/visitor_view.h"
#include "firmware_host/window/sdl_window.h"

#include <optional>

namespace frustumscreen {

class VisitorHalf {
public:
    explicit VisitorHalf(const Settings& settings);

    /// `visitor_camera` for a prop at the table's centre: it stays while the prop slides about.
    [[nodiscard]] VisitorCamera camera(const glm::dvec3& eye_m, PixelSize half) const;
    /// Adds the table, the prop's shadow, its faces that the eye sees, and their edges.
    void see(const PoseSample& prop, const glm::dvec3& eye_m, PixelSize half, SeenSurfaces& seen) const;
    /// Where on the table a pixel lies; nothing beside it, above the horizon.
    [[nodiscard]] std::optional<glm::dvec2> on_table(const glm::dvec2& pixel, const glm::dvec3& eye_m,
                                                     PixelSize half) const;

private:
    ProjectorSettings projector_;
    glm::dvec2 half_table_m_;
    PropShape prop_;
    double exposure_;
};

} // namespace frustumscreen
