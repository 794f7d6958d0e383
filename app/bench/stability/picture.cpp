#include "app/bench/stability/picture.h"

#include "app/geometry/collineation.h"
#include "app/pack/pack_file.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr std::uint32_t triangles_in_cluster = 64;

/// Turns random numbers into triangles of a level, one cluster at a time.
class Scatter {
public:
    Scatter(const exact::SetUp& set_up, SeenArtifact& artifact)
        : artifact_(artifact), eye_(set_up.table_from_prop.inverse().point(set_up.eye_m)),
          extent_(seen_box_size * artifact.placed.metres_per_box),
          low_(-0.5 * extent_.x, -0.5 * extent_.y, 0.0) {}

    void anywhere() { add(low_ + glm::dvec3(share(), share(), share()) * extent_, usual_size); }
    /// A place that the eye sees through `face`, from directly behind it to the far end of the box.
    void behind(const geometry::PropFace& face) {
        const double a = share();
        const double b = share();
        const auto& corners = face.corners;
        const glm::dvec3& last = corners[corners.size() == 4 ? 3 : 0]; // else a triangle of the face
        const glm::dvec3 s = glm::mix(glm::mix(corners[0], corners[1], a), glm::mix(last, corners[2], a), b);
        const double depth = std::pow(10.0, -3.0 * share()); // share of the box
        // Smaller than the eye's own height above the face.
        const double size = 0.1 * face.plane.distance(eye_) / extent_.x;
        add(s + glm::normalize(s - eye_) * (depth * extent_.x), std::fmin(usual_size, size));
    }
    void finish() {
        pack::PackLevel& level = artifact_.level;
        for (std::uint32_t first = 0; first < level.indices.size(); first += 3 * triangles_in_cluster) {
            pack::PackCluster cluster;
            cluster.first_index = first;
            cluster.index_count =
                std::min(3 * triangles_in_cluster, static_cast<std::uint32_t>(level.indices.size()) - first);
            cluster.centre = {0.0F, 0.0F, 0.5F * static_cast<float>(seen_box_size.z)};
            cluster.radius = static_cast<float>(glm::length(seen_box_size));
            level.clusters.push_back(cluster);
        }
    }

private:
    static constexpr double usual_size = 0.004; ///< share of the box
    double share() { return spread_(random_); }

