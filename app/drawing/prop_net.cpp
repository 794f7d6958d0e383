#include "app/drawing/prop_net.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace frustumscreen::drawing {

namespace {

constexpr double max_tab_m = 0.015;
constexpr double steepest_tab = std::numbers::pi / 4.0;
constexpr double rounding_m = 1e-9;
constexpr double overlap_m = 1e-6;

/// The face's corners in its own plane, seen from outside: the first at the origin, the second along x.
std::vector<glm::dvec2> flat(const geometry::PropFace& face) {
    const glm::dvec3 x = glm::normalize(face.corners[1] - face.corners[0]);
    const glm::dvec3 y = glm::cross(face.plane.normal, x);
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& corner : face.corners) {
        const glm::dvec3 from_first = corner - face.corners[0];
        corners.emplace_back(glm::dot(from_first, x), glm::dot(from_first, y));
    }
    return corners;
}

/// The edge of `face` that runs from `to` to `from`: adjacent faces traverse their common edge in opposite
/// directions.
std::optional<std::size_t> edge_between(const geometry::PropFace& face, const glm::dvec3& to,
                                        const glm::dvec3& from) {
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        if (glm::distance(face.corners[k], to) < rounding_m &&
            glm::distance(face.corners[face.corners.next(k)], from) < rounding_m) {
            return k;
        }
    }
    return std::nullopt;
}

std::size_t next(const std::vector<glm::dvec2>& corners, std::size_t k) {
    return (k + 1) % corners.size();
}

/// The flat `corners`, rotated and moved so that the edge at `own` runs from `begin` to `end`.
std::vector<glm::dvec2> moved(std::vector<glm::dvec2> corners, std::size_t own, const glm::dvec2& begin,
                              const glm::dvec2& end) {
    const glm::dvec2 origin = corners[own];
    const glm::dvec2 was = glm::normalize(corners[next(corners, own)] - origin);
    const glm::dvec2 is = glm::normalize(end - begin);
    const double cosine = glm::dot(was, is);
    const double sine = was.x * is.y - was.y * is.x;
    for (glm::dvec2& corner : corners) {
        const glm::dvec2 v = corner - origin;
        corner = begin + glm::dvec2(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y);
    }
    return corners;
}

/// Whether an edge of `a` has all of `b` on its outer side.
bool has_dividing_edge(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
    for (std::size_t k = 0; k < a.size(); ++k) {
        const glm::dvec2 along = glm::normalize(a[next(a, k)] - a[k]);
        const glm::dvec2 outward(along.y, -along.x);
        if (std::all_of(b.begin(), b.end(), [&](const glm::dvec2& corner) {
                return glm::dot(corner - a[k], outward) > -overlap_m;
            })) {
            return true;
        }
    }
    return false;
}

bool overlap(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
    return !has_dividing_edge(a, b) && !has_dividing_edge(b, a);
}

/// Attaches `face` to a face of the net, if the two meet and it then lies on no other.
bool attach(PropNet& net, const geometry::PropShape& prop, std::size_t face, std::size_t parent) {
    const geometry::PropFace& held = prop.faces[net.faces[parent].face];
    for (std::size_t k = 0; k < held.corners.size(); ++k) {
        const auto own = edge_between(prop.faces[face], held.corners[held.corners.next(k)], held.corners[k]);
        if (!own) {
            continue;
        }
        const std::vector<glm::dvec2>& at = net.faces[parent].corners;
        const NetFold fold{at[k], at[next(at, k)]};
        std::vector<glm::dvec2> corners = moved(flat(prop.faces[face]), *own, fold.to, fold.from);
        if (std::any_of(net.faces.begin(), net.faces.end(),
                        [&](const NetFace& other) { return overlap(corners, other.corners); })) {
            return false;
        }
        net.folds.push_back(fold);
        net.faces.push_back({face, prop.faces[face].name, std::move(corners)});
        return true;
    }
    return false;
}

/// The first face of a piece, to the right of all others.
void begin_piece(PropNet& net, const geometry::PropShape& prop, std::size_t face) {
    std::vector<glm::dvec2> corners = flat(prop.faces[face]);
    double right = 0.0;
    double left = 0.0;
    for (const NetFace& each : net.faces) {
        for (const glm::dvec2& corner : each.corners) {
            right = std::fmax(right, corner.x);
        }
    }
    for (const glm::dvec2& corner : corners) {
        left = std::fmin(left, corner.x);
    }
    for (glm::dvec2& corner : corners) {
        corner.x += right - left + 2.0 * max_tab_m;
    }
    net.faces.push_back({face, prop.faces[face].name, std::move(corners)});
    ++net.pieces;
}

/// As the face lies in the prop, seen from above.
NetFace first_face(const geometry::PropShape& prop) {
    const auto top = std::max_element(prop.faces.begin(), prop.faces.end(),
                                      [](const geometry::PropFace& a, const geometry::PropFace& b) {
                                          return a.plane.normal.z < b.plane.normal.z;
                                      });
    NetFace first{static_cast<std::size_t>(top - prop.faces.begin()), top->name, {}};
    constexpr double level = 1.0 - 1e-12;
    if (top->plane.normal.z < level) {
        first.corners = flat(*top);
        return first;
    }
    for (const glm::dvec3& corner : top->corners) {
        first.corners.emplace_back(corner);
    }
    return first;
}

/// Attaches each face of `missing` that now fits to the net as it was before; the last face of the net comes first.
void attach_ring(PropNet& net, const geometry::PropShape& prop, std::vector<std::size_t>& missing) {
    const std::size_t before = net.faces.size();
    std::erase_if(missing, [&](std::size_t face) {
        for (std::size_t parent = before; parent-- > 0;) {
            if (attach(net, prop, face, parent)) {
                return true;
            }
        }
        return false;
    });
}

double angle_at(const std::vector<glm::dvec2>& corners, std::size_t k) {
    const glm::dvec2 a = corners[next(corners, k)] - corners[k];
    const glm::dvec2 b = corners[(k + corners.size() - 1) % corners.size()] - corners[k];
    return std::acos(std::clamp(glm::dot(a, b) / (glm::length(a) * glm::length(b)), -1.0, 1.0));
}

/// The angle around a corner of the net that no face covers.
double free_angle(const PropNet& net, const glm::dvec2& at) {
    double taken = 0.0;
    for (const NetFace& face : net.faces) {
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
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
        const geometry::PropFace& face = prop.faces[net.faces[later].face];
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const std::vector<glm::dvec2>& at = net.faces[later].corners;
            const glm::dvec2 begin = at[k];
            const glm::dvec2 end = at[next(at, k)];
            const bool meets_earlier =
                std::any_of(net.faces.begin(), net.faces.begin() + static_cast<std::ptrdiff_t>(later),
                            [&](const NetFace& other) {
                                return edge_between(prop.faces[other.face],
                                                    face.corners[face.corners.next(k)], face.corners[k])
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
    net.faces.push_back(first_face(prop));
    std::vector<std::size_t> missing;
    for (std::size_t face = 0; face < prop.faces.size(); ++face) {
        if (face != net.faces.front().face) {
            missing.push_back(face);
        }
    }
    while (!missing.empty()) {
        const std::size_t before = missing.size();
        attach_ring(net, prop, missing);
        if (missing.size() == before) {
            begin_piece(net, prop, missing.front());
            missing.erase(missing.begin());
        }
    }
    add_tabs(net, prop);
    return net;
}

} // namespace frustumscreen::drawing
