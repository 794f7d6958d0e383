#include "app/settings/config_json.h"

#include "app/settings/lit_zone.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace frustumscreen {

namespace {

using Json = nlohmann::ordered_json;

Json list_of(const glm::dvec2& v) {
    return {v.x, v.y};
}
Json list_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json list_of(const glm::dmat4& matrix) {
    Json list = Json::array();
    for (int k = 0; k < 16; ++k) {
        list.push_back(matrix[k / 4][k % 4]);
    }
    return list;
}

Json list_of(const std::vector<glm::dvec2>& polygon) {
    Json list = Json::array();
    for (const glm::dvec2& corner : polygon) {
        list.push_back(list_of(corner));
    }
    return list;
}

Json projector_json(const ProjectorSettings& projector) {
    const Pinhole& p = projector.pinhole;
    return {{"width", p.width},
            {"height", p.height},
            {"fx", p.fx},
            {"fy", p.fy},
            {"cx", p.cx},
            {"cy", p.cy},
            {"table_from_projector", list_of(projector.table_from_projector.matrix())},
            {"refresh_hz", projector.refresh_hz}};
}

Json display_json(const DisplaySettings& display) {
    return {{"kind", std::string(name_of(display.kind))},
            {"card", display.card},
            {"connector", display.connector},
            {"mode", text_of(display.mode)},
            {"force", display.force}};
}

Json prop_json(const PropSettings& prop) {
    Json faces = Json::array();
    for (const PropFace& face : make_prop(prop).faces) {
        Json corners = Json::array();
        for (const glm::dvec3& corner : face.corners) {
            corners.push_back(list_of(corner));
        }
        faces.push_back({{"name", std::string(face.name)},
                         {"normal", list_of(face.plane.normal)},
                         {"corners", std::move(corners)}});
    }
    return {{"kind", std::string(name_of(prop.kind))},
            {"base_m", prop.base_m},
            {"top_m", prop.top_m},
            {"height_m", prop.height_m},
            {"zone", std::string(name_of(prop.zone))},
            {"faces", std::move(faces)}};
}

Json lit_zone_json(const Settings& settings) {
    const LitZone zone = lit_zone(settings);
    return {
        {"least_sine_of_light", least_sine_of_light},
        {"any_eye",
         {{"area_m2", area_of(zone.any_eye)},
          {"rectangle_centre_m", list_of(zone.any_eye_rectangle.centre_m)},
          {"rectangle_half_m", list_of(zone.any_eye_rectangle.half_m)},
          {"polygon_m", list_of(zone.any_eye)}}},
        {"default_eye", {{"area_m2", area_of(zone.default_eye)}, {"polygon_m", list_of(zone.default_eye)}}}};
}

Json tracker_json(const TrackerSettings& tracker) {
    return {{"kind", std::string(name_of(tracker.kind))},
            {"seed", tracker.seed},
            {"poses", tracker.poses.string()},
            {"replay_speed", tracker.replay_speed},
            {"hemisphere", list_of(tracker.hemisphere)},
            {"table_from_tracker", list_of(tracker.table_from_tracker.matrix())},
            {"display_latency_ms", tracker.display_latency_ms}};
}

Json panel_json(const PanelSettings& panel) {
    Json script = Json::array();
    for (const ScriptedPress& press : panel.script) {
        script.push_back({{"at_s", press.at_s}, {"button", press.button}});
    }
    return {{"kind", std::string(name_of(panel.kind))},
            {"script", script},
            {"repeat_s", panel.repeat_s},
            {"chip", panel.chip},
            {"lines", panel.lines},
            {"bias", std::string(name_of(panel.bias))},
            {"active_low", panel.active_low},
            {"lamps", panel.lamps},
            {"device", panel.device},
            {"keys", panel.keys},
            {"debounce_ms", panel.debounce_ms},
            {"stuck_s", panel.stuck_s}};
}

Json exhibit_json(const ExhibitSettings& exhibit) {
    Json packs = Json::array();
    for (const auto& pack : exhibit.packs) {
        packs.push_back(pack.string());
    }
    return {{"packs", packs},
            {"language", exhibit.language},
            {"captions", exhibit.captions},
            {"caption_height_m", exhibit.caption_height_m}};
}

} // namespace

std::string config_json(const CheckedSettings& checked) {
    const Settings& settings = *checked;
    Json json;
    json["projector"] = projector_json(settings.projector);
    json["display"] = display_json(settings.display);
    json["render"] = {{"error_tolerance_px", settings.render.error_tolerance_px}};
    json["prop"] = prop_json(settings.prop);
    json["table"] = {{"width_m", settings.table.width_m}, {"depth_m", settings.table.depth_m}};
    json["eye_default_m"] = list_of(settings.eye.default_m);
    json["eye_tracked"] = settings.eye.tracked;
    json["eye_zone"] = {{"lowest_elevation_deg", settings.eye.lowest_elevation_deg},
                        {"nearest_m", settings.eye.nearest_m},
                        {"farthest_m", settings.eye.farthest_m}};
    json["lit_zone"] = lit_zone_json(settings);
    json["tracker"] = tracker_json(settings.tracker);
    json["panel"] = panel_json(settings.panel);
    json["exhibit"] = exhibit_json(settings.exhibit);
    // `replace`: a path's bytes need not be UTF-8, and a report must not fail over that.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen
