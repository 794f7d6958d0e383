#include "app/scene/frame_plan.h"

#include "app/geometry/collineation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen {

namespace {

/// More faces than any prop has; keeps the frame free of allocation.
constexpr std::size_t most_faces = 16;

/// FNV-1a over 64-bit words.
class Hash {
public:
    void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3ULL; }
    void add_float(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void hash_corners(const std::array<glm::vec4, 4>& corners, Hash& hash) {
    for (const glm::vec4& corner : corners) {
        for (int k = 0; k < 4; ++k) {
            hash.add_float(corner[k]);
        }
    }
}

void hash_caption(const CaptionPlan& caption, Hash& hash) {
    if (caption.bounds.empty()) {
        return;
    }
    hash_corners(caption.corners_clip, hash);
    hash.add_float(caption.brightness);
    for (const std::array<glm::vec4, 4>& face : caption.prop_clip) {
        hash_corners(face, hash);
    }
}

std::uint64_t hash_of(const FramePlan& plan, std::uint64_t artifact, std::uint64_t coming,
                      std::uint64_t caption) {
    Hash hash;
    hash.add(artifact);
    hash.add(coming);
    hash.add(plan.caption.bounds.empty() ? 0 : caption);
    hash.add(static_cast<std::uint64_t>(plan.projector.width));
    hash.add(static_cast<std::uint64_t>(plan.projector.height));
    hash.add(static_cast<std::uint64_t>(plan.compensate_light));
    hash.add(static_cast<std::uint64_t>(plan.samples));
    hash.add_float(plan.brightness);
    hash.add_float(plan.coming_share.value_or(-1.0F));
    hash_caption(plan.caption, hash);
    for (const FacePlan& face : plan.faces) {
        hash.add(static_cast<std::uint64_t>(face.face));
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                hash.add_float(face.clip_from_unit[column][row]);
            }
        }
        hash_corners(face.corners_clip, hash);
        hash.add_float(face.light.constant);
        hash.add_float(face.light.per_cubic_metre);
        hash.add(face.shown.count);
        hash.add(face.coming.count);
    }
    return hash.value();
}

/// Everything of one frame that the faces share.
struct Shared {
    const PropShape& prop;
    const PlacedLevel& artifact;
    const PlanView& view;
    glm::dmat4 projector_from_prop;
    glm::dmat4 clip_from_prop;
    glm::dvec3 projector_in_prop;
    RigidTransform prop_from_table;
    Box box; ///< the artifact's, prop frame

    [[nodiscard]] glm::dvec3 eye(std::size_t face) const {
        const std::size_t which = view.eyes_m.size() == 1 ? 0 : std::min(face, view.eyes_m.size() - 1);
        return prop_from_table.point(view.eyes_m[which]);
    }
};

Shared shared_by_faces(const PropShape& prop, const PlacedLevel& artifact, const PlanView& view) {
    const RigidTransform projector_from_prop = view.table_from_projector.inverse() * view.table_from_prop;
    const glm::dvec3 extent = artifact.box_size * artifact.metres_per_box;
    Shared shared{prop, artifact, view, projector_from_prop.matrix(), glm::dmat4(1.0), {}, {}, {}};
    shared.clip_from_prop = view.projector.clip_from_point() * shared.projector_from_prop;
    shared.projector_in_prop = projector_from_prop.inverse().translation;
    shared.prop_from_table = view.table_from_prop.inverse();
    shared.box = {{-0.5 * extent.x, -0.5 * extent.y, 0.0}, {0.5 * extent.x, 0.5 * extent.y, extent.z}};
    return shared;
}

glm::dvec4 row(const glm::dmat4& m, int r) {
    return {m[0][r], m[1][r], m[2][r], m[3][r]};
}

/// The pyramid eye -> face and the picture's edges seen through the face's collineation; box frame.
FaceVolume volume_of(const PropFace& face, const glm::dvec3& eye_in_prop, double metres_per_box,
                     const glm::dmat4& clip_from_box) {
    FaceVolume volume;
    const glm::dvec3 eye = eye_in_prop / metres_per_box;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const glm::dvec3 a = face.corners[k] / metres_per_box - eye;
        const glm::dvec3 b = face.corners[(k + 1) % face.corners.size()] / metres_per_box - eye;
        const glm::dvec3 inward = glm::cross(b, a);
        volume.add(glm::dvec4(inward, -glm::dot(inward, eye)));
    }
    const glm::dvec4 w = row(clip_from_box, 3);
    volume.add(w);
    for (int axis = 0; axis < 2; ++axis) {
        volume.add(w + row(clip_from_box, axis));
        volume.add(w - row(clip_from_box, axis));
    }
    return volume;
}