    /// Adds a triangle around `middle` that faces the eye; adds nothing outside the box.
    void add(const glm::dvec3& middle, double box_size) {
        const glm::dvec3 n = glm::normalize(eye_ - middle);
        const glm::dvec3 u =
            glm::normalize(glm::cross(n, std::abs(n.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 v = glm::cross(n, u);
        const double size = box_size * extent_.x;
        const std::array<glm::dvec3, 3> corners{middle + size * u, middle + size * (v - u),
                                                middle - size * (v + u)};
        std::array<pack::PackVertex, 3> vertices{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 unit = (corners[k] - low_) / extent_ * 65535.0;
            for (int axis = 0; axis < 3; ++axis) {
                if (!(unit[axis] >= 0.0 && unit[axis] <= 65535.0)) {
                    return;
                }
                vertices[k].position[static_cast<std::size_t>(axis)] =
                    static_cast<std::uint16_t>(std::lround(unit[axis]));
            }
        }
        for (const pack::PackVertex& vertex : vertices) {
            artifact_.level.indices.push_back(static_cast<std::uint32_t>(artifact_.level.vertices.size()));
            artifact_.level.vertices.push_back(vertex);
        }
    }

    SeenArtifact& artifact_;
    glm::dvec3 eye_;
    glm::dvec3 extent_;
    glm::dvec3 low_;
    std::mt19937 random_{11};
    std::uniform_real_distribution<double> spread_{0.0, 1.0};
};

double pixel_distance(const glm::dvec4& clip, const exact::Seen& seen, const geometry::Pinhole& pinhole) {
    const double u = (clip.x / clip.w + 1.0) / 2.0 * pinhole.width;
    const double v = (clip.y / clip.w + 1.0) / 2.0 * pinhole.height;
    return std::hypot(u - static_cast<double>(seen.u), v - static_cast<double>(seen.v));
}

bool lit_at(const scene::FramePlan& plan, const exact::Seen& seen) {
    const auto rectangles = plan.lit.rectangles();
    const auto u = static_cast<int>(seen.u);
    const auto v = static_cast<int>(seen.v);
    return std::any_of(rectangles.begin(), rectangles.end(), [&](const PixelRectangle& r) {
        return u >= r.x && v >= r.y && u <= r.x + r.width && v <= r.y + r.height;
    });
}

double not_finite(const scene::FramePlan& plan) {
    double count = 0.0;
    const auto add = [&count](double number) { count += std::isfinite(number) ? 0.0 : 1.0; };
    for (const scene::FacePlan& face : plan.faces) {
        for (int k = 0; k < 3; ++k) {
            add(static_cast<double>(face.light.inverse_depth[k]));
        }
        for (const glm::vec4& corner : face.corners_clip) {
            for (int k = 0; k < 4; ++k) {
                add(static_cast<double>(corner[k]));
            }
        }
        add(static_cast<double>(face.light.per_cubic_metre));
        add(face.pixels_per_m);
    }
    for (const scene::Draw& draw : plan.draws) {
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                add(static_cast<double>(draw.clip_from_unit[column][row]));
            }
        }
        add(draw.pixels_per_box);
    }
    return count;
}

/// Checks one face of the prop, whether the plan contains it or not.
class FaceCheck {
public:
    FaceCheck(const exact::SetUp& set_up, const SeenArtifact& artifact, const scene::FramePlan& plan,
              std::size_t face, PictureFigures& figures)
        : set_up_(set_up), artifact_(artifact), plan_(plan), face_(set_up.prop.faces[face]),
          figures_(figures) {
        const auto found = std::find_if(plan.draws.begin(), plan.draws.end(), [&](const scene::Draw& draw) {
            return plan.faces[static_cast<std::size_t>(draw.face)].face == static_cast<int>(face);
        });
        if (found != plan.draws.end()) {
            planned_ = &*found;
        }
        const glm::dvec3 extent = artifact.placed.box_size * artifact.placed.metres_per_box;
        const geometry::RigidTransform projector_from_prop =
            set_up.table_from_projector.inverse() * set_up.table_from_prop;
        collineation_ = geometry::collineation(
            face_.plane, set_up.table_from_prop.inverse().point(set_up.eye_m),
            set_up.projector.clip_from_point() * projector_from_prop.matrix(),
            {{-0.5 * extent.x, -0.5 * extent.y, 0.0}, {0.5 * extent.x, 0.5 * extent.y, extent.z}});
    }

    /// Uses the elevation of the eye, seen from the box's centre, and of the lens, seen from the face's
    /// middle.
    void check() {
        const exact::Vector eye = set_up_.eye_in_prop();
        const exact::Vector lens = set_up_.lens_in_prop();
        const exact::Vector centre{0, 0,
                                   0.5L * artifact_.placed.box_size.z * artifact_.placed.metres_per_box};
        const exact::Vector middle =
            0.5L * (exact::of(face_.corners[0]) + exact::of(face_.corners[face_.corners.size() / 2]));
        const exact::Real eye_sine = set_up_.height(face_, eye) / exact::length(eye - centre);
        const exact::Real lens_sine = set_up_.height(face_, lens) / exact::length(lens - middle);
        constexpr exact::Real hair = 1e-9L; // at the limit itself, lit and dark are both correct
        if (eye_sine < geometry::min_sine - hair || lens_sine < geometry::min_sine - hair) {
            figures_.wrong_faces += planned_ != nullptr ? 1.0 : 0.0;
            return;
        }
        if (eye_sine < geometry::min_sine + hair || lens_sine < geometry::min_sine + hair) {
            return;
        }
        sort_shown();
        constexpr std::size_t max_triangles = 50'000; // a larger level is sampled
        const std::size_t stride = 3 * (artifact_.level.indices.size() / (3 * max_triangles) + 1);
        for (std::size_t k = 0; k < artifact_.level.indices.size(); k += stride) {
            triangle(
                {artifact_.level.indices[k], artifact_.level.indices[k + 1], artifact_.level.indices[k + 2]});
        }
    }

private:
    using Corners = std::array<std::uint32_t, 3>;

