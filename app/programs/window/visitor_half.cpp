#include "app/programs/window/visitor_half.h"

#include "app/geometry/table_plane.h"
#include "app/simulation/room_light.h"

#include <cstddef>
#include <optional>

namespace frustumscreen::programs {

namespace {

using Polygon = geometry::PerCorner<glm::dvec3>; ///< convex; in the table's frame

const glm::dvec3 up(0.0, 0.0, 1.0);
const glm::vec3 outline_light(0.10F, 0.28F, 0.30F);
/// Light is interpolated linearly between a surface's corners; over a whole table that is not accurate.
constexpr int table_cells = 8;

/// Turns points of the table frame into vertices.
class Viewer {
public:
    Viewer(const simulation::VisitorCamera& camera, const settings::ProjectorSettings& projector,
           double exposure)
        : clip_from_table_(camera.pinhole.clip_from_point() * camera.table_from_camera.inverse().matrix()),
          projector_(projector), projector_from_table_(projector.table_from_projector.inverse()),
          exposure_(exposure) {}

    /// A surface that reflects `albedo` of the light. `lit`: the projector's light reaches it.
    [[nodiscard]] window::SeenVertex surface(const glm::dvec3& point, const glm::dvec3& normal, double albedo,
                                             bool lit) const {
        const double received =
            simulation::received_from(projector_.table_from_projector.translation, point, normal);
        window::SeenVertex vertex =
            line(point, glm::vec3(static_cast<float>(albedo * simulation::room_light_on(normal))));
        vertex.gain = lit ? static_cast<float>(albedo * exposure_ * received) : 0.0F;
        return vertex;
    }
    [[nodiscard]] window::SeenVertex line(const glm::dvec3& point, const glm::vec3& light) const {
        glm::dvec4 clip = clip_from_table_ * glm::dvec4(point, 1.0);
        clip.y = -clip.y; // the pinhole has -1 at the top
        const geometry::Pinhole& p = projector_.pinhole;
        glm::dvec3 ray = projector_from_table_.point(point);
        if (const auto bent = p.lens.distort(glm::dvec2(ray) / ray.z)) {
            ray = glm::dvec3(*bent * ray.z, ray.z);
        }
        return {.clip = glm::vec4(clip),
                .picture = glm::vec3((p.fx * ray.x + p.cx * ray.z) / p.width,
                                     (p.fy * ray.y + p.cy * ray.z) / p.height, ray.z),
                .gain = 0.0F,
                .own = light};
    }
    void add(const Polygon& polygon, const glm::dvec3& normal, double albedo, bool lit,
             window::SeenSurfaces& seen) const {
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            for (const std::size_t corner : {std::size_t{0}, k, k + 1}) {
                seen.triangles.push_back(surface(polygon[corner], normal, albedo, lit));
            }
        }
    }

private:
    glm::dmat4 clip_from_table_;
    const settings::ProjectorSettings& projector_;
    geometry::RigidTransform projector_from_table_;
    double exposure_;
};

void add_table(const Viewer& viewer, const glm::dvec2& half, window::SeenSurfaces& seen) {
    const glm::dvec2 cell = 2.0 * half / static_cast<double>(table_cells);
    for (int k = 0; k < table_cells * table_cells; ++k) {
        const glm::dvec2 low = cell * glm::dvec2(k % table_cells, k / table_cells) - half;
        viewer.add({glm::dvec3(low, 0.0), glm::dvec3(low.x + cell.x, low.y, 0.0), glm::dvec3(low + cell, 0.0),
                    glm::dvec3(low.x, low.y + cell.y, 0.0)},
                   up, simulation::table_albedo, true, seen);
    }
}

/// Adds the shadow of each face on the table.
void add_shadow(const Viewer& viewer, const Polygon& face, const glm::dvec3& lens, const glm::dvec2& half,
                window::SeenSurfaces& seen) {
    Polygon shadow;
    for (const glm::dvec3& corner : face) {
        const std::optional<glm::dvec2> meets = geometry::meets_table(lens, corner - lens);
        if (!meets) {
            return; // the corner is higher than the lens
        }
        shadow.push_back(glm::dvec3(glm::clamp(*meets, -half, half), 0.0));
    }
    viewer.add(shadow, up, simulation::table_albedo, false, seen);
}

} // namespace

VisitorHalf::VisitorHalf(const settings::Settings& settings)
    : projector_(settings.projector),
      half_table_m_(0.5 * settings.table.width_m, 0.5 * settings.table.depth_m),
      prop_(settings::make_prop(settings.prop)),
      exposure_(simulation::exposure_of(prop_, settings.projector.table_from_projector.translation)) {}

simulation::VisitorCamera VisitorHalf::camera(const glm::dvec3& eye_m, PixelSize half) const {
    return simulation::visitor_camera(prop_, {}, eye_m, half.width, half.height);
}

void VisitorHalf::see(const tracker::PoseSample& prop, const glm::dvec3& eye_m, PixelSize half,
                      window::SeenSurfaces& seen) const {
    const Viewer viewer(camera(eye_m, half), projector_, exposure_);
    const geometry::RigidTransform table_from_prop{prop.rotation, prop.position_m};
    const geometry::RigidTransform prop_from_table = table_from_prop.inverse();
    const glm::dvec3& lens = projector_.table_from_projector.translation;
    std::vector<Polygon> faces;
    for (const geometry::PropFace& face : prop_.faces) {
        Polygon& polygon = faces.emplace_back();
        for (const glm::dvec3& corner : face.corners) {
            polygon.push_back(table_from_prop.point(corner));
        }
    }
    add_table(viewer, half_table_m_, seen);
    for (const Polygon& face : faces) {
        add_shadow(viewer, face, lens, half_table_m_, seen);
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const geometry::Plane& plane = prop_.faces[k].plane;
        if (plane.distance(prop_from_table.point(eye_m)) <= 0.0) {
            continue;
        }
        viewer.add(faces[k], table_from_prop.direction(plane.normal), simulation::prop_albedo,
                   plane.distance(prop_from_table.point(lens)) > 0.0, seen);
        for (std::size_t corner = 0; corner < faces[k].size(); ++corner) {
            seen.lines.push_back(viewer.line(faces[k][corner], outline_light));
            seen.lines.push_back(viewer.line(faces[k][faces[k].next(corner)], outline_light));
        }
    }
}

std::optional<glm::dvec2> VisitorHalf::on_table(const glm::dvec2& pixel, const glm::dvec3& eye_m,
                                                PixelSize half) const {
    const simulation::VisitorCamera seen_by = camera(eye_m, half);
    return geometry::meets_table(eye_m, seen_by.table_from_camera.direction(seen_by.pinhole.ray(pixel)));
}

} // namespace frustumscreen::programs