/// Pixels around points in clip coordinates; the whole picture if one is not in front. A pixel to spare each
/// way.
PixelRectangle pixels_around(std::span<const glm::dvec4> clip, const Pinhole& pinhole) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    const glm::dvec2 size(pinhole.width, pinhole.height);
    for (const glm::dvec4& p : clip) {
        if (!(p.w > 0.0)) {
            return {0, 0, pinhole.width, pinhole.height};
        }
        const glm::dvec2 pixel = (glm::dvec2(p) / p.w * 0.5 + 0.5) * size;
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    low = glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size);
    high = glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0.0), size);
    return {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x - low.x),
            static_cast<int>(high.y - low.y)};
}

/// Where the artifact can show on the face: its box seen through the face, and the face itself.
PixelRectangle face_bounds(const PropFace& face, const Shared& shared, const glm::dmat4& clip_from_frame) {
    std::array<glm::dvec4, 4> outline;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        outline[k] = shared.clip_from_prop * glm::dvec4(face.corners[k], 1.0);
    }
    std::array<glm::dvec4, 8> box;
    for (std::size_t k = 0; k < box.size(); ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? shared.box.high.x : shared.box.low.x,
                                (k & 2U) != 0 ? shared.box.high.y : shared.box.low.y,
                                (k & 4U) != 0 ? shared.box.high.z : shared.box.low.z);
        box[k] = clip_from_frame * glm::dvec4(corner, 1.0);
    }
    const Pinhole& pinhole = shared.view.projector;
    return intersected(pixels_around(outline, pinhole), pixels_around(box, pinhole));
}

/// Depth 0 keeps what is in front of the projector (w > 0) and clips the rest.
std::array<glm::vec4, 4> corners_in_clip(const std::array<glm::dvec3, 4>& corners, const glm::dmat4& clip) {
    std::array<glm::vec4, 4> result{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec4 corner = clip * glm::dvec4(corners[k], 1.0);
        result[k] = glm::vec4(glm::dvec4(corner.x, corner.y, 0.0, corner.w));
    }
    return result;
}

/// Pixels around points of the box seen through a face.
template <std::size_t count>
PixelRectangle pixels_of(const std::array<glm::vec3, count>& points, const glm::mat4& clip_from_box,
                         const Pinhole& pinhole) {
    std::array<glm::dvec4, count> clip;
    for (std::size_t k = 0; k < count; ++k) {
        clip[k] = glm::dvec4(clip_from_box * glm::vec4(points[k], 1.0F));
    }
    return pixels_around(clip, pinhole);
}

std::array<glm::vec3, 8> corners_of(const LevelTriangles::Extent& extent) {
    std::array<glm::vec3, 8> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = {(k & 1U) != 0 ? extent.high.x : extent.low.x,
                      (k & 2U) != 0 ? extent.high.y : extent.low.y,
                      (k & 4U) != 0 ? extent.high.z : extent.low.z};
    }
    return corners;
}

/// Lights what the triangles may light on a face: their box's part of it, or each triangle's where there are
/// few in a large box. Returns the pixels around it all.
PixelRectangle light_tiles(const LevelTriangles& level, std::size_t cluster,
                           std::span<const std::uint32_t> visible, const glm::mat4& clip_from_box,
                           const PixelRectangle& face, const Pinhole& pinhole, LitTiles& tiles) {
    constexpr int pixels_per_triangle = 100; // fewer cost less than looking closer
    const PixelRectangle box =
        intersected(face, pixels_of(corners_of(level.extents[cluster]), clip_from_box, pinhole));
    const std::size_t triangles = visible.size() / 3;
    if (box.empty() || static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height) <=
                           pixels_per_triangle * triangles) {
        tiles.light(box);
        return box;
    }
    PixelRectangle bounds;
    for (std::size_t k = 0; k < visible.size(); k += 3) {
        const std::array<glm::vec3, 3> corners{level.positions[visible[k]], level.positions[visible[k + 1]],
                                               level.positions[visible[k + 2]]};
        const PixelRectangle part = intersected(face, pixels_of(corners, clip_from_box, pinhole));
        tiles.light(part);
        bounds = united(bounds, part);
    }
    return bounds;
}

