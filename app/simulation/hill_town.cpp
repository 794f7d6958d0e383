#include "app/simulation/site_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace frustumscreen::simulation {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double half_side_m = 80.0; ///< of the ground
constexpr double ring_m = 47.0;      ///< radius of the town's wall
constexpr double top_m = 13.0;       ///< radius of the hill's flat top

using Look = SiteBuilder::Look;

/// The distance of a place from the middle of the road that winds up the hill, metres.
double off_road(const glm::dvec2& at) {
    const double radius = glm::length(at);
    const double angle = std::atan2(at.y, at.x) / turn;
    constexpr double pitch_m = 17.0;
    const double winding = radius / pitch_m - angle - 0.35;
    return pitch_m * std::abs(winding - std::round(winding));
}

class HillTown {
public:
    explicit HillTown(SiteBuilder& builder) : builder_(builder) {}
    void build() {
        ground();
        town_wall();
        church();
        houses();
        trees();
    }

private:
    struct Plot {
        glm::dvec2 at;
        double radius = 0.0;
    };

    [[nodiscard]] double height_at(const glm::dvec2& at) const {
        const double radius = glm::length(at * glm::dvec2(1.0, 1.15));
        const double beyond = std::fmax(radius - top_m, 0.0) / 30.0;
        const double hill = 30.0 * std::exp(-beyond * beyond);
        const double rough = 2.2 * builder_.noise({at, 0.0}, 0.045) + 0.7 * builder_.noise({at, 5.0}, 0.16) +
                             0.16 * builder_.noise({at, 9.0}, 0.6);
        const double flat = std::clamp((radius - 9.0) / 8.0, 0.0, 1.0);
        return 5.0 + hill + flat * rough;
    }
    [[nodiscard]] glm::dvec3 on_ground(const glm::dvec2& at) const { return {at, height_at(at)}; }

    void ground() {
        const auto paint = [this](const glm::dvec3& at) {
            const glm::dvec2 place(at);
            const double radius = glm::length(place);
            if (radius < ring_m + 6.0 && off_road(place) < 1.7) {
                return SiteMaterial::Road;
            }
            if (radius < top_m) {
                return SiteMaterial::Road;
            }
            if (radius < ring_m) {
                return builder_.noise(at, 0.12) > 0.1 ? SiteMaterial::Grass : SiteMaterial::Earth;
            }
            const glm::ivec2 field(glm::floor(place / glm::dvec2(21.0, 14.0) + 0.31));
            if (radius > ring_m + 9.0 && (field.x * 3 + field.y * 5) % 4 == 1) {
                return SiteMaterial::Field;
            }
            return builder_.noise(at, 0.2) > 0.45 ? SiteMaterial::Rock : SiteMaterial::Grass;
        };
        const double side = 2.0 * half_side_m;
        builder_.patch(
            [&](double u, double v) { return on_ground(half_side_m * (2.0 * glm::dvec2(u, v) - 1.0)); },
            {side, side},
            {.material = SiteMaterial::Grass, .mottle = 0.25, .brightness = 1.0, .paint = paint}, 90, 90);
        builder_.base(half_side_m);
        const std::array<glm::dvec2, 4> corners{glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1),
                                                glm::dvec2(-1, 1)};
        for (std::size_t k = 0; k < corners.size(); ++k) { // the cut through the ground
            const glm::dvec2 from = half_side_m * corners[k];
            const glm::dvec2 to = half_side_m * corners[(k + 1) % corners.size()];
            builder_.patch(
                [&](double u, double v) {
                    const glm::dvec2 at = glm::mix(from, to, u);
                    return glm::dvec3(at, v * height_at(at));
                },
                {side, 5.0}, {.material = SiteMaterial::Earth}, 90, 1);
        }
    }

    /// A wall from the ground up between two places, with battlements.
    void wall_between(const glm::dvec2& from, const glm::dvec2& to, double height, double thick) {
        const glm::dvec2 along = to - from;
        const double length = glm::length(along);
        const glm::dvec2 out = thick * glm::dvec2(along.y, -along.x) / length;
        const double foot = std::min(height_at(from), height_at(to)) - 1.5;
        const double top = std::max(height_at(from), height_at(to)) + height;
        const Look look{.material = SiteMaterial::Stone, .mottle = 0.3};
        const glm::dvec3 low(from + 0.5 * out, foot);
        const glm::dvec3 up(0.0, 0.0, top - foot);
        const glm::dvec3 step(along, 0.0);
        builder_.quad(low, step, up, look);
        builder_.quad(low + step - glm::dvec3(out, 0.0), -step, up, look);
        builder_.quad(low + up, step, -glm::dvec3(out, 0.0), look);
        const int merlons = std::max(1, static_cast<int>(length / 2.2));
        for (int k = 0; k < merlons; ++k) {
            const glm::dvec2 at = from + along * ((k + 0.5) / merlons) + 0.3 * out;
            builder_.box({at, top - 0.02}, {1.1, 0.4 * thick, 0.9}, std::atan2(along.y, along.x), look);
        }
    }
    void tower(const glm::dvec2& at, double radius, double height, SiteMaterial roof) {
        const double foot = height_at(at) - 2.0;
        builder_.turned(
            {at, foot}, height + 2.0, [&](double v) { return radius * (1.0 + 0.12 * (1.0 - v)); },
            {.material = SiteMaterial::Stone, .mottle = 0.3}, 14, 2);
        for (int k = 0; k < 7; ++k) { // slits under the roof
            const double yaw = turn * k / 7.0;
            const glm::dvec2 out(std::cos(yaw), std::sin(yaw));
            builder_.box({at + radius * out, foot + height - 0.6}, {0.5, 0.7, 1.4}, yaw,
                         {.material = SiteMaterial::Dark});
        }
        builder_.turned(
            {at, foot + height + 2.0}, 1.35 * radius, [&](double v) { return 1.25 * radius * (1.0 - v); },
            {.material = roof, .mottle = 0.25}, 14, 2);
        builder_.turned(
            {at, foot + height + 1.8}, 0.2, [&](double v) { return radius * (1.0 + 0.25 * v); },
            {.material = SiteMaterial::Wood}, 14, 1);
    }
    void town_wall() {
        constexpr int towers = 11;
        std::vector<glm::dvec2> places;
        for (int k = 0; k < towers; ++k) {
            const double angle = turn * (k + builder_.between(-0.15, 0.15)) / towers;
            places.push_back(builder_.between(0.94, 1.06) * ring_m *
                             glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        for (std::size_t k = 0; k < places.size(); ++k) {
            const glm::dvec2 from = places[k];
            const glm::dvec2 to = places[(k + 1) % places.size()];
            if (k != 8) { // the gate's side is open towards the road, between two low walls
                constexpr int parts = 4;
                for (int part = 0; part < parts; ++part) {
                    wall_between(glm::mix(from, to, part / 4.0), glm::mix(from, to, (part + 1) / 4.0), 4.6,
                                 1.7);
                }
            } else {
                wall_between(from, glm::mix(from, to, 0.36), 4.6, 1.7);
                wall_between(glm::mix(from, to, 0.64), to, 4.6, 1.7);
                tower(glm::mix(from, to, 0.36), 2.4, 8.5, SiteMaterial::Slate);
                tower(glm::mix(from, to, 0.64), 2.4, 8.5, SiteMaterial::Slate);
            }
            tower(from, builder_.between(2.4, 3.2), builder_.between(8.0, 11.0), SiteMaterial::Tile);
            plots_.push_back({from, 5.0});
        }
    }

    /// One wall of a house, from its lower left corner as seen from outside, with recessed windows.
    void house_wall(const glm::dvec3& corner, const glm::dvec3& along, double height, const Look& look) {
        const double length = glm::length(along);
        const glm::dvec3 right = along / length;
        const glm::dvec3 up(0.0, 0.0, 1.0);
        const int columns = builder_.detail_m() < 1.5 ? static_cast<int>(length / 2.3) : 0;
        const int floors = static_cast<int>((height - 2.4) / 2.6);
        if (columns < 1 || floors < 1) {
            builder_.quad(corner, along, height * up, look);
            return;
        }
        constexpr double sill = 3.1; // the foundation is below the ground
        constexpr double high = 1.25;
        constexpr double wide = 0.95;
        const glm::dvec3 inward = 0.3 * glm::cross(up, right);
        const double pitch = length / columns;
        double at_height = 0.0;
        for (int floor = 0; floor < floors; ++floor) {
            const double low = sill + 2.6 * floor;
            builder_.quad(corner + at_height * up, along, (low - at_height) * up, look);
            double at = 0.0;
            for (int column = 0; column < columns; ++column) {
                const double left = (column + 0.5) * pitch - 0.5 * wide;
                builder_.quad(corner + at * right + low * up, (left - at) * right, high * up, look);
                window(corner + left * right + low * up, wide * right, high * up, inward);
                at = left + wide;
            }
            builder_.quad(corner + at * right + low * up, (length - at) * right, high * up, look);
            at_height = low + high;
        }
        builder_.quad(corner + at_height * up, along, (height - at_height) * up, look);
    }
    void window(const glm::dvec3& corner, const glm::dvec3& across, const glm::dvec3& up,
                const glm::dvec3& inward) {
        const Look reveal{.material = SiteMaterial::Stone};
        builder_.quad(corner, inward, up, {.material = SiteMaterial::Dark});
        builder_.quad(corner + across + inward, -inward, up, reveal);
        builder_.quad(corner, across, inward, reveal);
        builder_.quad(corner + up + inward, across, -inward, {.material = SiteMaterial::Dark});
        builder_.quad(corner + inward, across, up, {.material = SiteMaterial::Dark});
    }
    /// Half of a roof: from the eaves' left end, along the eaves and up to the ridge, of rows of tiles.
    void roof_half(const glm::dvec3& eaves, const glm::dvec3& along, const glm::dvec3& up, const Look& look) {
        const glm::dvec3 out = glm::normalize(glm::cross(along, up));
        const double rows = std::round(glm::length(up) / 0.8);
        const auto at = [&](double u, double v) {
            const double row = v * rows - std::floor(v * rows);
            const double wave = 0.06 * std::sin(turn * u * glm::length(along) / 1.1);
            const bool inside = u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0;
            const double raised = inside ? 0.08 + 0.16 * (1.0 - row) + wave : 0.0;
            return eaves + u * along + v * up + raised * out;
        };
        builder_.patch(at, {glm::length(along), glm::length(up)}, look);
    }
    void house(const glm::dvec2& at, const glm::dvec2& size, double height, double yaw, const Look& walls,
               const Look& roof) {
        const glm::dvec3 x(std::cos(yaw), std::sin(yaw), 0.0);
        const glm::dvec3 y(-std::sin(yaw), std::cos(yaw), 0.0);
        const glm::dvec3 up(0.0, 0.0, 1.0);
        double foot = height_at(at);
        for (const glm::dvec2& corner :
             {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
            foot = std::min(
                foot, height_at(at + glm::dvec2(0.5 * (corner.x * size.x * x + corner.y * size.y * y))));
        }
        const glm::dvec3 low = glm::dvec3(at, foot - 1.2) - 0.5 * (size.x * x + size.y * y);
        const glm::dvec3 along_x = size.x * x;
        const glm::dvec3 along_y = size.y * y;
        house_wall(low, along_x, height, walls);
        house_wall(low + along_x, along_y, height, walls);
        house_wall(low + along_x + along_y, -along_x, height, walls);
        house_wall(low + along_y, -along_y, height, walls);
        const double rise = 0.36 * size.y;
        const glm::dvec3 eaves = low + height * up;
        const glm::dvec3 ridge = eaves + 0.5 * along_y + rise * up;
        for (const bool far : {false, true}) { // gables
            const glm::dvec3 from = far ? eaves + along_x : eaves + along_y;
            const glm::dvec3 across = far ? along_y : -along_y;
            const glm::dvec3 peak = far ? ridge + along_x : ridge;
            builder_.patch([&](double u, double v) { return glm::mix(from + u * across, peak, v); },
                           {size.y, rise}, walls);
        }
        constexpr double over = 0.55;
        const glm::dvec3 slope = 0.5 * along_y + rise * up;
        const glm::dvec3 slope_back = -0.5 * along_y + rise * up;
        const double longer = 1.0 + over / glm::length(slope);
        const glm::dvec3 wide = along_x + 2.0 * over * x;
        roof_half(ridge - longer * slope - over * x, wide, longer * slope, roof);
        roof_half(ridge - longer * slope_back + (size.x + over) * x, -wide, longer * slope_back, roof);
        // The undersides enclose the roof, a little below the tiles: both have the corners' triangles.
        const glm::dvec3 under = ridge - 0.03 * up;
        builder_.quad(under - longer * slope + (size.x + over) * x, -wide, longer * slope,
                      {.material = SiteMaterial::Wood});
        builder_.quad(under - longer * slope_back - over * x, wide, longer * slope_back,
                      {.material = SiteMaterial::Wood});
        builder_.box(glm::dvec3(ridge + 0.25 * along_x + 0.18 * along_y - 0.3 * rise * up),
                     {0.8, 0.8, 1.5 + 0.3 * rise}, yaw, {.material = SiteMaterial::Stone});
    }

    void church() {
        const Look walls{.material = SiteMaterial::Plaster, .mottle = 0.08};
        const Look roof{.material = SiteMaterial::Slate, .mottle = 0.2};
        house({1.5, 0.0}, {15.0, 7.5}, 10.0, 0.3, walls, roof);
        const glm::dvec2 at(-7.6, -2.6);
        const double foot = height_at(at) - 1.0;
        builder_.box({at, foot}, {5.0, 5.0, 21.0}, 0.3, {.material = SiteMaterial::Stone, .mottle = 0.25});
        for (int side = 0; side < 4; ++side) { // the bells' openings
            const double yaw = 0.3 + 0.25 * turn * side;
            const glm::dvec2 out(std::cos(yaw), std::sin(yaw));
            builder_.box({at + 2.4 * out, foot + 16.0}, {0.5, 1.4, 3.2}, yaw,
                         {.material = SiteMaterial::Dark});
        }
        builder_.turned(
            {at, foot + 21.0}, 10.0,
            [](double v) { return 3.4 * (1.0 - v) * (1.0 - 0.25 * std::sin(0.5 * turn * v)); }, roof, 8, 2);
        builder_.set_mast({at, foot + 31.4});
        builder_.box({at, foot + 30.6}, {0.25, 0.25, 1.2}, 0.0, {.material = SiteMaterial::Wood});
        plots_.push_back({{0.0, 0.0}, 11.0});
    }

    [[nodiscard]] bool is_free(const glm::dvec2& at, double radius) const {
        return std::none_of(plots_.begin(), plots_.end(), [&](const Plot& plot) {
            return glm::distance(plot.at, at) < plot.radius + radius;
        });
    }
    void houses() {
        constexpr int wanted = 130;
        constexpr int tries = 6000;
        int built = 0;
        for (int k = 0; k < tries && built < wanted; ++k) {
            const double angle = builder_.between(0.0, turn);
            const double radius = std::sqrt(builder_.between(9.0 * 9.0, 58.0 * 58.0));
            const glm::dvec2 at = radius * glm::dvec2(std::cos(angle), std::sin(angle));
            const glm::dvec2 size(builder_.between(5.5, 9.5), builder_.between(4.5, 6.5));
            const double height = builder_.between(6.5, 12.0);
            const double turned_by = builder_.between(-0.25, 0.25);
            const double tone = builder_.between(0.0, 1.0);
            const double bright = builder_.between(0.82, 1.08);
            const double around = 0.46 * (size.x + size.y) / 2.0;
            if (off_road(at) < 1.8 + 0.5 * size.y || std::abs(radius - ring_m) < 5.5 ||
                !is_free(at, around)) {
                continue;
            }
            const SiteMaterial plaster = tone < 0.45   ? SiteMaterial::Plaster
                                         : tone < 0.65 ? SiteMaterial::Ochre
                                         : tone < 0.82 ? SiteMaterial::Rose
                                                       : SiteMaterial::Stone;
            house(at, size, height, angle + 0.25 * turn + turned_by,
                  {.material = plaster, .mottle = 0.1, .brightness = bright},
                  {.material = tone > 0.9 ? SiteMaterial::Slate : SiteMaterial::Tile,
                   .mottle = 0.3,
                   .brightness = bright});
            plots_.push_back({at, around});
            ++built;
        }
    }
    void tree(const glm::dvec2& at, double height) {
        const glm::dvec3 foot = on_ground(at);
        const double seed = builder_.between(0.0, 100.0);
        builder_.turned(
            foot - glm::dvec3(0.0, 0.0, 0.3), 0.45 * height,
            [&](double v) { return 0.06 * height * (1.2 - v); }, {.material = SiteMaterial::Wood}, 5, 1);
        const bool slender = seed > 72.0;
        const double wide = slender ? 0.16 : 0.36;
        const glm::dvec3 middle = foot + glm::dvec3(0.0, 0.0, (slender ? 0.55 : 0.66) * height);
        const double high = slender ? 0.45 * height : 0.34 * height;
        builder_.patch(
            [&](double u, double v) {
                const double angle = u < 1.0 ? turn * u : 0.0;
                const double lat = std::numbers::pi * (v - 0.5);
                const glm::dvec3 out(std::cos(lat) * std::cos(angle), std::cos(lat) * std::sin(angle),
                                     std::sin(lat));
                const double lumps = 1.0 + 0.22 * builder_.noise(3.0 * out + seed, 1.0) +
                                     0.16 * builder_.noise(8.0 * out + seed, 1.0);
                return middle + lumps * out * glm::dvec3(wide * height, wide * height, high);
            },
            {turn * wide * height, 2.0 * high},
            {.material = SiteMaterial::Leaf, .mottle = 0.4, .brightness = builder_.between(0.75, 1.1)}, 7, 5);
    }
    void trees() {
        constexpr int wanted = 240;
        constexpr int tries = 8000;
        int planted = 0;
        for (int k = 0; k < tries && planted < wanted; ++k) {
            const glm::dvec2 at(builder_.between(-77.0, 77.0), builder_.between(-77.0, 77.0));
            const double radius = glm::length(at);
            const double height = builder_.between(4.0, 8.5);
            if (off_road(at) < 2.5 || std::abs(radius - ring_m) < 3.5 || radius < top_m - 2.0 ||
                !is_free(at, 0.3 * height) || (radius > ring_m && builder_.noise({at, 0.0}, 0.05) < -0.1)) {
                continue;
            }
            tree(at, height);
            plots_.push_back({at, 0.22 * height});
            ++planted;
        }
    }

    SiteBuilder& builder_;
    std::vector<Plot> plots_;
};

} // namespace

void build_hill_town(SiteBuilder& builder) {
    HillTown(builder).build();
}

} // namespace frustumscreen::simulation
