#include "app/bench/projection.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

constexpr int rays_per_side = 4;
constexpr glm::u8vec4 black(0, 0, 0, 255);

VisitorScene scene_of(const Stage& stage, const BenchPose& pose) {
    const Settings& settings = stage.settings;
    return {settings.projector.pinhole,
            settings.projector.table_from_projector,
            stage.prop,
            pose.table_from_prop,
            pose.eye_m,
            {settings.table.width_m, settings.table.depth_m}};
}

int codes_off(const glm::u8vec4& a, const glm::u8vec4& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

double percent_of(std::int64_t part, std::int64_t all) {
    return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 100.0;
}

/// The visitor's rays in the prop's frame.
struct VisitorRays {
    glm::dvec3 eye_m;
    RigidTransform prop_from_camera;
    const Pinhole& pinhole;

    VisitorRays(const VisitorScene& scene, const VisitorCamera& camera)
        : eye_m(scene.table_from_prop.inverse().point(camera.table_from_camera.translation)),
          prop_from_camera(scene.table_from_prop.inverse() * camera.table_from_camera),
          pinhole(camera.pinhole) {}
    [[nodiscard]] glm::dvec3 through(double u, double v) const {
        return prop_from_camera.direction(pinhole.ray({u, v}));
    }
};

/// Of every prop pixel in a grid of `step`; infinite if there is none.
double least_covered(const VisitorScene& scene, const VisitorCamera& camera, int step) {
    const VisitorRays rays(scene, camera);
    double least = std::numeric_limits<double>::infinity();
    for (int y = step / 2; y < camera.pinhole.height; y += step) {
        for (int x = step / 2; x < camera.pinhole.width; x += step) {
            PropHit hit;
            if (intersect(scene.prop, rays.eye_m, rays.through(x + 0.5, y + 0.5), hit)) {
                least = std::min(least, projector_pixels_covered(scene, camera, {x + 0.5, y + 0.5}));
            }
        }
    }
    return least;
}

/// One level in one pose, and its pictures.
struct Look {
    ProjectionRow row;
    Image8 pictures;
};

Look look(const VisitorScene& scene, const VisitorCamera& camera, const Image8& projected,
          const VisitorTruth& one_ray, const VisitorTruth& sixteen_rays) {
    const Image8 view = visitor_view(scene, projected, camera, exact_check());
    VisitorViewOptions smooth = exact_check();
    smooth.rays_per_side = rays_per_side;
    Look made;
    made.row.one_ray = agreement(view, one_ray);
    made.row.sixteen_rays = agreement(visitor_view(scene, projected, camera, smooth), sixteen_rays);
    made.row.size_px = {camera.pinhole.width, camera.pinhole.height};
    made.pictures = side_by_side(view, one_ray);
    return made;
}

Result<ProjectionResult> compare(const SetUp& set_up, const Pack& pack,
                                 const std::shared_ptr<const SourceMesh>& mesh,
                                 const ProjectionOptions& options, const StepProgress& progress) {
    Result<std::unique_ptr<TechniqueSet>> opened = open_default_and_finest(set_up, pack, options.picture);
    if (!opened) {
        return tl::unexpected<Error>(opened.error());
    }
    TechniqueSet& set = **opened;
    Result<std::vector<BenchPose>> poses =
        draw_poses(set_up.settings, set.stage().prop, options.poses, options.seed);
    if (!poses) {
        return tl::unexpected<Error>(poses.error());
    }
    const Result<Truth> truth = Truth::build(mesh, place(pack, set.stage().prop).prop_from_artifact);
    if (!truth) {
        return tl::unexpected<Error>(truth.error());
    }
    ProjectionResult result{set_up.name, std::move(*poses), {}, {}};
    double worst_percent = std::numeric_limits<double>::infinity();
    for (std::size_t pose = 0; pose < result.poses.size(); ++pose) {
        const VisitorScene scene = scene_of(set.stage(), result.poses[pose]);
        const VisitorCamera camera = no_finer_camera(scene);
        const double covered = least_covered(scene, camera, 1);
        const VisitorTruth one_ray = cast_visitor(*truth, scene, camera, 1);
        const VisitorTruth sixteen_rays = cast_visitor(*truth, scene, camera, rays_per_side);
        for (std::size_t k = 0; k < set.results().size(); ++k) {
            if (set.results()[k].kind != TechniqueKind::PackLevel) {
                continue;
            }
            Look made = look(scene, camera, set.picture(k, result.poses[pose]), one_ray, sixteen_rays);
            made.row.technique = set.results()[k].name;
            made.row.level = set.results()[k].level;
            made.row.pose = static_cast<int>(pose);
            made.row.least_covered = covered;
            if (made.row.one_ray.prop_percent() < worst_percent) {
                worst_percent = made.row.one_ray.prop_percent();
                result.worst = std::move(made.pictures);
            }
            result.rows.push_back(std::move(made.row));
        }
        progress(set_up.name + ": visitor's views",
                 static_cast<double>(pose + 1) / static_cast<double>(result.poses.size()));
    }
    return result;
}

} // namespace

