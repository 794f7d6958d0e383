#include "app/simulation/site_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::simulation {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int squares = 5;       ///< along each side
constexpr double square_m = 5.0; ///< side of a dug square
constexpr double baulk_m = 1.0;  ///< width of the ground between two squares
constexpr double border_m = 4.0; ///< of ground around all squares
constexpr double ground_m = 4.5; ///< above the base
constexpr double pitch_m = square_m + baulk_m;
constexpr double half_side_m = 0.5 * (squares * pitch_m - baulk_m) + border_m;

using Look = SiteBuilder::Look;

class Excavation {
public:
    explicit Excavation(SiteBuilder& builder) : builder_(builder) {}
    void build() {
        for (double& depth : depths_m_) {
            depth = 0.5 * std::floor(builder_.between(1.0, 7.0));
        }
        for (int row = 0; row < squares; ++row) {
            for (int column = 0; column < squares; ++column) {
                dig(column, row);
            }
        }
        ground();
        building();
        finds();
        heap({-half_side_m + 3.0, half_side_m - 3.0});
        builder_.set_mast({half_side_m - 1.0, half_side_m - 1.0, ground_m + 3.6});
        builder_.box({half_side_m - 1.0, half_side_m - 1.0, ground_m - 0.2}, {0.12, 0.12, 3.8}, 0.0,
                     {.material = SiteMaterial::Wood});
    }

private:
    [[nodiscard]] static double low_of(int square) { return -half_side_m + border_m + pitch_m * square; }
    [[nodiscard]] double depth_m(int column, int row) const {
        return depths_m_.at(static_cast<std::size_t>(row * squares + column));
    }
    [[nodiscard]] double rough(const glm::dvec2& at) const {
        return 0.10 * builder_.noise({at, 3.0}, 0.9) + 0.05 * builder_.noise({at, 7.0}, 3.0);
    }
    /// The height of the undug ground.
    [[nodiscard]] double height_at(const glm::dvec2& at) const {
        return ground_m + 0.4 * builder_.noise({at, 1.0}, 0.12) + rough(at);
    }
    /// The floor of a square, which is dug in two steps.
    [[nodiscard]] double floor_at(const glm::dvec2& at, int column, int row) const {
        const double edge = low_of(column) + 0.38 * square_m;
        const double depth = at.x < edge ? 0.5 * depth_m(column, row) : depth_m(column, row);
        return ground_m - depth + rough(at);
    }

    void dig(int column, int row) {
        const glm::dvec2 low(low_of(column), low_of(row));
        const double step = 0.38 * square_m;
        const auto floor = [&](double from, double to) {
            builder_.patch(
                [&](double u, double v) {
                    const glm::dvec2 at = low + glm::dvec2(glm::mix(from, to, u), v * square_m);
                    const double inside = glm::mix(from, to, std::clamp(u, 0.001, 0.999));
                    return glm::dvec3(at, floor_at({low.x + inside, at.y}, column, row));
                },
                {to - from, square_m}, {.material = SiteMaterial::Earth, .mottle = 0.4}, 6, 12);
        };
        floor(0.0, step);
        floor(step, square_m);
        const Look side{.material = SiteMaterial::Earth,
                        .mottle = 0.5,
                        .brightness = 0.85,
                        .paint = [this](const glm::dvec3& at) { // layers of the soil
                            const double layer = at.z + 0.25 * builder_.noise(at, 0.5);
                            return layer > ground_m - 0.45               ? SiteMaterial::Grass
                                   : std::fmod(layer + 40.0, 1.3) < 0.35 ? SiteMaterial::Clay
                                                                         : SiteMaterial::Earth;
                        }};
        const std::array<glm::dvec2, 4> corners{low, low + glm::dvec2(0.0, square_m), low + square_m,
                                                low + glm::dvec2(square_m, 0.0)};
        for (std::size_t k = 0; k < corners.size(); ++k) { // clockwise from above: their fronts look inward
            wall(corners[k], corners[(k + 1) % corners.size()], side, [&](const glm::dvec2& at) {
                // As deep as the deeper step, so that nothing shows between the two.
                return glm::dvec2(ground_m - depth_m(column, row) - 0.2, height_at(at));
            });
        }
        const glm::dvec2 riser(low.x + step, low.y + square_m);
        wall(
            riser, riser - glm::dvec2(0.0, square_m), side,
            [&](const glm::dvec2& at) {
                return glm::dvec2(floor_at({at.x + 0.002, at.y}, column, row),
                                  floor_at({at.x - 0.002, at.y}, column, row));
            },
            true);
    }
    /// `ends`: the lower and the upper height at a place.
    template <typename Ends>
    void wall(const glm::dvec2& from, const glm::dvec2& to, const Look& look, const Ends& ends,
              bool turned = false) {
        const glm::dvec2 a = turned ? to : from;
        const glm::dvec2 b = turned ? from : to;
        builder_.patch(
            [&](double u, double v) {
                const glm::dvec2 at = glm::mix(a, b, u);
                const glm::dvec2 heights = ends(at);
                return glm::dvec3(at, glm::mix(heights.x, heights.y, v));
            },
            {glm::distance(from, to), 2.0}, look, 12, 2);
    }

