// Reads a drawing's SVG like any other program: its polygons and texts, from the file alone.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::drawing {

struct SvgPolygon {
    std::string view; ///< the view that contains it
    std::string name;
    std::vector<glm::dvec2> corners; ///< in the view's own metres
};

/// Approximate box of a text on the paper, millimetres.
struct SvgText {
    std::string words;
    glm::dvec2 low{0.0}, high{0.0};
    [[nodiscard]] bool meets(const SvgText& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
};

inline std::vector<glm::dvec2> places_of(const std::string& points) {
    std::vector<glm::dvec2> places;
    std::istringstream stream(points);
    char comma = ',';
    for (glm::dvec2 place; stream >> place.x >> comma >> place.y;) {
        places.push_back(place);
    }
    return places;
}

inline std::vector<SvgPolygon> named_polygons(const std::string& svg) {
    static const std::regex mark(
        R"re(<g data-view="([^"]*)" data-origin-mm="(\S+) (\S+)" data-mm-per-m="([^"]*)")re"
        R"re(|<polygon data-name="([^"]*)" points="([^"]*)")re");
    std::vector<SvgPolygon> polygons;
    std::string view;
    glm::dvec2 origin(0.0);
    double mm_per_m = 1.0;
    for (std::sregex_iterator match(svg.begin(), svg.end(), mark), end; match != end; ++match) {
        if ((*match)[5].matched) {
            std::vector<glm::dvec2> corners = places_of((*match)[6]);
            for (glm::dvec2& corner : corners) {
                corner = (corner - origin) / glm::dvec2(mm_per_m, -mm_per_m);
            }
            polygons.push_back({view, (*match)[5], std::move(corners)});
        } else {
            view = (*match)[1];
            origin = {std::stod((*match)[2]), std::stod((*match)[3])};
            mm_per_m = std::stod((*match)[4]);
        }
    }
    return polygons;
}

inline std::vector<SvgText> texts(const std::string& svg) {
    static const std::regex mark(
        R"re(<text x="([^"]*)" y="([^"]*)" font-size="([^"]*)" text-anchor="([^"]*)")re"
        R"re(( font-weight="bold")?( transform="rotate\((\S+) \S+ \S+\)")?>([^<]*)<)re");
    std::vector<SvgText> found;
    for (std::sregex_iterator match(svg.begin(), svg.end(), mark), end; match != end; ++match) {
        const glm::dvec2 at(std::stod((*match)[1]), std::stod((*match)[2]));
        const double size = std::stod((*match)[3]);
        const std::string words = (*match)[8];
        const double length =
            0.58 * size * static_cast<double>(words.size()); // DejaVu Sans; slightly wider in bold
        const double from = (*match)[4] == "start" ? 0.0 : (*match)[4] == "middle" ? -0.5 * length : -length;
        const double turn = (*match)[7].matched ? glm::radians(std::stod((*match)[7])) : 0.0;
        SvgText text{words, at, at};
        for (const double x : {from, from + length}) {
            for (const double y : {-0.75 * size, 0.0}) { // height of capitals and digits
                const glm::dvec2 corner = at + glm::dvec2(x * std::cos(turn) - y * std::sin(turn),
                                                          x * std::sin(turn) + y * std::cos(turn));
                text.low = glm::min(text.low, corner);
                text.high = glm::max(text.high, corner);
            }
        }
        found.push_back(text);
    }
    return found;
}

} // namespace frustumscreen::drawing
