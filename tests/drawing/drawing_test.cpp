// The drawings against independent arithmetic: the values read from the SVG must match Pythagoras, the
// settings in `config --json`, and the paper.

#include "app/drawing/drawing.h"
#include "firmware_host/base/json.h"
#include "tests/base/told.h"
#include "tests/drawing/svg_text.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace frustumscreen::drawing {
namespace {

constexpr double written_mm = 2e-3; ///< rounding of the file's values to thousandths

struct Case {
    std::string what;
    std::string settings;
};
std::string solid_settings(const std::string& file) {
    return "[prop]\nkind = \"solid\"\nfile = \"" + source_dir() + "/config/" + file + "\"\n";
}
const std::vector<Case> cases = {
    {"shipped", ""},
    {"near", "[projector]\nwidth = 1280\nheight = 800\nfx = 2850.0\nposition_m = [0, 0, 0.9]\n[prop]\n"
             "base_m = 0.16\ntop_m = 0.09\nheight_m = 0.12\n[table]\nwidth_m = 0.404\ndepth_m = 0.252\n"},
    {"cube", "[projector]\nwidth = 1280\nheight = 800\nfx = 2000.0\nposition_m = [0, 0, 0.9]\n[prop]\n"
             "kind = \"cube\"\nbase_m = 0.1\n[table]\nwidth_m = 0.576\ndepth_m = 0.36\n"},
    {"tilted, with a tracker",
     "[projector]\nthrow_ratio = 1.4\nposition_m = [0.1, 0.45, 1.7]\naim_m = [0, 0.02, 0]\nroll_deg = 4\n"
     "[table]\nwidth_m = 1.2\ndepth_m = 0.9\n[tracker]\nkind = \"usb\"\n"
     "table_from_tracker = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5, 0.3, -0.1, 1]\n"},
    {"large",
     "[projector]\nthrow_ratio = 1.2\nposition_m = [0, 0, 4.5]\n[prop]\nbase_m = 1.0\ntop_m = 0.3\n"
     "height_m = 0.5\n[table]\nwidth_m = 3.0\ndepth_m = 2.0\n[eye]\nnearest_m = 1.0\nfarthest_m = 8.0\n"},
    {"small and flat",
     "[prop]\nbase_m = 0.12\ntop_m = 0.1\nheight_m = 0.02\n[eye]\ndefault_m = [0.1, 0.2, 0.6]\n"},
    {"prism", solid_settings("prop_hexagon.obj")},
    {"standing prism", solid_settings("prop_hexagon.obj") + "zone = \"table\"\n"},
    {"tetrahedron", solid_settings("prop_tetrahedron.obj")},
    {"gem", solid_settings("prop_gem.obj")}};

class Drawing : public programs::ProgramFolder {
protected:
    [[nodiscard]] std::string drawn(const std::string& settings, const char* sheet) const {
        put("kiosk.toml", settings);
        EXPECT_EQ(
            run(fmt::format("frustumscreen drawing --config kiosk.toml -o drawing.svg --sheet {}", sheet)), 0)
            << text("err.txt");
        return text("drawing.svg");
    }
    [[nodiscard]] nlohmann::json config() const {
        EXPECT_EQ(run("frustumscreen config --config kiosk.toml --json"), 0) << text("err.txt");
        return nlohmann::json::parse(text("out.txt"));
    }
    [[nodiscard]] static std::vector<glm::dvec2> polygon(const std::string& svg, const std::string& view,
                                                         const std::string& name) {
        for (const SvgPolygon& each : named_polygons(svg)) {
            if (each.view == view && each.name == name) {
                return each.corners;
            }
        }
        ADD_FAILURE() << "there is no " << name << " in the view " << view;
        return {};
    }
};

double side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether p is inside all edges of a convex polygon by at least `margin_m`.
bool is_inside(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p, double margin_m) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        if (std::abs(side_of(a, b, p)) < margin_m * glm::distance(a, b) ||
            (side_of(a, b, p) > 0.0) != (side_of(a, b, polygon[(k + 2) % polygon.size()]) > 0.0)) {
            return false;
        }
    }
    return true;
}

