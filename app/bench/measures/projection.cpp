#include "app/bench/measures/projection.h"

#include "app/bench/measures/comparison.h"
#include "app/bench/measures/side_by_side.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr int rays_per_side = 4;
constexpr const char* ray_cast_technique = "ray-cast picture";
constexpr glm::u8vec4 black(0, 0, 0, 255);

simulation::VisitorScene scene_of(const Kiosk& kiosk, const BenchPose& pose) {
    const settings::Settings& settings = kiosk.settings;
    return {.projector = settings.projector.pinhole,
            .table_from_projector = settings.projector.table_from_projector,
            .prop = kiosk.prop,
            .table_from_prop = pose.table_from_prop,
            .eye_m = pose.eye_m,
            .table_size_m = {settings.table.width_m, settings.table.depth_m}};
}

int codes_off(const glm::u8vec4& a, const glm::u8vec4& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

double percent_of(std::int64_t part, std::int64_t all) {
    return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 100.0;
}

glm::u8vec4 colour_of_difference(int codes) {
    const auto grey = static_cast<std::uint8_t>(24 + std::min(4 * codes, 231));
    return codes > max_codes_off ? glm::u8vec4(255, 40, 30, 255) : glm::u8vec4(grey, grey, grey, 255);
}

/// The visitor's rays in the prop's frame.
struct VisitorRays {
    glm::dvec3 eye_m;
    geometry::RigidTransform prop_from_camera;
    const geometry::Pinhole& pinhole;

    VisitorRays(const simulation::VisitorScene& scene, const simulation::VisitorCamera& camera)
        : eye_m(scene.table_from_prop.inverse().point(camera.table_from_camera.translation)),
          prop_from_camera(scene.table_from_prop.inverse() * camera.table_from_camera),
          pinhole(camera.pinhole) {}
    [[nodiscard]] glm::dvec3 through(double u, double v) const {
        return prop_from_camera.direction(pinhole.ray({u, v}));
    }
};

/// Projector pixels per step of one pixel of the visitor's picture, at the place seen through `at`, in the
/// direction with the fewest; infinite off the prop.
double min_span(const simulation::VisitorScene& scene, const VisitorRays& rays, const glm::dvec2& at) {
    geometry::PropHit hit;
    if (!geometry::intersect(scene.prop, rays.eye_m, rays.through(at.x, at.y), hit)) {
        return std::numeric_limits<double>::infinity();
    }
    const geometry::Plane& plane = scene.prop.faces[static_cast<std::size_t>(hit.face)].plane;
    const geometry::RigidTransform projector_from_prop =
        scene.table_from_projector.inverse() * scene.table_from_prop;
    const auto lit_pixel = [&](double u, double v) {
        const glm::dvec3 ray = rays.through(u, v);
        const double t = -plane.distance(rays.eye_m) / glm::dot(plane.normal, ray);
        return scene.projector.pixel(projector_from_prop.point(rays.eye_m + t * ray))
            .value_or(glm::dvec2(0.0));
    };
    const glm::dvec2 across = lit_pixel(at.x + 0.5, at.y) - lit_pixel(at.x - 0.5, at.y);
    const glm::dvec2 down = lit_pixel(at.x, at.y + 0.5) - lit_pixel(at.x, at.y - 0.5);
    // The smaller singular value of the matrix (across, down).
    const double squares = glm::dot(across, across) + glm::dot(down, down);
    const double area = std::abs(across.x * down.y - across.y * down.x);
    return 0.5 * (std::sqrt(squares + 2.0 * area) - std::sqrt(std::max(0.0, squares - 2.0 * area)));
}

/// Minimum over the prop's pixels on a grid of `step`; infinite if there are none.
double min_span(const simulation::VisitorScene& scene, const simulation::VisitorCamera& camera, int step) {
    const VisitorRays rays(scene, camera);
    double least = std::numeric_limits<double>::infinity();
    for (int y = step / 2; y < camera.pinhole.height; y += step) {
        for (int x = step / 2; x < camera.pinhole.width; x += step) {
            least = std::min(least, min_span(scene, rays, {x + 0.5, y + 0.5}));
        }
    }
    return least;
}

/// Judges projector pictures by what one visitor sees of them.
class Judge {
public:
    Judge(const Truth& truth, const simulation::VisitorScene& scene)
        : scene_(scene), camera_(no_finer_camera(scene)), one_ray_(cast_visitor(truth, scene, camera_, 1)),
          sixteen_rays_(cast_visitor(truth, scene, camera_, rays_per_side)) {
        row_.size_px = {camera_.pinhole.width, camera_.pinhole.height};
        row_.min_span_px = min_span(scene, camera_, 1);
    }

    /// `for_one_ray` and `for_sixteen_rays` are the pictures for the two comparisons.
    [[nodiscard]] ProjectionRow judge(const image::Image8& for_one_ray,
                                      const image::Image8& for_sixteen_rays) {
        simulation::VisitorViewOptions sixteen = simulation::exact_check();
        sixteen.rays_per_side = rays_per_side;
        ProjectionRow row = row_;
        row.one_ray = pixel_accuracy(
            simulation::visitor_view(scene_, for_one_ray, camera_, simulation::exact_check()), one_ray_);
        smooth_ = simulation::visitor_view(scene_, for_sixteen_rays, camera_, sixteen);
        row.sixteen_rays = pixel_accuracy(smooth_, sixteen_rays_);
        return row;
    }
    [[nodiscard]] image::Image8 pictures() const { return side_by_side(smooth_, sixteen_rays_); }

private:
    simulation::VisitorScene scene_;
    simulation::VisitorCamera camera_;
    VisitorTruth one_ray_;
    VisitorTruth sixteen_rays_;
    ProjectionRow row_;
    image::Image8 smooth_;
};

Result<ProjectionResult> compare(const SetUp& set_up, const pack::Pack& pack,
                                 const std::shared_ptr<const bake::SourceMesh>& mesh,
                                 const ProjectionOptions& options, const StepProgress& progress) {
    TRY(Comparison opened, open_comparison(set_up, pack, default_and_finest(pack), mesh,
                                           {options.picture, options.poses, options.seed}));
    TechniqueSet& set = *opened.set;
    const Truth& truth = opened.truth;
    ProjectionResult result{.name = set_up.name, .poses = std::move(opened.poses), .rows = {}, .worst = {}};
    double worst_percent = std::numeric_limits<double>::infinity();
    for (std::size_t pose = 0; pose < result.poses.size(); ++pose) {
        const BenchPose& at = result.poses[pose];
        Judge judge(truth, scene_of(set.kiosk(), at));
        const TruthPicture cast = truth.cast(set.kiosk().prop, view_of(set.kiosk().settings, at), true);
        const auto add = [&](ProjectionRow row, const std::string& technique, int level) {
            row.technique = technique;
            row.level = level;
            row.pose = static_cast<int>(pose);
            result.rows.push_back(std::move(row));
        };
        add(judge.judge(cast.colour, cast.colour16), ray_cast_technique, -1);
        for (std::size_t k = 0; k < set.results().size(); ++k) {
            const TechniqueResult& drawn = set.results()[k];
            if (drawn.kind != TechniqueKind::PackLevel) {
                continue;
            }
            const image::Image8 picture = set.picture(k, at);
            add(judge.judge(picture, picture), drawn.name, drawn.level);
            if (result.rows.back().sixteen_rays.prop_percent() < worst_percent) {
                worst_percent = result.rows.back().sixteen_rays.prop_percent();
                result.worst = judge.pictures();
            }
        }
        progress(set_up.name + ": visitor's views",
                 static_cast<double>(pose + 1) / static_cast<double>(result.poses.size()));
    }
    return result;
}

} // namespace

