/// The parts of which sites are made: patches that are cut as finely as the site's detail asks for.
///
/// Frame    the site's own metres, as in nature; up is +Z.
/// Threads  values; one caller.
#pragma once

#include "app/simulation/site.h"

#include <functional>
#include <random>

namespace frustumscreen::simulation {

/// Rows of the site's texture.
enum class SiteMaterial : std::uint8_t {
    Grass,
    Field,
    Earth,
    Road,
    Rock,
    Plaster,
    Ochre,
    Rose,
    Stone,
    Tile,
    Slate,
    Wood,
    Dark,
    Leaf,
    Clay,
    Cloth
};
[[nodiscard]] std::shared_ptr<const image::Image8> site_texture();

class SiteBuilder {
public:
    /// The edges of a patch are `detail_m` long, or as long as the patch where that is shorter.
    SiteBuilder(double detail_m, std::uint64_t seed) : detail_m_(detail_m), random_(seed), seed_(seed) {}

    /// The next random number from `low` to `high`; one seed gives equal numbers on every machine.
    [[nodiscard]] double between(double low, double high);
    /// Smooth noise, -1..1, of features of about a metre at `per_m` = 1.
    [[nodiscard]] double noise(const glm::dvec3& at_m, double per_m) const;
    [[nodiscard]] double detail_m() const { return detail_m_; }

    using Surface = std::function<glm::dvec3(double u, double v)>;       ///< u, v: 0..1
    using Paint = std::function<SiteMaterial(const glm::dvec3& middle)>; ///< of each small quadrilateral
    struct Look {
        SiteMaterial material = SiteMaterial::Stone;
        double mottle = 0.12; ///< of the shade, by noise
        double brightness = 1.0;
        Paint paint = {}; ///< in place of `material`
    };
    /// Adds a surface; its outside is on the side of du x dv. It has at least `min_u` x `min_v` steps.
    void patch(const Surface& at, const glm::dvec2& lengths_m, const Look& look, int min_u = 1,
               int min_v = 1);
    /// A flat patch, from a corner along two edges.
    void quad(const glm::dvec3& corner, const glm::dvec3& along_u, const glm::dvec3& along_v,
              const Look& look);
    /// The square on which the site stands, at z = 0, seen from below.
    void base(double half_side_m);
    /// A box without its bottom. `yaw`: about its middle.
    void box(const glm::dvec3& foot, const glm::dvec3& size, double yaw, const Look& look);
    /// A body of revolution about a vertical axis, open below; `radius_at` takes 0 (below) to 1 (above).
    void turned(const glm::dvec3& foot, double height, const std::function<double(double)>& radius_at,
                const Look& look, int min_around, int min_up);
    /// Where a pennant may fly.
    void set_mast(const glm::dvec3& top_m) { mast_top_m_ = top_m; }
    /// One triangle, at the mast's top.
    void fly_pennant();

    [[nodiscard]] std::size_t triangles() const { return site_.indices.size() / 3; }
    /// Splits triangles at their middles until there are `triangles`, scales and centres; the builder is empty afterwards.
    [[nodiscard]] Site finish(std::size_t triangles, double size_m);

private:
    [[nodiscard]] std::uint32_t add(const glm::dvec3& at, SiteMaterial material, double shade);
    [[nodiscard]] double shade_of(const glm::dvec3& at, const glm::dvec3& normal, const Look& look) const;
    void split_to(std::size_t triangles);

    double detail_m_;
    std::mt19937_64 random_;
    std::uint64_t seed_;
    glm::dvec3 mast_top_m_{0.0};
    Site site_;
};

void build_hill_town(SiteBuilder& builder);
void build_excavation(SiteBuilder& builder);

} // namespace frustumscreen::simulation