/// A grid over the triangles around the first corner.
std::vector<glm::dvec2> places_in(const std::vector<glm::dvec2>& corners) {
    std::vector<glm::dvec2> places;
    constexpr int steps = 16;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        for (int a = 0; a < steps; ++a) {
            for (int b = 0; a + b < steps; ++b) {
                const double u = (a + 1.0 / 3.0) / steps;
                const double v = (b + 1.0 / 3.0) / steps;
                places.push_back(corners[0] + u * (corners[k] - corners[0]) +
                                 v * (corners[k + 1] - corners[0]));
            }
        }
    }
    return places;
}

/// An edge between two faces has both of its corners in both.
std::size_t edges_between_faces(const nlohmann::json& faces) {
    std::size_t edges = 0;
    for (std::size_t a = 0; a < faces.size(); ++a) {
        for (std::size_t b = a + 1; b < faces.size(); ++b) {
            const nlohmann::json& of_b = faces.at(b).at("corners");
            const auto common =
                std::count_if(faces.at(a).at("corners").begin(), faces.at(a).at("corners").end(),
                              [&](const nlohmann::json& corner) {
                                  return std::find(of_b.begin(), of_b.end(), corner) != of_b.end();
                              });
            edges += common == 2 ? 1 : 0;
        }
    }
    return edges;
}

std::multiset<long> rounded_edges(const std::vector<glm::dvec2>& corners) {
    std::multiset<long> edges;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        edges.insert(std::lround(1e5 * glm::distance(corners[k], corners[(k + 1) % corners.size()])));
    }
    return edges;
}

TEST_F(Drawing, NetOfTheShippedPropHasItsSizes) {
    // 300 and 80 mm, 155 mm high: the slant height of a side is hypot(155, 110), its edges are the hypot of
    // that and 110.
    const std::string svg = drawn("", "net");
    EXPECT_EQ(rounded_edges(polygon(svg, "net", "+Z")), (std::multiset<long>{8000, 8000, 8000, 8000}));
    const long edge = std::lround(1e5 * std::hypot(0.110, 0.110, 0.155));
    for (const char* side : {"+X", "-X", "+Y", "-Y"}) {
        const std::vector<glm::dvec2> corners = polygon(svg, "net", side);
        EXPECT_EQ(rounded_edges(corners), (std::multiset<long>{8000, edge, edge, 30000})) << side;
        // The height determines the angles, and so the area (shoelace formula).
        double area = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            area += 0.5 * (corners[k].x * corners[(k + 1) % 4].y - corners[k].y * corners[(k + 1) % 4].x);
        }
        EXPECT_NEAR(area, 0.19 * std::hypot(0.155, 0.110), 2e-6) << side;
    }
    // True size: the page is the net and its margins, and its attributes say so.
    EXPECT_NE(svg.find("mm\" viewBox=\"0 0 "), std::string::npos);
    EXPECT_NE(svg.find("data-mm-per-m=\"1000\""), std::string::npos);
}

TEST_F(Drawing, NetFacesMatchTheSettings) {
    for (const Case& each : cases) {
        SCOPED_TRACE(each.what);
        const std::string svg = drawn(each.settings, "net");
        const nlohmann::json faces = config().at("prop").at("faces");
        EXPECT_GE(faces.size(), 4U);
        for (const nlohmann::json& face : faces) {
            const std::vector<glm::dvec2> flat = polygon(svg, "net", face.at("name"));
            ASSERT_EQ(flat.size(), face.at("corners").size());
            const auto corner = [&](std::size_t k) {
                const nlohmann::json& c = face.at("corners").at(k);
                return glm::dvec3(c.at(0), c.at(1), c.at(2));
            };
            // All distances between two corners, and the winding: an equal face, not mirrored.
            for (std::size_t a = 0; a < flat.size(); ++a) {
                for (std::size_t b = a + 1; b < flat.size(); ++b) {
                    EXPECT_NEAR(1e3 * glm::distance(flat[a], flat[b]),
                                1e3 * glm::distance(corner(a), corner(b)), 2.0 * written_mm);
                }
            }
            EXPECT_GT(side_of(flat[0], flat[1], flat[2]), 0.0);
        }
    }
}