/// Adds what the face shows to the plan; returns the pixels around it.
PixelRectangle show_triangles(const LevelTriangles& level, const FrontTriangles& front,
                              const FaceVolume& volume, const glm::mat4& clip_from_box,
                              const PixelRectangle& face, FramePlan& plan, IndexRange& range) {
    range.first = static_cast<std::uint32_t>(plan.indices.size());
    PixelRectangle bounds;
    for (std::size_t k = 0; k < level.clusters.size(); ++k) {
        const std::size_t first = plan.indices.size();
        if (append_visible(volume, level, front, k, plan.indices) > 0) {
            bounds = united(bounds, light_tiles(level, k, std::span(plan.indices).subspan(first),
                                                clip_from_box, face, plan.projector, plan.lit));
        }
    }
    range.count = static_cast<std::uint32_t>(plan.indices.size()) - range.first;
    return bounds;
}

/// Geometric mean of the two singular values of pixel(point) at a point: how large a picture the face makes
/// of it.
double pixels_per_unit(const glm::dmat4& clip_from_box, const glm::dvec3& point, const Pinhole& pinhole) {
    const glm::dvec4 clip = clip_from_box * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0)) {
        return 0.0;
    }
    const glm::dvec3 w(row(clip_from_box, 3));
    const glm::dvec3 across =
        0.5 * pinhole.width / clip.w * (glm::dvec3(row(clip_from_box, 0)) - clip.x / clip.w * w);
    const glm::dvec3 down =
        0.5 * pinhole.height / clip.w * (glm::dvec3(row(clip_from_box, 1)) - clip.y / clip.w * w);
    return std::sqrt(glm::length(glm::cross(across, down)));
}

/// Plans one face; false if nothing shows on it.
bool plan_face(std::size_t index, const Shared& shared, FramePlan& plan, FacePlan& face_plan) {
    const PropFace& face = shared.prop.faces[index];
    const glm::dvec3 eye = shared.eye(index);
    const glm::dvec3 middle = 0.5 * (face.corners[0] + face.corners[2]);
    if (!(face.plane.distance(shared.projector_in_prop) >
          least_sine * glm::distance(shared.projector_in_prop, middle))) {
        return false;
    }
    const std::optional<glm::dmat4> clip = collineation(face.plane, eye, shared.clip_from_prop, shared.box);
    if (!clip) {
        return false;
    }
    const PixelRectangle bounds = face_bounds(face, shared, *clip);
    if (bounds.empty()) {
        return false;
    }
    const double scale = shared.artifact.metres_per_box;
    glm::dmat4 clip_from_box = *clip;
    glm::dmat4 clip_from_unit = *clip;
    for (int axis = 0; axis < 3; ++axis) {
        clip_from_box[axis] *= scale;
        clip_from_unit[axis] *= plan.prop_from_unit_scale[axis];
    }
    clip_from_unit[3] = *clip * glm::dvec4(plan.prop_from_unit_offset, 1.0);

    const FaceVolume volume = volume_of(face, eye, scale, clip_from_box);
    const glm::mat4 clip32(clip_from_box);
    plan.front.update(*shared.artifact.triangles, eye / scale);
    face_plan.bounds =
        show_triangles(*shared.artifact.triangles, plan.front, volume, clip32, bounds, plan, face_plan.shown);
    if (shared.view.fade) {
        const LevelTriangles& coming = *shared.view.fade->triangles;
        plan.coming_front.update(coming, eye / scale);
        face_plan.bounds = united(face_plan.bounds, show_triangles(coming, plan.coming_front, volume, clip32,
                                                                   bounds, plan, face_plan.coming));
    }
    if (face_plan.shown.count + face_plan.coming.count == 0) {
        return false;
    }
    face_plan.face = static_cast<int>(index);
    face_plan.pixels_per_box =
        pixels_per_unit(clip_from_box, {0.0, 0.0, 0.5 * shared.artifact.box_size.z}, shared.view.projector);
    face_plan.clip_from_unit = glm::mat4(clip_from_unit);
    face_plan.corners_clip = corners_in_clip(face.corners, shared.clip_from_prop);
    return true;
}

/// Pixels along a metre at the artifact's middle, as a share of those that a surface there would have which
/// faces the projector; a mean over the faces, by area.
double pixel_density(const Shared& shared, const FramePlan& plan) {
    double pixels = 0.0;
    double area = 0.0;
    for (const FacePlan& face : plan.faces) {
        const double share = static_cast<double>(face.bounds.width) * face.bounds.height;
        pixels += share * face.pixels_per_box / shared.artifact.metres_per_box;
        area += share;
    }
    const glm::dvec3 middle = 0.5 * (shared.box.low + shared.box.high);
    const double distance_m = glm::distance(middle, shared.projector_in_prop);
    return area > 0.0 ? pixels / area * distance_m / shared.view.projector.fx : 1.0;
}

