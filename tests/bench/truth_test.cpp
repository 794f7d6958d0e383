#include "app/bench/truth/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

namespace frustumscreen::bench {
namespace {

/// A fan of a few dozen random triangles inside a unit box, in three materials: textured, masked, plain.
std::shared_ptr<bake::SourceMesh> random_mesh(std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    const auto random = [&engine] { return static_cast<double>(engine() % 100000) / 100000.0; };
    auto mesh = std::make_shared<bake::SourceMesh>();
    auto image = std::make_shared<image::Image8>(5, 3);
    for (glm::u8vec4& texel : image->texels) {
        texel = {engine() % 256, engine() % 256, engine() % 256, engine() % 256};
    }
    mesh->textures = {{image, bake::Wrap::Repeat, bake::Wrap::Clamp},
                      {image, bake::Wrap::Mirror, bake::Wrap::Repeat}};
    mesh->materials = {{{0.9F, 0.7F, 1.0F, 1.0F}, 0, false, 0.5F},
                       {{1.0F, 1.0F, 1.0F, 0.9F}, 1, true, 0.4F},
                       {{0.2F, 0.5F, 0.8F, 0.1F}, -1, false, 0.5F}};
    for (std::uint32_t k = 0; k < 60; ++k) {
        const glm::dvec3 centre(random(), random(), random());
        for (int corner = 0; corner < 3; ++corner) {
            mesh->positions.push_back(centre + 0.4 * (glm::dvec3(random(), random(), random()) - 0.5));
            mesh->uvs.emplace_back(4.0 * random() - 2.0, 4.0 * random() - 2.0);
            mesh->colours.emplace_back(random(), random(), random(), 1.0);
        }
        mesh->triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        mesh->triangle_materials.push_back(k % 3);
    }
    return mesh;
}

double linear_of(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
int code_of(double linear) {
    const double c = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255.0 * std::fmin(std::fmax(c, 0.0), 1.0)));
}

/// Straightforward bilinear filter: a tent of one texel over the wrapped plane of texels.
glm::dvec4 texture_at(const bake::SourceTexture& texture, double u, double v) {
    const image::Image8& image = *texture.image;
    const auto wrap = [](int k, int n, bake::Wrap mode) {
        if (mode == bake::Wrap::Clamp) {
            return k < 0 ? 0 : k >= n ? n - 1 : k;
        }
        while (k < 0) {
            k += 2 * n;
        }
        k %= 2 * n;
        return mode == bake::Wrap::Repeat ? k % n : k < n ? k : 2 * n - 1 - k;
    };
    glm::dvec4 sum(0.0);
    for (int j = -20; j < 20; ++j) {
        for (int i = -20; i < 20; ++i) {
            const double tent = std::fmax(0.0, 1.0 - std::abs(u * image.width - (i + 0.5))) *
                                std::fmax(0.0, 1.0 - std::abs(v * image.height - (j + 0.5)));
            if (tent > 0.0) {
                const glm::u8vec4 t =
                    image.at(wrap(i, image.width, texture.wrap_u), wrap(j, image.height, texture.wrap_v));
                sum += tent * glm::dvec4(linear_of(t.r), linear_of(t.g), linear_of(t.b), t.a / 255.0);
            }
        }
    }
    return sum;
}

struct BruteHit {
    double t = 0.0;
    double margin = 0.0; ///< minimum of: barycentric distance to an edge, alpha's distance to the cut-off
    glm::dvec3 point{0.0};
    glm::dvec3 linear{0.0};
};

/// Moeller & Trumbore 1997 over every triangle, in double.
std::optional<BruteHit> brute_cast(const bake::SourceMesh& mesh, const glm::dmat4& placed, glm::dvec3 o,
                                   glm::dvec3 d, double& min_margin) {
    std::optional<BruteHit> best;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = glm::dvec3(placed * glm::dvec4(mesh.positions[mesh.triangles[k][c]], 1.0));
        }
        const glm::dvec3 e1 = p[1] - p[0];
        const glm::dvec3 e2 = p[2] - p[0];
        const glm::dvec3 h = glm::cross(d, e2);
        const double det = glm::dot(e1, h);
        const glm::dvec3 s = o - p[0];
        const double u = glm::dot(s, h) / det;
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(d, q) / det;
        const double t = glm::dot(e2, q) / det;
        const double inside = std::fmin(u, std::fmin(v, 1.0 - u - v));
        if (!(t > 0.0)) {
            continue;
        }
        min_margin = std::fmin(min_margin, std::abs(inside));
        if (inside < 0.0) {
            continue;
        }
        const auto [a, b, c] = mesh.triangles[k];
        const bake::SourceMaterial& material = mesh.materials[mesh.triangle_materials[k]];
        glm::dvec4 colour(material.base_colour);
        const double w = 1.0 - u - v;
        colour *= w * glm::dvec4(mesh.colours[a]) + u * glm::dvec4(mesh.colours[b]) +
                  v * glm::dvec4(mesh.colours[c]);
        if (material.texture >= 0) {
            const glm::dvec2 uv =
                w * glm::dvec2(mesh.uvs[a]) + u * glm::dvec2(mesh.uvs[b]) + v * glm::dvec2(mesh.uvs[c]);
            colour *= texture_at(mesh.textures[static_cast<std::size_t>(material.texture)], uv.x, uv.y);
        }
        if (material.alpha_mask) {
            min_margin = std::fmin(min_margin, std::abs(colour.a - material.alpha_cutoff));
            if (colour.a < material.alpha_cutoff) {
                continue;
            }
        }
        if (!best || t < best->t) {
            best = BruteHit{t, 0.0, o + t * d, glm::dvec3(colour)};
        }
    }
    return best;
}

/// First face of the prop that a ray crosses from outside, from the corners' winding alone.
std::optional<std::pair<glm::dvec3, std::size_t>> brute_prop(const geometry::PropShape& prop, glm::dvec3 o,
                                                             glm::dvec3 d) {
    for (std::size_t f = 0; f < prop.faces.size(); ++f) {
        const auto& c = prop.faces[f].corners;
        const glm::dvec3 n = glm::cross(c[1] - c[0], c[3] - c[0]);
        if (glm::dot(n, d) >= 0.0) {
            continue;
        }
        const glm::dvec3 s = o + d * (glm::dot(n, c[0] - o) / glm::dot(n, d));
        bool inside = true;
        for (std::size_t k = 0; k < 4; ++k) {
            inside = inside && glm::dot(glm::cross(c[(k + 1) % 4] - c[k], s - c[k]), n) >= 0.0;
        }
        if (inside) {
            return std::make_pair(s, f);
        }
    }
    return std::nullopt;
}

/// A projector above the prop, slightly off-centre, rotated about its axis; 64 x 48 pixels that the prop
/// nearly fills.
TruthView view_from(const glm::dvec3& eye) {
    const glm::dquat down(0.0, 1.0, 0.0, 0.0);
    const glm::dquat turn =
        glm::angleAxis(0.3, glm::dvec3(0.1, 0.05, 1.0) / glm::length(glm::dvec3(0.1, 0.05, 1.0)));
    return {{64, 48, 220.0, 216.0, 34.0, 22.0}, {down * turn, {0.05, -0.03, 0.9}}, eye};
}

glm::dmat4 into_prop() { // a placement without reflection, with a rotation and a scale
    glm::dmat4 placed = glm::mat4_cast(glm::angleAxis(0.7, glm::dvec3(0.0, 0.0, 1.0)));
    placed *= 0.1;
    placed[3] = glm::dvec4(-0.02, -0.07, 0.005, 1.0);
    return placed;
}

const std::array<glm::dvec3, 4> eyes = {glm::dvec3(0.5, -0.4, 0.4), glm::dvec3(-0.3, -0.6, 0.3),
                                        glm::dvec3(0.02, 0.01, 0.5), glm::dvec3(-0.9, 0.2, 0.25)};

TEST(Truth, EqualsABruteForceCastInDouble) {
    const geometry::PropShape prop = geometry::make_frustum({});
    int hits = 0;
    int judged = 0;
    for (std::size_t k = 0; k < eyes.size(); ++k) {
        const auto mesh = random_mesh(k);
        const auto truth = Truth::build(mesh, into_prop());
        ASSERT_TRUE(truth) << truth.error().message;
        const TruthView view = view_from(eyes[k]);
        const TruthPicture picture = truth->cast(prop, view, true);
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                const glm::dvec3 from_projector((x + 0.5 - 34.0) / 220.0, (y + 0.5 - 22.0) / 216.0, 1.0);
                const glm::dvec3 light = view.prop_from_projector.rotation * from_projector;
                const auto lit = brute_prop(prop, view.prop_from_projector.translation, light);
                ASSERT_EQ(picture.prop.at(x, y) != 0, lit.has_value()) << x << ' ' << y;
                std::optional<BruteHit> expected;
                double margin = 1.0;
                if (lit && prop.faces[lit->second].plane.distance(view.eye_m) > 0.0) {
                    expected = brute_cast(*mesh, into_prop(), view.eye_m, lit->first - view.eye_m, margin);
                }
                if (margin < 1e-4) {
                    continue; // so close to an edge that float may decide otherwise
                }
                ++judged;
                ASSERT_EQ(picture.hit.at(x, y) != 0, expected.has_value()) << x << ' ' << y << " eye " << k;
                if (expected) {
                    ++hits;
                    EXPECT_LT(glm::distance(glm::dvec3(picture.point_m.at(x, y)), expected->point), 1e-7);
                    for (int c = 0; c < 3; ++c) {
                        EXPECT_NEAR(picture.colour.at(x, y)[c], code_of(expected->linear[c]), 1);
                    }
                } else {
                    EXPECT_TRUE(std::isnan(picture.point_m.at(x, y).x));
                    EXPECT_EQ(picture.colour.at(x, y), glm::u8vec4(0, 0, 0, 255));
                }
            }
        }
    }
    EXPECT_GT(hits, 300);
    EXPECT_GT(judged, 10000);
}

TEST(Truth, SixteenRaysAreTheMeanOfAGridInLinearLight) {
    const geometry::PropShape prop = geometry::make_frustum({});
    const auto mesh = random_mesh(11);
    const auto truth = Truth::build(mesh, into_prop());
    ASSERT_TRUE(truth);
    const TruthView view = view_from(eyes[0]);
    const TruthPicture picture = truth->cast(prop, view, true);
    TruthView fine = view; // 16 times the pixels: their centres are the centres of the sub-pixels
    fine.projector = view.projector.scaled_to(256, 192);
    const TruthPicture grid = truth->cast(prop, fine, false);
    EXPECT_EQ(grid.colour16.width, 0);
    int judged = 0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (picture.hit.at(x, y) == 0) {
                continue;
            }
            ++judged;
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0;
                for (int sub = 0; sub < 16; ++sub) {
                    sum += linear_of(grid.colour.at(4 * x + sub % 4, 4 * y + sub / 4)[c]) / 16.0;
                }
                EXPECT_NEAR(picture.colour16.at(x, y)[c], code_of(sum), 2);
            }
        }
    }
    EXPECT_GT(judged, 60);
}

TEST(Truth, CoverageMatchesTheHitsOfFinerPixels) {
    const geometry::PropShape prop = geometry::make_frustum({});
    const auto truth = Truth::build(random_mesh(11), into_prop());
    ASSERT_TRUE(truth);
    const TruthView view = view_from(eyes[0]);
    const TruthPicture picture = truth->cast(prop, view, true);
    const auto met_of_split = [&](int split) {
        TruthView fine = view;
        fine.projector = view.projector.scaled_to(64 * split, 48 * split);
        return truth->cast(prop, fine, false).hit;
    };
    const image::Image<std::uint8_t> quarters = met_of_split(4);
    const image::Image<std::uint8_t> halves = met_of_split(2);
    const image::Image<float> by_four = truth->cover(prop, view, picture, {2, 2});
    int in_part = 0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (picture.hit.at(x, y) == 0) {
                continue;
            }
            int met = 0;
            for (int sub = 0; sub < 16; ++sub) {
                met += quarters.at(4 * x + sub % 4, 4 * y + sub / 4);
            }
            EXPECT_EQ(picture.met_by_16.at(x, y), met);
            float share = 0.0F;
            for (int sub = 0; sub < 4; ++sub) {
                share += 0.25F * static_cast<float>(halves.at(2 * x + sub % 2, 2 * y + sub / 2));
            }
            EXPECT_TRUE(by_four.at(x, y) == share || met == 16) << x << " " << y;
            in_part += met < 16 ? 1 : 0;
        }
    }
    EXPECT_GT(in_part, 30);
}