VisitorTruth cast_visitor(const Truth& truth, const simulation::VisitorScene& scene,
                          const simulation::VisitorCamera& camera, int rays_per_side_of_pixel) {
    const VisitorRays rays(scene, camera);
    const int width = camera.pinhole.width;
    const int height = camera.pinhole.height;
    const int n = rays_per_side_of_pixel;
    VisitorTruth picture{{width, height}, {width, height}, {width, height, black}};
    const auto cast_pixel = [&](int x, int y) {
        geometry::PropHit face;
        Truth::Hit hit;
        const glm::dvec3 middle = rays.through(x + 0.5, y + 0.5);
        picture.prop.at(x, y) = geometry::intersect(scene.prop, rays.eye_m, middle, face) ? 1 : 0;
        if (picture.prop.at(x, y) == 0) {
            return;
        }
        picture.hit.at(x, y) = truth.first_hit(rays.eye_m, middle, hit) ? 1 : 0;
        glm::vec3 sum(0.0F);
        for (int k = 0; k < n * n; ++k) {
            const int column = k % n;
            const int row = k / n;
            if (truth.first_hit(rays.eye_m, rays.through(x + (column + 0.5) / n, y + (row + 0.5) / n), hit)) {
                sum += glm::clamp(hit.colour.linear, 0.0F, 1.0F);
            }
        }
        sum /= static_cast<float>(n * n);
        picture.colour.at(x, y) = {image::srgb8_from_linear(sum.r), image::srgb8_from_linear(sum.g),
                                   image::srgb8_from_linear(sum.b), 255};
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

double PixelAccuracy::prop_percent() const {
    return percent_of(prop_right, prop_pixels);
}
double PixelAccuracy::artifact_percent() const {
    return percent_of(artifact_right, artifact_pixels);
}

PixelAccuracy pixel_accuracy(const image::Image8& view, const VisitorTruth& truth) {
    PixelAccuracy found;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            if (truth.prop.at(x, y) == 0) {
                continue;
            }
            const bool right = codes_off(view.at(x, y), truth.colour.at(x, y)) <= max_codes_off;
            const bool artifact = truth.hit.at(x, y) != 0;
            ++found.prop_pixels;
            found.prop_right += right ? 1 : 0;
            found.artifact_pixels += artifact ? 1 : 0;
            found.artifact_right += artifact && right ? 1 : 0;
        }
    }
    return found;
}