VisitorTruth cast_visitor(const Truth& truth, const VisitorScene& scene, const VisitorCamera& camera,
                          int rays_per_side_of_pixel) {
    const VisitorRays rays(scene, camera);
    const int width = camera.pinhole.width;
    const int height = camera.pinhole.height;
    const int n = rays_per_side_of_pixel;
    VisitorTruth picture{{width, height}, {width, height}, {width, height, black}};
    const auto cast_pixel = [&](int x, int y) {
        PropHit face;
        Truth::Hit hit;
        const glm::dvec3 middle = rays.through(x + 0.5, y + 0.5);
        picture.prop.at(x, y) = intersect(scene.prop, rays.eye_m, middle, face) ? 1 : 0;
        if (picture.prop.at(x, y) == 0) {
            return;
        }
        picture.hit.at(x, y) = truth.first_hit(rays.eye_m, middle, hit) ? 1 : 0;
        glm::vec3 sum(0.0F);
        for (int k = 0; k < n * n; ++k) {
            if (truth.first_hit(rays.eye_m, rays.through(x + (k % n + 0.5) / n, y + (k / n + 0.5) / n),
                                hit)) {
                sum += glm::clamp(hit.colour.linear, 0.0F, 1.0F);
            }
        }
        sum /= static_cast<float>(n * n);
        picture.colour.at(x, y) = {srgb8_from_linear(sum.r), srgb8_from_linear(sum.g),
                                   srgb8_from_linear(sum.b), 255};
    };
    parallel_for(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < width; ++x) {
                cast_pixel(x, y);
            }
        }
    });
    return picture;
}

double Agreement::prop_percent() const {
    return percent_of(prop_right, prop_pixels);
}
double Agreement::artifact_percent() const {
    return percent_of(artifact_right, artifact_pixels);
}

Agreement agreement(const Image8& view, const VisitorTruth& truth) {
    Agreement found;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            if (truth.prop.at(x, y) == 0) {
                continue;
            }
            const bool right = codes_off(view.at(x, y), truth.colour.at(x, y)) <= most_codes_off;
            const bool artifact = truth.hit.at(x, y) != 0;
            ++found.prop_pixels;
            found.prop_right += right ? 1 : 0;
            found.artifact_pixels += artifact ? 1 : 0;
            found.artifact_right += artifact && right ? 1 : 0;
        }
    }
    return found;
}

VisitorCamera no_finer_camera(const VisitorScene& scene) {
    // A picture half as wide has pixels four times as large; the grid misses little of so smooth a function.
    constexpr int grid_px = 4;
    constexpr double margin = 0.99;
    const auto camera = [&scene](double scale) {
        const auto pixels = [scale](int all) {
            return std::max(1, static_cast<int>(std::floor(scale * all)));
        };
        return visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, pixels(scene.projector.width),
                              pixels(scene.projector.height));
    };
    const double covered = least_covered(scene, camera(1.0), grid_px);
    return camera(std::min(1.0, margin * std::sqrt(covered)));
}

Image8 side_by_side(const Image8& view, const VisitorTruth& truth) {
    Image8 picture(3 * view.width, view.height, black);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            picture.at(x, y) = view.at(x, y);
            picture.at(view.width + x, y) = truth.colour.at(x, y);
            if (truth.prop.at(x, y) == 0) {
                continue;
            }
            const int off = codes_off(view.at(x, y), truth.colour.at(x, y));
            const auto grey = static_cast<std::uint8_t>(24 + std::min(4 * off, 231));
            picture.at(2 * view.width + x, y) =
                off > most_codes_off ? glm::u8vec4(255, 40, 30, 255) : glm::u8vec4(grey, grey, grey, 255);
        }
    }
    return picture;
}

Result<ProjectionResult> projection(const SetUp& set_up, const Pack& pack,
                                    const std::shared_ptr<const SourceMesh>& mesh,
                                    const ProjectionOptions& options, const StepProgress& progress) {
    Result<ProjectionResult> result = compare(set_up, pack, mesh, options, progress);
    return result ? std::move(result) : at(set_up.name, result.error());
}

} // namespace frustumscreen