TEST_F(Drawing, NetPartsDoNotOverlap) {
    for (const Case& each : cases) {
        SCOPED_TRACE(each.what);
        const std::vector<SvgPolygon> parts = named_polygons(drawn(each.settings, "net"));
        std::size_t tabs = 0;
        for (const SvgPolygon& part : parts) {
            tabs += part.name == "tab" ? 1 : 0;
            for (const glm::dvec2& p : places_in(part.corners)) {
                const auto over = std::count_if(parts.begin(), parts.end(), [&](const SvgPolygon& other) {
                    return is_inside(other.corners, p, 1e-5);
                });
                EXPECT_LE(over, 1) << part.name << " at " << p.x << ", " << p.y;
            }
        }
        // One piece of F faces is cut open along the edges between them except F - 1 folds.
        EXPECT_EQ(tabs, edges_between_faces(config().at("prop").at("faces")) - (parts.size() - tabs - 1));
    }
}

TEST_F(Drawing, PictureCornersMatchTheProjector) {
    for (const Case& each : cases) {
        SCOPED_TRACE(each.what);
        // A table that contains the whole picture cuts nothing off.
        std::string settings = each.settings;
        const std::size_t table = settings.find("[table]\n");
        if (table != std::string::npos) {
            settings.erase(table, settings.find("depth_m", table) - table);
            settings.erase(table, settings.find('\n', table) + 1 - table);
        }
        settings += "[table]\nwidth_m = 9.0\ndepth_m = 9.0\n";
        const std::vector<glm::dvec2> corners = polygon(drawn(settings.c_str(), "table"), "top", "picture");
        ASSERT_EQ(corners.size(), 4U);
        const nlohmann::json projector = config().at("projector");
        const nlohmann::json& m = projector.at("table_from_projector");
        std::set<std::pair<long, long>> met;
        for (const glm::dvec2& corner : corners) {
            // The inverse of a rotation is its transpose; columns come first in the JSON.
            const glm::dvec3 d = glm::dvec3(corner, 0.0) - glm::dvec3(m.at(12), m.at(13), m.at(14));
            glm::dvec3 seen(0.0);
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t k = 4 * static_cast<std::size_t>(axis);
                seen[axis] = m.at(k).get<double>() * d.x + m.at(k + 1).get<double>() * d.y +
                             m.at(k + 2).get<double>() * d.z;
            }
            const double width = projector.at("width");
            const double height = projector.at("height");
            const double u =
                projector.at("fx").get<double>() * seen.x / seen.z + projector.at("cx").get<double>();
            const double v =
                projector.at("fy").get<double>() * seen.y / seen.z + projector.at("cy").get<double>();
            met.insert({std::lround(20.0 * u / width), std::lround(20.0 * v / height)});
            constexpr double pixels = 1.0; // rounding: a thousandth of a millimetre at 1 : 100 is 0.1 mm
            EXPECT_LT(std::fmin(std::abs(u), std::abs(u - width)), pixels);
            EXPECT_LT(std::fmin(std::abs(v), std::abs(v - height)), pixels);
        }
        EXPECT_EQ(met, (std::set<std::pair<long, long>>{{0, 0}, {0, 20}, {20, 0}, {20, 20}}));
    }
}

TEST_F(Drawing, ZoneMatchesTheSettings) {
    int zones = 0;
    for (const Case& each : cases) {
        SCOPED_TRACE(each.what);
        const std::string svg = drawn(each.settings, "table");
        const nlohmann::json zone = config().at("lit_zone").at("any_eye").at("polygon_m");
        if (zone.empty()) {
            EXPECT_NE(svg.find("is the prop lit from all sides"), std::string::npos);
            continue;
        }
        const std::vector<glm::dvec2> corners = polygon(svg, "top", "zone");
        ASSERT_EQ(corners.size(), zone.size());
        for (std::size_t k = 0; k < corners.size(); ++k) {
            EXPECT_NEAR(corners[k].x, zone.at(k).at(0).get<double>(), 2e-4);
            EXPECT_NEAR(corners[k].y, zone.at(k).at(1).get<double>(), 2e-4);
        }
        ++zones;
    }
    EXPECT_GE(zones, 2);
}

