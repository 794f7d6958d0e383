#include "app/bench/techniques/relief/relief_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {

namespace {

constexpr double jump_texels = 4.0;       ///< a greater depth step between neighbours is an edge
constexpr double squarer_by = 0.1;        ///< required gain of the cosine before another image takes a
                                          ///< triangle
constexpr double same_depth_texels = 2.0; ///< tolerance between two images of one surface

using Triangle = std::array<std::uint32_t, 3>;

struct Grid { ///< one image's triangles
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<Triangle> triangles;
};

class GridMaker {
public:
    GridMaker(const ReliefImages& images, const ReliefImage& image)
        : images_(images), image_(image), size_(images.box.high - images.box.low),
          texel_m_(std::max({size_.x, size_.y, size_.z}) / images.texels) {}

    [[nodiscard]] Grid make() {
        vertices_ = {images_.texels, images_.texels, none};
        for (int y = 0; y + 1 < images_.texels; ++y) {
            for (int x = 0; x + 1 < images_.texels; ++x) {
                add_square(x, y);
            }
        }
        return std::move(grid_);
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFU;

    [[nodiscard]] double depth_m(const glm::ivec2& at) const {
        return image_.depth.at(at.x, at.y) / depth_codes * size_[image_.axis];
    }
    [[nodiscard]] glm::dvec3 point(const glm::ivec2& at) const {
        const auto [across, down] = image_axes(image_.axis);
        const geometry::Box& box = images_.box;
        glm::dvec3 result;
        result[across] = box.low[across] + size_[across] * (at.x + 0.5) / images_.texels;
        result[down] = box.low[down] + size_[down] * (at.y + 0.5) / images_.texels;
        result[image_.axis] =
            image_.high ? box.high[image_.axis] - depth_m(at) : box.low[image_.axis] + depth_m(at);
        return result;
    }
    [[nodiscard]] static glm::dvec3 normal_of(const ReliefImage& image) {
        glm::dvec3 normal(0.0);
        normal[image.axis] = image.high ? 1.0 : -1.0;
        return normal;
    }

    /// Splits along the diagonal with the smaller depth step.
    void add_square(int x, int y) {
        const glm::ivec2 a(x, y);
        const glm::ivec2 b(x + 1, y);
        const glm::ivec2 c(x + 1, y + 1);
        const glm::ivec2 d(x, y + 1);
        if (std::abs(depth_m(a) - depth_m(c)) <= std::abs(depth_m(b) - depth_m(d))) {
            add_triangle({a, b, c});
            add_triangle({a, c, d});
        } else {
            add_triangle({a, b, d});
            add_triangle({b, c, d});
        }
    }

    void add_triangle(const std::array<glm::ivec2, 3>& corners) {
        double nearest = 2.0 * size_[image_.axis];
        double farthest = 0.0;
        for (const glm::ivec2& corner : corners) {
            if (image_.depth.at(corner.x, corner.y) == no_depth) {
                return;
            }
            nearest = std::min(nearest, depth_m(corner));
            farthest = std::max(farthest, depth_m(corner));
        }
        if (farthest - nearest > jump_texels * texel_m_) {
            return;
        }
        const std::array<glm::dvec3, 3> points{point(corners[0]), point(corners[1]), point(corners[2])};
        glm::dvec3 normal = glm::normalize(glm::cross(points[1] - points[0], points[2] - points[0]));
        const bool turned = glm::dot(normal, normal_of(image_)) < 0.0;
        normal = turned ? -normal : normal;
        if (shown_better((points[0] + points[1] + points[2]) / 3.0, normal)) {
            return;
        }
        Triangle triangle{vertex(corners[0]), vertex(corners[1]), vertex(corners[2])};
        if (turned) {
            std::swap(triangle[1], triangle[2]);
        }
        grid_.triangles.push_back(triangle);
    }

    [[nodiscard]] bool shown_better(const glm::dvec3& middle, const glm::dvec3& normal) const {
        const double own = glm::dot(normal, normal_of(image_));
        const glm::dvec3 in_box = (middle - images_.box.low) / size_;
        return std::any_of(images_.images.begin(), images_.images.end(), [&](const ReliefImage& other) {
            const double cosine = glm::dot(normal, normal_of(other));
            if (&other == &image_ || cosine <= own + squarer_by) {
                return false;
            }
            const auto [across, down] = image_axes(other.axis);
            const auto texel = [&](int axis) {
                return std::clamp(static_cast<int>(in_box[axis] * images_.texels), 0, images_.texels - 1);
            };
            const std::uint16_t depth = other.depth.at(texel(across), texel(down));
            const double expected = other.high ? 1.0 - in_box[other.axis] : in_box[other.axis];
            return depth != no_depth && std::abs(depth / depth_codes - expected) * size_[other.axis] <
                                            same_depth_texels * texel_m_;
        });
    }

    [[nodiscard]] std::uint32_t vertex(const glm::ivec2& at) {
        std::uint32_t& index = vertices_.at(at.x, at.y);
        if (index == none) {
            index = static_cast<std::uint32_t>(grid_.positions.size());
            grid_.positions.push_back(point(at));
            grid_.uvs.push_back((glm::vec2(at) + 0.5F) / static_cast<float>(images_.texels));
        }
        return index;
    }

    const ReliefImages& images_;
    const ReliefImage& image_;
    glm::dvec3 size_;
    double texel_m_;
    Grid grid_;
    image::Image<std::uint32_t> vertices_; ///< index of each texel's vertex, once it has one
};

/// Reduces the triangles as far as the tolerance allows.
void simplify(Grid& grid, double tolerance_m) {
    if (grid.triangles.empty()) {
        return;
    }
    std::vector<glm::vec3> positions; // relative to the middle, where float is finer
    for (const glm::dvec3& position : grid.positions) {
        positions.emplace_back(position - grid.positions.front());
    }
    std::vector<unsigned> indices;
    for (const Triangle& triangle : grid.triangles) {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    const float scale = meshopt_simplifyScale(&positions[0].x, positions.size(), sizeof(glm::vec3));
    const std::size_t count =
        meshopt_simplify(indices.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                         sizeof(glm::vec3), 0, static_cast<float>(tolerance_m) / scale, 0, nullptr);
    meshopt_optimizeVertexCache(indices.data(), indices.data(), count, positions.size());
    grid.triangles.clear();
    for (std::size_t k = 0; k < count; k += 3) {
        grid.triangles.push_back({indices[k], indices[k + 1], indices[k + 2]});
    }
}

} // namespace

bake::SourceMesh single_layer_mesh(const ReliefImages& images, double tolerance_m) {
    bake::SourceMesh mesh;
    for (const ReliefImage& image : images.images) {
        Grid grid = GridMaker(images, image).make();
        simplify(grid, tolerance_m);
        const auto material = static_cast<std::uint32_t>(mesh.materials.size());
        mesh.textures.push_back(
            {std::make_shared<const image::Image8>(image.colour), bake::Wrap::Clamp, bake::Wrap::Clamp});
        mesh.materials.push_back({.base_colour = glm::vec4(1.0F),
                                  .texture = static_cast<int>(material),
                                  .alpha_mask = false,
                                  .alpha_cutoff = 0.5F});
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), grid.positions.begin(), grid.positions.end());
        mesh.uvs.insert(mesh.uvs.end(), grid.uvs.begin(), grid.uvs.end());
        for (const Triangle& triangle : grid.triangles) {
            mesh.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
            mesh.triangle_materials.push_back(material);
        }
    }
    return mesh;
}

} // namespace frustumscreen::bench