simulation::VisitorCamera no_finer_camera(const simulation::VisitorScene& scene) {
    // A picture half as wide has pixels twice as wide. The span varies smoothly, so a coarse grid is enough.
    constexpr int grid_px = 4;
    constexpr double margin = 0.99;
    const auto camera = [&scene](double scale) {
        const auto pixels = [scale](int all) {
            return std::max(1, static_cast<int>(std::floor(scale * all)));
        };
        return simulation::visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m,
                                          pixels(scene.projector.width), pixels(scene.projector.height));
    };
    const double span = min_span(scene, camera(1.0), grid_px);
    return camera(std::min(1.0, margin * span));
}

image::Image8 side_by_side(const image::Image8& view, const VisitorTruth& truth) {
    image::Image8 difference(view.width, view.height, black);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            if (truth.prop.at(x, y) != 0) {
                difference.at(x, y) = colour_of_difference(codes_off(view.at(x, y), truth.colour.at(x, y)));
            }
        }
    }
    return side_by_side(std::array{&view, &truth.colour, &std::as_const(difference)}, box_of(truth.prop));
}

Result<ProjectionResult> projection(const SetUp& set_up, const pack::Pack& pack,
                                    const std::shared_ptr<const bake::SourceMesh>& mesh,
                                    const ProjectionOptions& options, const StepProgress& progress) {
    return at(set_up.name, compare(set_up, pack, mesh, options, progress));
}

} // namespace frustumscreen::bench