TEST_F(Drawing, ShippedTableHasItsDimensions) {
    const auto words = [](const std::string& svg) {
        std::multiset<std::string> all;
        for (const SvgText& each : texts(svg)) {
            all.insert(each.words);
        }
        return all;
    };
    const std::multiset<std::string> table = words(drawn("", "table"));
    // Lens, prop's height, two sides of the table; eyes 0.55 m in front of the middle, 0.3 m from its edge.
    for (const char* measure : {"1500", "155", "800", "300"}) {
        EXPECT_GE(table.count(measure), 1U) << measure;
    }
    EXPECT_EQ(table.count("500"), 3U); // the depth twice, and the eyes' height
    const std::multiset<std::string> prop = words(drawn("", "prop"));
    // atan2(155, 110); a side's slant height is hypot(155, 110) = 190.07, its angle atan2(190.07, 110).
    for (const char* measure : {"300", "80", "155", "190.1", "219.6", "54.6\u00b0", "59.9\u00b0"}) {
        EXPECT_GE(prop.count(measure), 1U) << measure;
    }
}

/// For a convex polygon, counter-clockwise: how far a point lies within the edge that it is nearest to.
double depth_in(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        least = std::min(least, side_of(a, b, p) / glm::distance(a, b));
    }
    return least;
}

/// Places on the prop's faces up to a height, of the corners that the settings list: on lines between them.
std::vector<glm::dvec2> places_below(const nlohmann::json& faces, double height_m) {
    std::vector<glm::dvec2> places;
    for (const nlohmann::json& face : faces) {
        std::vector<glm::dvec3> corners;
        for (const nlohmann::json& corner : face.at("corners")) {
            corners.emplace_back(corner.at(0), corner.at(1), corner.at(2));
        }
        for (std::size_t k = 0; k < corners.size(); ++k) {
            for (int step = 0; step <= 4000; ++step) {
                const glm::dvec3 at = glm::mix(corners[k], corners[(k + 1) % corners.size()], step / 4000.0);
                if (at.z <= height_m) {
                    places.emplace_back(at);
                }
            }
        }
    }
    return places;
}

TEST_F(Drawing, HolderLeavesHalfAMillimetreOfPlay) {
    for (const Case& each : cases) {
        SCOPED_TRACE(each.what);
        const std::string svg = drawn(each.settings, "holder");
        const std::vector<glm::dvec2> pocket = polygon(svg, "above", "pocket");
        const std::vector<glm::dvec2> plate = polygon(svg, "above", "plate");
        const std::vector<glm::dvec2> rim = polygon(svg, "section", "left rim");
        const nlohmann::json prop = config().at("prop");
        double high_m = 0.0;
        for (const nlohmann::json& face : prop.at("faces")) {
            for (const nlohmann::json& corner : face.at("corners")) {
                high_m = std::max(high_m, corner.at(2).get<double>());
            }
        }
        const double rim_m = rim[2].y - rim[1].y;
        EXPECT_LE(rim_m, 0.1 * high_m + 1e-4);
        EXPECT_GT(rim_m, 0.0019);
        double depth_m = 1.0;
        std::vector<bool> met(pocket.size());
        for (const glm::dvec2& place : places_below(prop.at("faces"), rim_m)) {
            depth_m = std::min(depth_m, depth_in(pocket, place));
            for (std::size_t k = 0; k < pocket.size(); ++k) {
                const glm::dvec2& a = pocket[k];
                const glm::dvec2& b = pocket[(k + 1) % pocket.size()];
                met[k] = met[k] || side_of(a, b, place) / glm::distance(a, b) < 0.0008;
            }
        }
        EXPECT_NEAR(depth_m, 0.0005, 1e-4);
        EXPECT_EQ(std::count(met.begin(), met.end(), false), 0) << "each side of the pocket is near the prop";
        for (const glm::dvec2& corner : pocket) {
            EXPECT_NEAR(depth_in(plate, corner), 0.008, 1e-4);
        }
    }
}

