#include "app/ldi/peers.h"

#include "app/ldi/triangle_rasterizer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace frustumscreen::ldi {

namespace {

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Box box_of(const TriangleWorld& world) {
    Box box;
    for (const std::uint32_t index : world.indices) {
        if (index < world.positions.size()) {
            const glm::dvec3 position(world.positions[index]);
            if (std::isfinite(position.x + position.y + position.z)) {
                box.low = glm::min(box.low, position);
                box.high = glm::max(box.high, position);
            }
        }
    }
    return box;
}

/// A side of a box, as a window.
struct SideWindow {
    glm::dvec3 middle, right, up, outwards;
    glm::dvec2 half_extent_m;
    double depth_m = 0.0; ///< of the box behind it
};

SideWindow side_window(const Box& box, std::size_t side) {
    const glm::dvec3 half = 0.5 * (box.high - box.low);
    const auto axis = static_cast<glm::length_t>(side / 2);
    const auto first = (axis + 1) % 3;
    const auto second = (axis + 2) % 3;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    SideWindow window{0.5 * (box.low + box.high),  glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0),
                      {half[first], half[second]}, 2.0 * half[axis]};
    window.outwards[axis] = sign;
    window.right[first] = sign;
    window.up[second] = 1.0;
    window.middle += half[axis] * window.outwards;
    return window;
}

/// Half the extent of the rectangle through which a camera, `to_side` before the side and `beside` its middle, sees the whole box.
double reach(double half, double depth, double to_side, double beside) {
    return std::max(half, (half * to_side + beside * depth) / (to_side + depth));
}

LayeredDepth side_layers(const TriangleWorld& world, const SideWindow& window, double radius_m,
                         const CameraView& view) {
    constexpr double diagonal = 0.7071067811865476;
    const double polar_sin = std::sin(side_camera_polar_rad);
    const double polar_cos = std::cos(side_camera_polar_rad);
    double pitch = view.pitch_m();
    std::array<PictureCamera, side_camera_count> cameras;
    for (std::size_t k = 0; k < side_camera_count; ++k) {
        const double out = k == 0 ? 1.0 : polar_cos;
        const double across = k == 0 ? 0.0 : (k % 2 == 0 ? diagonal : -diagonal) * polar_sin;
        const double along = k == 0 ? 0.0 : (k <= 2 ? diagonal : -diagonal) * polar_sin;
        const glm::dvec2 half(
            reach(window.half_extent_m.x, window.depth_m, out * radius_m, std::fabs(across) * radius_m),
            reach(window.half_extent_m.y, window.depth_m, out * radius_m, std::fabs(along) * radius_m));
        pitch =
            std::max(pitch, 2.0 * std::max(half.x, half.y) / std::clamp(view.max_side, 1, max_picture_side));
        cameras[k] = {window.middle +
                          radius_m * (out * window.outwards + across * window.right + along * window.up),
                      window.middle,
                      half.x * window.right,
                      half.y * window.up,
                      0,
                      0};
    }
    std::array<DepthPicture, side_camera_count> pictures;
    std::vector<const DepthPicture*> seeing;
    TriangleRasterizer rasterizer;
    for (std::size_t k = 0; k < side_camera_count; ++k) {
        const auto pixels = [&](const glm::dvec3& half) {
            return std::clamp(static_cast<int>(std::ceil(2.0 * glm::length(half) / pitch - 1e-9)), 1,
                              max_picture_side);
        };
        cameras[k].width = pixels(cameras[k].half_right);
        cameras[k].height = pixels(cameras[k].half_up);
        pictures[k].begin(cameras[k]);
        rasterizer.draw(world, pictures[k]);
        seeing.push_back(&pictures[k]);
    }
    return merged(seeing, cameras[0].eye, {window.middle, window.right, window.up, pitch, view.max_side},
                  view.tolerance_steps);
}

} // namespace

LayeredDepth single_ldi(const Hemisphere& hemisphere, std::span<const DepthPicture, camera_count> pictures,
                        const CameraView& view) {
    std::vector<const DepthPicture*> seeing;
    for (const DepthPicture& picture : pictures) {
        seeing.push_back(&picture);
    }
    return merged(seeing, {0.0, 0.0, hemisphere.radius_m()},
                  {glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, view.pitch_m(), view.max_side},
                  view.tolerance_steps);
}

std::uint64_t ImageBasedObject::bytes() const {
    std::uint64_t sum = 0;
    for (const Side& side : sides) {
        sum += side.layers.bytes();
    }
    return sum;
}

ImageBasedObject image_based_object(const TriangleWorld& world, double radius_m, const CameraView& view) {
    ImageBasedObject object;
    const Box box = box_of(world);
    for (std::size_t side = 0; side < object.sides.size() && box.low.x <= box.high.x; ++side) {
        const SideWindow window = side_window(box, side);
        object.sides[side] = {side_layers(world, window, radius_m, view), window.middle, window.outwards};
    }
    return object;
}

SeenSides seen_sides(const ImageBasedObject& object, const glm::dvec3& eye) {
    std::array<double, 6> before{};
    std::array<std::size_t, 6> order{0, 1, 2, 3, 4, 5};
    for (std::size_t side = 0; side < 6; ++side) {
        before[side] = glm::dot(object.sides[side].outwards, eye - object.sides[side].middle);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return before[a] > before[b]; });
    SeenSides seen;
    for (const std::size_t side : order) {
        if (seen.count < seen.numbers.size() && (before[side] > 0.0 || seen.count == 0)) {
            seen.numbers[seen.count++] = side;
        }
    }
    return seen;
}

void splat(const ImageBasedObject& object, DepthPicture& picture) {
    const SeenSides seen = seen_sides(object, picture.camera.eye);
    for (std::size_t k = 0; k < seen.count; ++k) {
        const LayeredDepth& layers = object.sides[seen.numbers[k]].layers;
        if (k == 0) {
            splat(layers, picture);
        } else {
            splat_by_depth(layers, picture);
        }
    }
}

} // namespace frustumscreen::ldi