TEST(Truth, RayContinuesBehindTheProp) {
    // A wall far behind the prop, seen through it as through a window.
    auto mesh = std::make_shared<bake::SourceMesh>();
    mesh->positions = {{-50.0, 5.0, -50.0}, {50.0, 5.0, -50.0}, {0.0, 5.0, 50.0}};
    mesh->triangles = {{0, 1, 2}};
    mesh->triangle_materials = {0};
    mesh->materials = {bake::SourceMaterial{}};
    const auto truth = Truth::build(mesh, glm::dmat4(1.0));
    ASSERT_TRUE(truth);
    const TruthView view = view_from({0.0, -0.6, 0.2});
    const geometry::PropShape prop = geometry::make_frustum({});
    const TruthPicture picture = truth->cast(prop, view, false);
    int seen = 0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (picture.hit.at(x, y) != 0) {
                EXPECT_NEAR(picture.point_m.at(x, y).y, 5.0F, 1e-5F);
                EXPECT_EQ(picture.colour.at(x, y), glm::u8vec4(255, 255, 255, 255));
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 50);
}

TEST(Truth, DoesNotDependOnTheFilesScaleAndPlace) {
    // The mesh in a file's frame a thousand times larger and far off: 64-bit set-up gives an equal picture.
    const geometry::PropShape prop = geometry::make_frustum({});
    const auto mesh = random_mesh(5);
    auto moved = std::make_shared<bake::SourceMesh>(*mesh);
    for (glm::dvec3& position : moved->positions) {
        position = position * 1000.0 + glm::dvec3(3e6, -1e6, 2e6);
    }
    glm::dmat4 back(1.0);
    back *= 1e-3;
    back[3] = glm::dvec4(glm::dvec3(-3e3, 1e3, -2e3), 1.0);
    const auto a = Truth::build(mesh, into_prop());
    const auto b = Truth::build(moved, into_prop() * back);
    ASSERT_TRUE(a && b);
    const TruthPicture here = a->cast(prop, view_from(eyes[1]), false);
    const TruthPicture there = b->cast(prop, view_from(eyes[1]), false);
    for (std::size_t k = 0; k < here.hit.texels.size(); ++k) {
        ASSERT_EQ(here.hit.texels[k], there.hit.texels[k]);
        if (here.hit.texels[k] != 0) {
            EXPECT_LT(glm::distance(here.point_m.texels[k], there.point_m.texels[k]), 1e-6F);
        }
    }
}

TEST(Truth, HitsOnlyFrontSidesOnRequest) {
    auto mesh = std::make_shared<bake::SourceMesh>();
    mesh->positions = {{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.0, 1.0, 1.0},
                       {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
    mesh->triangles = {{0, 1, 2}, {3, 4, 5}}; // the upper one faces up, the lower one down
    mesh->triangle_materials = {0, 0};
    mesh->materials = {bake::SourceMaterial{}};
    const Truth both = Truth::build(mesh, glm::dmat4(1.0)).value();
    const Truth front = Truth::build(mesh, glm::dmat4(1.0), bake::Sides::Front).value();
    const glm::dvec3 between(0.2, 0.2, 0.5);
    const glm::dvec3 above(0.2, 0.2, 2.0);
    const glm::dvec3 up(0.0, 0.0, 1.0);
    Truth::Hit hit;
    EXPECT_TRUE(both.first_hit(between, up, hit));
    EXPECT_TRUE(both.first_hit(between, -up, hit));
    EXPECT_FALSE(front.first_hit(between, up, hit));
    EXPECT_FALSE(front.first_hit(between, -up, hit));
    ASSERT_TRUE(front.first_hit(above, -up, hit));
    EXPECT_EQ(hit.triangle, 0U);
}

TEST(Truth, RejectsAnEmptyMeshAndANanPlacement) {
    EXPECT_FALSE(Truth::build(std::make_shared<bake::SourceMesh>(), glm::dmat4(1.0)));
    EXPECT_FALSE(Truth::build(random_mesh(1), glm::dmat4(std::nan(""))));
}

} // namespace
} // namespace frustumscreen::bench