    void sort_shown() {
        if (planned_ == nullptr) {
            return;
        }
        const auto range = std::span(plan_.indices).subspan(planned_->range.first, planned_->range.count);
        for (std::size_t k = 0; k < range.size(); k += 3) {
            shown_.push_back({range[k], range[k + 1], range[k + 2]});
        }
        std::sort(shown_.begin(), shown_.end());
    }

    void triangle(const Corners& corners) {
        const exact::Vector a = artifact_.corner(corners[0]);
        const exact::Vector b = artifact_.corner(corners[1]);
        const exact::Vector c = artifact_.corner(corners[2]);
        const exact::Vector middle = (1.0L / 3.0L) * (a + b + c);
        const std::optional<exact::Seen> seen = set_up_.see(face_, middle);
        const bool faces_eye = exact::dot(exact::cross(b - a, c - a), set_up_.eye_in_prop() - middle) > 0;
        if (!seen || !seen->on_face || !seen->in_picture || !faces_eye) {
            return;
        }
        figures_.points += 1.0;
        figures_.unlit += lit_at(plan_, *seen) ? 0.0 : 1.0;
        if (planned_ == nullptr || !collineation_ ||
            !std::binary_search(shown_.begin(), shown_.end(), corners)) {
            figures_.missing += 1.0;
            return;
        }
        compare(corners[0]);
    }

    void compare(std::uint32_t corner) {
        const exact::Vector x = artifact_.corner(corner);
        const std::optional<exact::Seen> seen = set_up_.see(face_, x);
        if (!seen || !seen->on_face || !seen->in_picture) {
            return;
        }
        const glm::dvec4 clip =
            *collineation_ *
            glm::dvec4(static_cast<double>(x.x), static_cast<double>(x.y), static_cast<double>(x.z), 1.0);
        figures_.error_px = std::fmax(figures_.error_px, pixel_distance(clip, *seen, set_up_.projector));
        const pack::PackVertex& vertex = artifact_.level.vertices[corner];
        const glm::vec3 unit =
            glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / 65535.0F;
        const glm::vec4 drawn = planned_->clip_from_unit * glm::vec4(unit, 1.0F);
        figures_.gpu_error_px =
            std::fmax(figures_.gpu_error_px, pixel_distance(glm::dvec4(drawn), *seen, set_up_.projector));
    }

    const exact::SetUp& set_up_;
    const SeenArtifact& artifact_;
    const scene::FramePlan& plan_;
    const geometry::PropFace& face_;
    PictureFigures& figures_;
    const scene::Draw* planned_ = nullptr; ///< the draw on this face
    std::optional<glm::dmat4> collineation_;
    std::vector<Corners> shown_;
};

} // namespace

exact::SetUp usual_set_up() {
    return {.prop = geometry::make_frustum({}),
            .projector = {1280, 800, 1920.0, 1920.0, 640.0, 400.0},
            .table_from_projector = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 1.2}},
            .table_from_prop = {},
            .eye_m = {0.0, -0.55, 0.50}};
}

exact::Vector SeenArtifact::corner(std::uint32_t index) const {
    const auto& p = level.vertices[index].position;
    const exact::Real scale = placed.metres_per_box;
    const glm::dvec3& size = placed.box_size;
    return {scale * size.x * (p[0] / 65535.0L - 0.5L), scale * size.y * (p[1] / 65535.0L - 0.5L),
            scale * size.z * (p[2] / 65535.0L)};
}