TEST_F(Drawing, WordsDoNotOverlapOrLeaveThePaper) {
    for (const Case& each : cases) {
        for (const char* sheet : {"table", "prop", "holder"}) {
            SCOPED_TRACE(std::string(each.what) + ", " + sheet);
            const std::vector<SvgText> all = texts(drawn(each.settings, sheet));
            EXPECT_GT(all.size(), 10U);
            for (std::size_t a = 0; a < all.size(); ++a) {
                EXPECT_TRUE(all[a].low.x > 10.0 && all[a].low.y > 10.0 && all[a].high.x < 410.0 &&
                            all[a].high.y < 287.0)
                    << all[a].words;
                for (std::size_t b = a + 1; b < all.size(); ++b) {
                    EXPECT_FALSE(all[a].meets(all[b])) << all[a].words << " / " << all[b].words;
                }
            }
        }
    }
}

TEST_F(Drawing, CommittedGuideDrawingsAreUpToDate) {
    for (const char* sheet : {"table", "prop"}) {
        ASSERT_EQ(
            run(fmt::format("frustumscreen drawing --config '{}/config/kiosk.toml' -o drawing.svg --sheet {}",
                            source_dir(), sheet)),
            0)
            << text("err.txt");
        const Result<Bytes> committed = read_file(fmt::format("{}/docs/guide/{}.svg", source_dir(), sheet));
        ASSERT_TRUE(committed);
        EXPECT_EQ(text("drawing.svg"), as_text(*committed)) << "draw it again: docs/draw_guide.sh";
    }
}

TEST_F(Drawing, CommittedTorchDrawingIsUpToDate) {
    ASSERT_EQ(
        run(fmt::format("frustumscreen drawing --config '{}/config/torch.toml' -o drawing.svg --sheet torch",
                        source_dir())),
        0)
        << text("err.txt");
    const Result<Bytes> committed = read_file(source_dir() + "/docs/torch.svg");
    ASSERT_TRUE(committed);
    EXPECT_EQ(text("drawing.svg"), as_text(*committed)) << "draw it again: docs/draw_guide.sh";
}

TEST_F(Drawing, ReportsErrorsInOneLine) {
    put("kiosk.toml", "[prop]\ntop_m = 0.4\n");
    EXPECT_EQ(run("frustumscreen drawing --config kiosk.toml -o drawing.svg"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"frustumscreen: kiosk.toml:2: prop.top_m is 0.4", "0.3 metres",
                                              "[settings.prop_top]\n"}));
    EXPECT_FALSE(std::filesystem::exists(folder / "drawing.svg"));
    EXPECT_EQ(run("frustumscreen drawing --config kiosk.toml -o kiosk.toml"), 1);
    EXPECT_NE(text("err.txt").find("would replace the input"), std::string::npos);
    EXPECT_EQ(run("frustumscreen drawing --config kiosk.toml -o drawing.svg --sheet floor"), 2);
    EXPECT_EQ(run("frustumscreen drawing --config kiosk.toml"), 2);
    put("kiosk.toml", "");
    EXPECT_EQ(run("frustumscreen drawing --config kiosk.toml -o drawing.svg --sheet room"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"[screen]", "[drawing.no_screen]\n"}));
    put("poses.csv", "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n0,1,0,0,0,1,0,0,0,1\n");
    EXPECT_EQ(
        run("frustumscreen render --config kiosk.toml --pack a.fspack --poses poses.csv --out o --view room"),
        1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"[screen]", "[render.no_room_to_see]\n"}));
    EXPECT_EQ(run("frustumscreen-artifact krater --folder krater"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"krater", "-o", "[artifact.no_texts]\n"}));
}

} // namespace
} // namespace frustumscreen::drawing
