#include "app/drawing/prop_net.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace frustumscreen::drawing {

namespace {

constexpr double max_tab_m = 0.015;
constexpr double steepest_tab = std::numbers::pi / 4.0;
constexpr double rounding_m = 1e-9;

const geometry::PropFace& face_named(const geometry::PropShape& prop, std::string_view name) {
    const auto found = std::find_if(prop.faces.begin(), prop.faces.end(),
                                    [&](const geometry::PropFace& face) { return face.name == name; });
    assert(found != prop.faces.end());
    return *found;
}

/// The face's corners in its own plane, seen from outside: the first at the origin, the second along x.
std::array<glm::dvec2, 4> flat(const geometry::PropFace& face) {
    assert(face.corners.size() == 4); // the net is that of a frustum or a cube
    const glm::dvec3 x = glm::normalize(face.corners[1] - face.corners[0]);
    const glm::dvec3 y = glm::cross(face.plane.normal, x);
    std::array<glm::dvec2, 4> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 from_first = face.corners[k] - face.corners[0];
        corners[k] = {glm::dot(from_first, x), glm::dot(from_first, y)};
    }
    return corners;
}

/// The edge of `face` that runs from `to` to `from`: adjacent faces traverse their common edge in opposite
/// directions.
std::optional<std::size_t> edge_between(const geometry::PropFace& face, const glm::dvec3& to,
                                        const glm::dvec3& from) {
    for (std::size_t k = 0; k < 4; ++k) {
        if (glm::distance(face.corners[k], to) < rounding_m &&
            glm::distance(face.corners[(k + 1) % 4], from) < rounding_m) {
            return k;
        }
    }
    return std::nullopt;
}

/// The flat `corners`, rotated and moved so that the edge at `own` runs from `begin` to `end`.
std::array<glm::dvec2, 4> moved(const std::array<glm::dvec2, 4>& corners, std::size_t own,
                                const glm::dvec2& begin, const glm::dvec2& end) {
    const glm::dvec2 was = glm::normalize(corners[(own + 1) % 4] - corners[own]);
    const glm::dvec2 is = glm::normalize(end - begin);
    const double cosine = glm::dot(was, is);
    const double sine = was.x * is.y - was.y * is.x;
    std::array<glm::dvec2, 4> result{};
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 v = corners[k] - corners[own];
        result[k] = begin + glm::dvec2(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y);
    }
    return result;
}

void hang(PropNet& net, const geometry::PropShape& prop, const geometry::PropFace& face,
          std::string_view parent_name) {
    const geometry::PropFace& parent = face_named(prop, parent_name);
    const auto placed = std::find_if(net.faces.begin(), net.faces.end(),
                                     [&](const NetFace& each) { return each.name == parent_name; });
    for (std::size_t k = 0; k < 4; ++k) {
        const auto own = edge_between(face, parent.corners[(k + 1) % 4], parent.corners[k]);
        if (own) {
            const NetFold fold{placed->corners[k], placed->corners[(k + 1) % 4]};
            net.folds.push_back(fold);
            net.faces.push_back({face.name, moved(flat(face), *own, fold.to, fold.from)});
            return;
        }
    }
    assert(false && "the two faces do not meet");
}

double angle_at(const std::array<glm::dvec2, 4>& corners, std::size_t k) {
    const glm::dvec2 a = corners[(k + 1) % 4] - corners[k];
    const glm::dvec2 b = corners[(k + 3) % 4] - corners[k];
    return std::acos(std::clamp(glm::dot(a, b) / (glm::length(a) * glm::length(b)), -1.0, 1.0));
}

/// The angle around a corner of the net that no face covers.
double free_angle(const PropNet& net, const glm::dvec2& at) {
    double taken = 0.0;
    for (const NetFace& face : net.faces) {
        for (std::size_t k = 0; k < 4; ++k) {
            taken += glm::distance(face.corners[k], at) < rounding_m ? angle_at(face.corners, k) : 0.0;
        }
    }
    return 2.0 * std::numbers::pi - taken;
}

/// A tab on the edge from `begin` to `end`, outward; at each end it takes at most half of the free angle.
NetTab tab_on(const PropNet& net, const glm::dvec2& begin, const glm::dvec2& end) {
    const double at_begin = std::fmin(steepest_tab, 0.5 * free_angle(net, begin));
    const double at_end = std::fmin(steepest_tab, 0.5 * free_angle(net, end));
    const double slant = 1.0 / std::tan(at_begin) + 1.0 / std::tan(at_end);
    const double length = glm::distance(begin, end);
    constexpr double max_of_edge = 0.8;
    const double depth = std::fmin(max_tab_m, max_of_edge * length / slant);
    const glm::dvec2 along = (end - begin) / length;
    const glm::dvec2 outward(along.y, -along.x); // the face is to the left of its edges
    return {{begin, begin + depth * (outward + along / std::tan(at_begin)),
             end + depth * (outward - along / std::tan(at_end)), end}};
}

bool is_fold(const PropNet& net, const glm::dvec2& begin, const glm::dvec2& end) {
    return std::any_of(net.folds.begin(), net.folds.end(), [&](const NetFold& fold) {
        const auto same = [](const glm::dvec2& a, const glm::dvec2& b) {
            return glm::distance(a, b) < rounding_m;
        };
        return (same(fold.from, begin) && same(fold.to, end)) ||
               (same(fold.from, end) && same(fold.to, begin));
    });
}

/// If two faces meet at a cut edge, the later one in the net gets the tab.
void add_tabs(PropNet& net, const geometry::PropShape& prop) {
    for (std::size_t later = 0; later < net.faces.size(); ++later) {
        const geometry::PropFace& face = face_named(prop, net.faces[later].name);
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec2 begin = net.faces[later].corners[k];
            const glm::dvec2 end = net.faces[later].corners[(k + 1) % 4];
            const bool meets_earlier =
                std::any_of(net.faces.begin(), net.faces.begin() + static_cast<std::ptrdiff_t>(later),
                            [&](const NetFace& other) {
                                return edge_between(face_named(prop, other.name), face.corners[(k + 1) % 4],
                                                    face.corners[k])
                                    .has_value();
                            });
            if (meets_earlier && !is_fold(net, begin, end)) {
                net.tabs.push_back(tab_on(net, begin, end));
            }
        }
    }
}

} // namespace

PropNet unfold(const geometry::PropShape& prop) {
    PropNet net;
    NetFace top{"+Z", {}};
    const geometry::PropFace& top_face = face_named(prop, top.name);
    std::transform(top_face.corners.begin(), top_face.corners.end(), top.corners.begin(),
                   [](const glm::dvec3& corner) { return glm::dvec2(corner); });
    net.faces.push_back(top);
    for (const char* side : {"+X", "-X", "+Y", "-Y"}) {
        hang(net, prop, face_named(prop, side), "+Z");
    }
    const bool has_bottom = std::any_of(prop.faces.begin(), prop.faces.end(),
                                        [](const geometry::PropFace& face) { return face.name == "-Z"; });
    if (has_bottom) {
        hang(net, prop, face_named(prop, "-Z"), "-Y");
    }
    add_tabs(net, prop);
    return net;
}

} // namespace frustumscreen::drawing