SeenArtifact seen_artifact(const exact::SetUp& set_up, int triangles, double metres_per_box) {
    SeenArtifact artifact;
    artifact.placed.metres_per_box = metres_per_box;
    Scatter scatter(set_up, artifact);
    std::vector<const geometry::PropFace*> seen;
    for (const geometry::PropFace& face : set_up.prop.faces) {
        if (set_up.height(face, set_up.eye_in_prop()) > 0) {
            seen.push_back(&face);
        }
    }
    for (int k = 0; k < triangles; ++k) {
        if (k % 2 == 0 || seen.empty()) {
            scatter.anywhere();
        } else {
            scatter.behind(*seen[static_cast<std::size_t>(k / 2) % seen.size()]);
        }
    }
    scatter.finish();
    artifact.placed = {.triangles = std::make_shared<scene::LevelTriangles>(
                           scene::triangles_of(artifact.level, seen_box_size)),
                       .box_size = seen_box_size,
                       .metres_per_box = metres_per_box,
                       .drawable = {},
                       .samples = 4};
    return artifact;
}

SeenArtifact seen_level(const exact::SetUp& set_up, const pack::Pack& pack, std::uint32_t level) {
    return {pack.levels[level],
            frustumscreen::scene::placed(pack, level, pack::place(pack, set_up.prop).metres_per_box)};
}

scene::FramePlan plan_of(const exact::SetUp& set_up, const SeenArtifact& artifact) {
    scene::PlanView view;
    view.projector = set_up.projector;
    view.table_from_projector = set_up.table_from_projector;
    view.table_from_prop = set_up.table_from_prop;
    view.eyes_m = {&set_up.eye_m, 1};
    scene::FramePlan plan = scene::make_plan(set_up.prop, artifact.placed);
    scene::plan_frame(set_up.prop, artifact.placed, view, plan);
    return plan;
}

void PictureFigures::include(const PictureFigures& other) {
    error_px = std::fmax(error_px, other.error_px);
    gpu_error_px = std::fmax(gpu_error_px, other.gpu_error_px);
    points += other.points;
    missing += other.missing;
    unlit += other.unlit;
    wrong_faces += other.wrong_faces;
    not_finite += other.not_finite;
}

PictureFigures figures_of(const exact::SetUp& set_up, const SeenArtifact& artifact,
                          const scene::FramePlan& plan, std::optional<std::size_t> only_face) {
    PictureFigures figures;
    figures.not_finite = not_finite(plan);
    for (std::size_t face = 0; face < set_up.prop.faces.size(); ++face) {
        if (face == only_face.value_or(face)) {
            FaceCheck(set_up, artifact, plan, face, figures).check();
        }
    }
    return figures;
}

PictureFigures figures_of(const exact::SetUp& set_up, std::optional<std::size_t> only_face) {
    const SeenArtifact artifact = seen_artifact(set_up);
    return figures_of(set_up, artifact, plan_of(set_up, artifact), only_face);
}

std::vector<StabilityRow> rows_of(const PictureFigures& figures, const std::string& where, double bound_px,
                                  double gpu_bound_px, double min_points) {
    std::vector<StabilityRow> rows{
        {where + "missing, unlit, on a dark face, not finite", 0.0,
         figures.missing + figures.unlit + figures.wrong_faces + figures.not_finite}};
    if (figures.points > 0.0) {
        rows.push_back({where + "64-bit, px", bound_px, figures.error_px});
        rows.push_back({where + "32-bit, px", gpu_bound_px, figures.gpu_error_px});
    }
    if (figures.points < min_points) {
        rows.push_back({where + "points compared, short of enough", 0.0, min_points - figures.points});
    }
    return rows;
}

void append(StabilityResult& result, std::vector<StabilityRow> rows) {
    for (StabilityRow& row : rows) {
        result.rows.push_back(std::move(row));
    }
}

} // namespace frustumscreen::bench
