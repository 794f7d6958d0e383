#include "app/simulation/site_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::simulation {

namespace {

constexpr int shades = 256;    ///< texels of a material's row
constexpr int row_texels = 16; ///< a texel of the coarsest mip level covers as many
constexpr std::size_t materials = 16;

struct Tones {
    glm::vec3 dark, light; ///< sRGB codes
};
constexpr std::array<Tones, materials> tones{{
    {{26, 40, 14}, {150, 176, 84}},   // grass
    {{60, 46, 14}, {224, 196, 104}},  // field
    {{40, 26, 14}, {176, 132, 86}},   // earth
    {{58, 50, 40}, {222, 206, 176}},  // road
    {{42, 40, 38}, {182, 174, 162}},  // rock
    {{88, 80, 70}, {250, 244, 230}},  // plaster
    {{84, 54, 22}, {240, 206, 140}},  // ochre
    {{84, 46, 36}, {236, 180, 158}},  // rose
    {{54, 48, 40}, {216, 202, 176}},  // stone
    {{60, 18, 8}, {214, 110, 66}},    // tile
    {{24, 28, 34}, {130, 140, 152}},  // slate
    {{36, 22, 10}, {150, 108, 68}},   // wood
    {{8, 8, 10}, {74, 76, 84}},       // dark
    {{10, 26, 8}, {104, 144, 58}},    // leaf
    {{70, 30, 14}, {226, 136, 84}},   // clay
    {{110, 20, 20}, {244, 236, 220}}, // cloth
}};

/// Mixes the bits of a whole number (Steele 2014, SplitMix64) into a number in -1..1.
double hashed(std::uint64_t value) {
    value += 0x9E3779B97F4A7C15U;
    value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
    value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
    value ^= value >> 31U;
    return static_cast<double>(value >> 11U) * 0x1p-52 - 1.0;
}

} // namespace

std::shared_ptr<const image::Image8> site_texture() {
    auto texture = std::make_shared<image::Image8>(shades, static_cast<int>(materials) * row_texels);
    for (int y = 0; y < texture->height; ++y) {
        const Tones& of = tones.at(static_cast<std::size_t>(y / row_texels));
        for (int x = 0; x < shades; ++x) {
            const glm::vec3 code =
                glm::round(glm::mix(of.dark, of.light, static_cast<float>(x) / (shades - 1)));
            texture->at(x, y) = {glm::u8vec3(code), 255};
        }
    }
    return texture;
}

double SiteBuilder::between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11U) * 0x1p-53);
}

double SiteBuilder::noise(const glm::dvec3& at_m, double per_m) const {
    const glm::dvec3 at = per_m * at_m;
    const glm::dvec3 low = glm::floor(at);
    const glm::dvec3 part = at - low;
    const glm::dvec3 smooth = part * part * (3.0 - 2.0 * part);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        const auto cell = glm::i64vec3(low) + glm::i64vec3(step);
        const auto key =
            static_cast<std::uint64_t>(cell.x * 73856093 ^ cell.y * 19349663 ^ cell.z * 83492791);
        const glm::dvec3 share = glm::mix(1.0 - smooth, smooth, glm::dvec3(step));
        sum += share.x * share.y * share.z * hashed(key + 977U * seed_);
    }
    return sum;
}

std::uint32_t SiteBuilder::add(const glm::dvec3& at, SiteMaterial material, double shade) {
    const double inside = std::clamp(shade, 0.0, 1.0) * (shades - 1) + 0.5;
    site_.positions.emplace_back(at);
    site_.texture_places.emplace_back(inside / shades,
                                      (static_cast<double>(material) + 0.5) / static_cast<double>(materials));
    return static_cast<std::uint32_t>(site_.positions.size() - 1);
}

double SiteBuilder::shade_of(const glm::dvec3& at, const glm::dvec3& normal, const Look& look) const {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.55, -0.45, 0.75));
    const double lit = 0.26 + 0.24 * (0.5 + 0.5 * normal.z) + 0.5 * std::fmax(glm::dot(normal, sun), 0.0);
    const double mottled = noise(at, 0.45) * 0.6 + noise(at, 1.7) * 0.4;
    return look.brightness * lit * (1.0 + look.mottle * mottled);
}

