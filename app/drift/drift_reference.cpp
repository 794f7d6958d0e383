#include "app/drift/drift_reference.h"

#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::drift {

namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;
constexpr std::size_t max_anchors = 64;
constexpr int max_pixels = 16384; // limit of a camera's side

Json json_of(const glm::dvec2& place) {
    return {place.x, place.y};
}

Json json_of(const AnchorTag& tag) {
    Json corners = Json::array();
    for (const glm::dvec2& corner : tag.corners_px) {
        corners.push_back(json_of(corner));
    }
    return {{"id", tag.id}, {"corners_px", corners}};
}

/// Throws nlohmann's exceptions.
glm::dvec2 place_of(const Json& json) {
    const glm::dvec2 place(json.at(0).get<double>(), json.at(1).get<double>());
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) {
        throw std::invalid_argument("a place is not finite");
    }
    return place;
}

AnchorTag tag_of(const Json& json) {
    AnchorTag tag{json.at("id").get<int>(), {}};
    for (std::size_t k = 0; k < tag.corners_px.size(); ++k) {
        tag.corners_px.at(k) = place_of(json.at("corners_px").at(k));
    }
    return tag;
}

DriftReference reference_of(const Json& json) {
    DriftReference reference;
    reference.width = json.at("width").get<int>();
    reference.height = json.at("height").get<int>();
    for (const Json& mark : json.at("marks")) {
        reference.marks_m.push_back(place_of(mark.at("table_m")));
        const Json& pixel = mark.at("camera_px");
        reference.marks_px.push_back(pixel.is_null() ? std::nullopt : std::optional(place_of(pixel)));
    }
    for (const Json& tag : json.at("anchors")) {
        reference.anchors.push_back(tag_of(tag));
    }
    const bool is_sized = reference.width > 0 && reference.height > 0 && reference.width <= max_pixels &&
                          reference.height <= max_pixels;
    if (json.at("version").get<int>() != version || !is_sized || reference.marks_m.size() > max_marks ||
        reference.anchors.size() > max_anchors) {
        throw std::invalid_argument("another version, or numbers out of range");
    }
    return reference;
}

} // namespace

std::size_t MarkSet::seen() const {
    return static_cast<std::size_t>(
        std::count_if(marks_px.begin(), marks_px.end(), [](const auto& mark) { return mark.has_value(); }));
}

bool DriftReference::fits(const std::vector<glm::dvec2>& places_m) const {
    constexpr double same_m = 1e-7; // far above the rounding of a calibration that was written and read
    return std::equal(marks_m.begin(), marks_m.end(), places_m.begin(), places_m.end(),
                      [](const glm::dvec2& a, const glm::dvec2& b) { return glm::distance(a, b) < same_m; });
}

std::string drift_reference_text(const DriftReference& reference) {
    Json marks = Json::array();
    for (std::size_t k = 0; k < reference.marks_m.size(); ++k) {
        const std::optional<glm::dvec2>& pixel = reference.marks_px[k];
        marks.push_back({{"table_m", json_of(reference.marks_m[k])},
                         {"camera_px", pixel ? json_of(*pixel) : Json(nullptr)}});
    }
    Json anchors = Json::array();
    for (const AnchorTag& tag : reference.anchors) {
        anchors.push_back(json_of(tag));
    }
    const Json json{{"version", version},
                    {"width", reference.width},
                    {"height", reference.height},
                    {"marks", marks},
                    {"anchors", anchors}};
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<DriftReference> parse_drift_reference(std::string_view text, std::string_view file) {
    try {
        return reference_of(Json::parse(text));
    } catch (const std::exception& error) {
        return bad_input("drift.unreadable_reference",
                         "{}: the positions of the marks cannot be read: {}; the camera learns them again",
                         file, error.what());
    }
}

} // namespace frustumscreen::drift