    /// The ground around and between the squares, in strips, and the cut through it at the site's edge.
    void ground() {
        const double whole = 2.0 * half_side_m;
        const auto strip = [this](const glm::dvec2& low, const glm::dvec2& size) {
            builder_.patch(
                [&](double u, double v) {
                    const glm::dvec2 at = low + glm::dvec2(u, v) * size;
                    return glm::dvec3(at, height_at(at));
                },
                size,
                {.material = SiteMaterial::Grass,
                 .mottle = 0.35,
                 .brightness = 1.0,
                 .paint =
                     [this](const glm::dvec3& at) {
                         return builder_.noise(at, 0.5) > 0.15 ? SiteMaterial::Earth : SiteMaterial::Grass;
                     }},
                2, 2);
        };
        double below = -half_side_m;
        for (int row = 0; row <= squares; ++row) {
            const double above = row < squares ? low_of(row) : half_side_m;
            strip({-half_side_m, below}, {whole, above - below});
            below = above + square_m;
            for (int column = 0; row < squares && column <= squares; ++column) {
                const double left = column == 0 ? -half_side_m : low_of(column - 1) + square_m;
                const double right = column < squares ? low_of(column) : half_side_m;
                strip({left, low_of(row)}, {right - left, square_m});
            }
        }
        builder_.base(half_side_m);
        const std::array<glm::dvec2, 4> corners{glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1),
                                                glm::dvec2(-1, 1)};
        for (std::size_t k = 0; k < corners.size(); ++k) {
            wall(half_side_m * corners[k], half_side_m * corners[(k + 1) % corners.size()],
                 {.material = SiteMaterial::Earth},
                 [this](const glm::dvec2& at) { return glm::dvec2(0.0, height_at(at)); });
        }
    }

    [[nodiscard]] double floor_under(const glm::dvec2& at) const {
        const glm::dvec2 in = (at + half_side_m - border_m) / pitch_m;
        const glm::ivec2 square(glm::floor(in));
        const glm::dvec2 part = (in - glm::dvec2(square)) * pitch_m;
        const bool dug = glm::all(glm::greaterThanEqual(square, glm::ivec2(0))) &&
                         glm::all(glm::lessThan(square, glm::ivec2(squares))) && part.x < square_m &&
                         part.y < square_m;
        return dug ? floor_at(at, square.x, square.y) : height_at(at);
    }
    /// Stones in courses, each turned and sized a little differently.
    void stone_wall(const glm::dvec2& from, const glm::dvec2& to, int courses) {
        const glm::dvec2 along = to - from;
        const double length = glm::length(along);
        const double yaw = std::atan2(along.y, along.x);
        const int stones = std::max(1, static_cast<int>(length / 0.62));
        for (int k = 0; k < stones; ++k) {
            const glm::dvec2 at = from + along * ((k + 0.5) / stones);
            const int here = std::max(1, courses - static_cast<int>(builder_.between(0.0, 2.6)));
            const double foot = floor_under(at) - 0.15;
            for (int course = 0; course < here; ++course) {
                const glm::dvec3 size(builder_.between(0.52, 0.62), builder_.between(0.6, 0.8),
                                      builder_.between(0.36, 0.42));
                builder_.box({at, foot + 0.38 * course}, size, yaw + builder_.between(-0.12, 0.12),
                             {.material = SiteMaterial::Stone,
                              .mottle = 0.3,
                              .brightness = builder_.between(0.8, 1.1)});
            }
        }
    }
    /// A house of four rooms, and a hall with two rows of columns.
    void building() {
        const std::array<glm::dvec4, 9> walls{
            glm::dvec4(-11, -9, -1, -9), glm::dvec4(-1, -9, -1, 2),  glm::dvec4(-1, 2, -11, 2),
            glm::dvec4(-11, 2, -11, -9), glm::dvec4(-6, -9, -6, -3), glm::dvec4(-11, -3.5, -1, -3.5),
            glm::dvec4(2, -12, 12, -12), glm::dvec4(2, 6, 12, 6),    glm::dvec4(2, -12, 2, 6)};
        for (const glm::dvec4& each : walls) {
            stone_wall({each.x, each.y}, {each.z, each.w}, 5);
        }
        for (int k = 0; k < 10; ++k) {
            const glm::dvec2 at(k % 2 == 0 ? 5.2 : 9.0, -10.0 + 3.4 * (k / 2));
            column(at, builder_.between(0.6, 3.4));
        }
    }
    void column(const glm::dvec2& at, double height) {
        const double foot = floor_under(at) - 0.1;
        builder_.box({at, foot}, {1.3, 1.3, 0.35}, 0.0, {.material = SiteMaterial::Stone, .mottle = 0.2});
        builder_.patch(
            [&](double u, double v) {
                const double angle = u < 1.0 ? turn * u : 0.0;
                const double radius = v >= 1.0 ? 0.0 : 0.46 - 0.04 * std::abs(std::sin(8.0 * angle));
                return glm::dvec3(at + radius * glm::dvec2(std::cos(angle), std::sin(angle)),
                                  foot + 0.3 + std::min(v * 1.05, 1.0) * height);
            },
            {turn * 0.46, height}, {.material = SiteMaterial::Plaster, .mottle = 0.3}, 16, 3);
    }
    void finds() {
        constexpr int jars = 26;
        for (int k = 0; k < jars; ++k) {
            const glm::dvec2 square(std::floor(builder_.between(0.0, squares)),
                                    std::floor(builder_.between(0.0, squares)));
            const glm::dvec2 at = -half_side_m + border_m + pitch_m * square +
                                  glm::dvec2(builder_.between(2.6, 4.4), builder_.between(0.6, 4.4));
            const double size = builder_.between(0.7, 1.3);
            builder_.turned(
                {at, floor_under(at) - 0.05}, size,
                [size](double v) {
                    const double belly = std::sin(std::numbers::pi * std::clamp(0.12 + 0.86 * v, 0.0, 1.0));
                    return v >= 1.0
                               ? 0.0
                               : size * (0.06 + 0.32 * belly + (v > 0.93 ? 0.06 : 0.0)); // closed at the top
                },
                {.material = SiteMaterial::Clay, .mottle = 0.15}, 10, 6);
        }
        constexpr int blocks = 60;
        for (int k = 0; k < blocks; ++k) { // blocks that fell from the walls
            const glm::dvec2 at(builder_.between(-12.0, 12.0), builder_.between(-13.0, 13.0));
            builder_.box(
                {at, floor_under(at) - 0.1},
                {builder_.between(0.3, 0.8), builder_.between(0.3, 0.6), builder_.between(0.2, 0.45)},
                builder_.between(0.0, turn), {.material = SiteMaterial::Rock, .mottle = 0.3});
        }
    }
    void heap(const glm::dvec2& at) {
        builder_.patch(
            [&](double u, double v) {
                const double angle = u < 1.0 ? turn * u : 0.0;
                const double radius = 2.9 * (1.0 - v);
                const glm::dvec2 place = at + radius * glm::dvec2(std::cos(angle), std::sin(angle));
                return glm::dvec3(place, height_at(place) - 0.1 + 1.9 * std::pow(v, 1.3) +
                                             0.12 * builder_.noise({place, 2.0}, 2.0));
            },
            {turn * 2.9, 3.4}, {.material = SiteMaterial::Earth, .mottle = 0.4}, 24, 8);
    }

    SiteBuilder& builder_;
    std::array<double, squares * squares> depths_m_{};
};

} // namespace

void build_excavation(SiteBuilder& builder) {
    Excavation(builder).build();
}

} // namespace frustumscreen::simulation