void SiteBuilder::patch(const Surface& at, const glm::dvec2& lengths_m, const Look& look, int min_u,
                        int min_v) {
    const auto steps = [this](double length, int least) {
        return std::max(least, static_cast<int>(std::ceil(length / detail_m_ - 1e-9)));
    };
    const int columns = steps(lengths_m.x, min_u);
    const int rows = steps(lengths_m.y, min_v);
    std::vector<glm::dvec3> points;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            points.push_back(at(static_cast<double>(column) / columns, static_cast<double>(row) / rows));
        }
    }
    const auto point = [&](int column, int row) -> const glm::dvec3& {
        return points[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
                      static_cast<std::size_t>(column)];
    };
    const auto normal_at = [&](int column, int row) {
        const glm::dvec3 along_u =
            point(std::min(column + 1, columns), row) - point(std::max(column - 1, 0), row);
        const glm::dvec3 along_v =
            point(column, std::min(row + 1, rows)) - point(column, std::max(row - 1, 0));
        const glm::dvec3 across = glm::cross(along_u, along_v);
        const double length = glm::length(across);
        return length > 0.0 ? across / length : glm::dvec3(0.0, 0.0, 1.0);
    };
    // A vertex for each material that meets there.
    std::vector<std::array<std::uint32_t, materials>> vertices(points.size());
    const auto vertex = [&](int column, int row, SiteMaterial material) {
        const auto k = static_cast<std::size_t>(&point(column, row) - points.data());
        std::uint32_t& number = vertices[k].at(static_cast<std::size_t>(material));
        if (number == 0) {
            number = add(points[k], material, shade_of(points[k], normal_at(column, row), look)) + 1;
        }
        return number - 1;
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const glm::dvec3 middle = 0.5 * (point(column, row) + point(column + 1, row + 1));
            const SiteMaterial material = look.paint ? look.paint(middle) : look.material;
            const std::uint32_t a = vertex(column, row, material);
            const std::uint32_t b = vertex(column + 1, row, material);
            const std::uint32_t c = vertex(column + 1, row + 1, material);
            const std::uint32_t d = vertex(column, row + 1, material);
            if (point(column, row) != point(column + 1, row)) {
                site_.indices.insert(site_.indices.end(), {a, b, c});
            }
            if (point(column + 1, row + 1) != point(column, row + 1)) {
                site_.indices.insert(site_.indices.end(), {a, c, d});
            }
        }
    }
}

void SiteBuilder::quad(const glm::dvec3& corner, const glm::dvec3& along_u, const glm::dvec3& along_v,
                       const Look& look) {
    patch([&](double u, double v) { return corner + u * along_u + v * along_v; },
          {glm::length(along_u), glm::length(along_v)}, look);
}

void SiteBuilder::base(double half_side_m) {
    const double h = half_side_m;
    patch([h](double u, double v) { return glm::dvec3(h - 2.0 * h * u, 2.0 * h * v - h, 0.0); }, {0.0, 0.0},
          {.material = SiteMaterial::Earth, .brightness = 0.7});
}

void SiteBuilder::box(const glm::dvec3& foot, const glm::dvec3& size, double yaw, const Look& look) {
    const glm::dvec3 x = size.x * glm::dvec3(std::cos(yaw), std::sin(yaw), 0.0);
    const glm::dvec3 y = size.y * glm::dvec3(-std::sin(yaw), std::cos(yaw), 0.0);
    const glm::dvec3 z(0.0, 0.0, size.z);
    const glm::dvec3 low = foot - 0.5 * (x + y);
    quad(low, x, z, look);
    quad(low + x, y, z, look);
    quad(low + x + y, -x, z, look);
    quad(low + y, -y, z, look);
    quad(low + z, x, y, look);
}

void SiteBuilder::turned(const glm::dvec3& foot, double height,
                         const std::function<double(double)>& radius_at, const Look& look, int min_around,
                         int min_up) {
    double widest = 0.0;
    for (int k = 0; k <= 8; ++k) {
        widest = std::fmax(widest, radius_at(k / 8.0));
    }
    constexpr double turn = 2.0 * std::numbers::pi;
    patch(
        [&](double u, double v) {
            const double angle = u < 1.0 ? turn * u : 0.0;
            const double radius = radius_at(v);
            return foot + glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), v * height);
        },
        {turn * widest, height}, look, min_around, min_up);
}

void SiteBuilder::fly_pennant() {
    constexpr double length = 2.4;
    const std::array corners{mast_top_m_, mast_top_m_ + length * glm::dvec3(1.0, 0.2, -0.25),
                             mast_top_m_ + length * glm::dvec3(0.0, 0.0, -0.5)};
    for (const glm::dvec3& corner : corners) {
        site_.indices.push_back(add(corner, SiteMaterial::Cloth, 0.8));
    }
}

void SiteBuilder::split_to(std::size_t triangles) {
    const std::size_t whole = this->triangles();
    for (std::size_t k = 0; this->triangles() + 1 < triangles; k = (k + 1) % whole) { // each split adds two
        const std::array<std::uint32_t, 3> corners{site_.indices[3 * k], site_.indices[3 * k + 1],
                                                   site_.indices[3 * k + 2]};
        glm::vec3 at(0.0F);
        glm::vec2 place(0.0F);
        for (const std::uint32_t corner : corners) {
            at += site_.positions[corner] / 3.0F;
            place += site_.texture_places[corner] / 3.0F;
        }
        const auto middle = static_cast<std::uint32_t>(site_.positions.size());
        site_.positions.push_back(at);
        site_.texture_places.push_back(place);
        site_.indices[3 * k + 2] = middle;
        site_.indices.insert(site_.indices.end(),
                             {corners[1], corners[2], middle, corners[2], corners[0], middle});
    }
}

Site SiteBuilder::finish(std::size_t triangles, double size_m) {
    split_to(triangles);
    glm::vec3 low = site_.positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& at : site_.positions) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::vec3 extent = high - low;
    const auto scale = static_cast<float>(size_m) / std::max({extent.x, extent.y, extent.z});
    const glm::vec3 origin(0.5F * (low.x + high.x), 0.5F * (low.y + high.y), low.z);
    for (glm::vec3& at : site_.positions) {
        at = scale * (at - origin);
    }
    site_.texture = site_texture();
    return std::exchange(site_, {});
}

} // namespace frustumscreen::simulation