/// Samples are counted by the bake for pictures of half that density and more.
int samples_at(double density, int samples) {
    constexpr double least_density = 0.5;
    constexpr int most = 16;
    while (samples > 0 && samples < most && density > 0.0 && density < least_density) {
        samples *= 2;
        density *= std::numbers::sqrt2;
    }
    return samples;
}

void plan_caption(const TablePicture& picture, const Shared& shared, CaptionPlan& caption) {
    const glm::dmat4 clip_from_table =
        shared.view.projector.clip_from_point() * shared.view.table_from_projector.inverse().matrix();
    std::array<glm::dvec4, 4> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = clip_from_table * glm::dvec4(picture.corners_m[k], 1.0);
    }
    caption.bounds = pixels_around(corners, shared.view.projector);
    caption.corners_clip = corners_in_clip(picture.corners_m, clip_from_table);
    caption.brightness = static_cast<float>(picture.brightness);
    for (const PropFace& face : shared.prop.faces) {
        if (face.plane.distance(shared.projector_in_prop) > 0.0) {
            caption.prop_clip.push_back(corners_in_clip(face.corners, shared.clip_from_prop));
        }
    }
}

void compensate(const Shared& shared, const LightCompensation& compensation, FramePlan& plan) {
    std::array<SeenFace, most_faces> seen{};
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        const auto face = static_cast<std::size_t>(plan.faces[k].face);
        seen[k] = {&shared.prop.faces[face], shared.eye(face)};
    }
    const double reference =
        reference_light(std::span(seen).first(plan.faces.size()), shared.projector_in_prop, compensation);
    for (std::size_t k = 0; k < plan.faces.size(); ++k) {
        plan.faces[k].light = face_light(seen[k].face->plane, shared.view.projector,
                                         shared.projector_from_prop, reference, compensation);
    }
}

} // namespace

PlacedLevel placed(const Pack& pack, std::uint32_t level, double metres_per_box, std::uint64_t id) {
    return {std::make_shared<LevelTriangles>(triangles_of(pack.levels[level], pack.box_size)), pack.box_size,
            metres_per_box, id, pack.samples};
}

FramePlan make_plan(const PropShape& prop, const PlacedLevel& artifact) {
    return make_plan(prop, artifact.triangles ? artifact.triangles->indices.size() : 0);
}

FramePlan make_plan(const PropShape& prop, std::size_t indices) {
    FramePlan plan;
    plan.faces.reserve(prop.faces.size());
    plan.caption.prop_clip.reserve(prop.faces.size());
    // A triangle may show on every face; memory that is never written is never taken.
    plan.indices.reserve(prop.faces.size() * indices);
    plan.front.reserve(indices);
    plan.coming_front.reserve(indices);
    return plan;
}

void plan_frame(const PropShape& prop, const PlacedLevel& artifact, const PlanView& view, FramePlan& plan) {
    const Shared shared = shared_by_faces(prop, artifact, view);
    plan.projector = view.projector;
    plan.compensate_light = view.light.has_value();
    plan.brightness = static_cast<float>(view.brightness);
    plan.coming_share = std::nullopt;
    if (view.fade) {
        plan.coming_share = static_cast<float>(view.fade->share);
    }
    plan.faces.clear();
    plan.indices.clear();
    plan.front.forget();
    plan.coming_front.forget();
    plan.lit.begin(view.projector.width, view.projector.height);
    plan.prop_from_unit_scale = shared.box.high - shared.box.low;
    plan.prop_from_unit_offset = shared.box.low;
    plan.caption.bounds = {};
    plan.caption.prop_clip.clear();
    if (artifact.triangles && !view.eyes_m.empty() && view.brightness > 0.0) {
        for (std::size_t face = 0; face < std::min(prop.faces.size(), most_faces); ++face) {
            FacePlan face_plan;
            if (((artifact.faces >> face) & 1U) != 0 && plan_face(face, shared, plan, face_plan)) {
                plan.faces.push_back(face_plan);
            }
        }
    }
    plan.lit.finish();
    plan.samples = samples_at(pixel_density(shared, plan), artifact.samples);
    if (view.light) {
        compensate(shared, *view.light, plan);
    }
    if (view.caption && view.caption->brightness > 0.0) {
        plan_caption(*view.caption, shared, plan.caption);
    }
    plan.hash =
        hash_of(plan, artifact.id, view.fade ? view.fade->id : 0, view.caption ? view.caption->id : 0);
}

PixelRectangle lit_bounds(const FramePlan& plan) {
    return united(plan.lit.bounds(), plan.caption.bounds);
}

} // namespace frustumscreen
