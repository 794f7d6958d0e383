#include "app/settings/config_json.h"

#include "app/settings/describe_settings.h"
#include "app/settings/light_range.h"
#include "app/settings/lit_zone.h"
#include "app/settings/whole_zone.h"
#include "firmware_host/base/json.h"

namespace frustumscreen::settings {

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

/// Walks the description of the settings and keeps each under its name.
class Report {
public:
    static constexpr bool reads = false;

    void number(const char* key, double value, const Range&, std::string_view) { json_[key] = value; }
    void vector(const char* key, const glm::dvec3& value, const Range&, std::string_view) {
        json_[key] = list_of(value);
    }
    void points(const char* key, std::span<const glm::dvec3> values, const Range&, std::string_view) {
        json_[key] = Json::array();
        for (const glm::dvec3& value : values) {
            json_[key].push_back(list_of(value));
        }
    }
    /// An input is not reported: the settings that were computed from it are.
    void input(const char*, const auto&, const Range&, std::string_view) {}
    void rigid(const char* key, const geometry::RigidTransform& value, const Range&, std::string_view) {
        json_[key] = list_of(value.matrix());
    }
    void integer(const char* key, int value, int, int, std::string_view) { json_[key] = value; }
    void integer(const char* key, std::uint64_t value, std::string_view) { json_[key] = value; }
    void flag(const char* key, bool value, std::string_view) { json_[key] = value; }
    void text(const char* key, const std::string& value, std::string_view) { json_[key] = value; }
    void long_text(const char*, const std::string&, std::string_view) {} // of a solid: its faces are reported
    void texts(const char* key, const std::vector<std::string>& values, std::size_t, std::string_view) {
        json_[key] = values;
    }
    void path(const char* key, const std::filesystem::path& value, std::string_view) {
        json_[key] = value.string();
    }
    void paths(const char* key, const std::vector<std::filesystem::path>& values, std::size_t,
               std::string_view) {
        json_[key] = Json::array();
        for (const std::filesystem::path& value : values) {
            json_[key].push_back(value.string());
        }
    }
    template <typename Choice>
    void choice(const char* key, Choice value, std::span<const std::string_view> words, std::string_view) {
        json_[key] = words[static_cast<std::size_t>(value)];
    }
    void parsed(const char* key, const auto& value, const auto& to_text, const auto&, std::string_view,
                std::string_view) {
        json_[key] = to_text(value);
    }
    void parsed_list(const char* key, const auto& values, std::size_t, const auto& to_text, const auto&,
                     std::string_view, std::string_view) {
        json_[key] = Json::array();
        for (const auto& value : values) {
            json_[key].push_back(to_text(value));
        }
    }
    void table(const char* name, std::string_view, const auto& describe) {
        Report inner;
        describe(inner);
        json_[name] = std::move(inner.json_);
    }
    void tables(const char* key, const auto& values, std::size_t, const auto& describe, std::string_view) {
        json_[key] = Json::array();
        for (const auto& value : values) {
            Report item;
            describe(item, value);
            json_[key].push_back(std::move(item.json_));
        }
    }
    void require(MessageId, bool, const char*, std::string_view) {}

    [[nodiscard]] const Json& json() const { return json_; }

private:
    Json json_ = Json::object();
};

Json faces_json(const geometry::PropShape& prop) {
    Json faces = Json::array();
    for (const geometry::PropFace& face : prop.faces) {
        Json corners = Json::array();
        for (const glm::dvec3& corner : face.corners) {
            corners.push_back(list_of(corner));
        }
        faces.push_back({{"name", std::string(face.name)},
                         {"normal", list_of(face.plane.normal)},
                         {"corners", std::move(corners)}});
    }
    return faces;
}

Json whole_zone_json(const WholeZone& zone) {
    return {{"area_m2", area_of(zone.places)},
            {"rectangle_centre_m", list_of(zone.rectangle.centre_m)},
            {"rectangle_half_m", list_of(zone.rectangle.half_m)},
            {"polygon_m", list_of(zone.places)}};
}

/// For a typical artifact; `config --explain` has the zones of the packs.
Json usual_zone_json(const Settings& settings) {
    const std::vector<glm::dvec3> hull = usual_artifact(make_prop(settings.prop));
    glm::dvec3 low(hull.front());
    glm::dvec3 high(low);
    for (const glm::dvec3& corner : hull) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    return {
        {"artifact_m", list_of(high - low)},
        {"all_eyes", whole_zone_json(whole_zone(settings, all_eyes(settings.eye), hull))},
        {"eyes_like_default", whole_zone_json(whole_zone(settings, eyes_like_default(settings.eye), hull))}};
}

Json lit_zone_json(const Settings& settings) {
    const LitZone zone = lit_zone(settings);
    return {
        {"least_sine_of_light", min_sine_of_light},
        {"any_eye",
         {{"area_m2", area_of(zone.any_eye)},
          {"rectangle_centre_m", list_of(zone.any_eye_rectangle.centre_m)},
          {"rectangle_half_m", list_of(zone.any_eye_rectangle.half_m)},
          {"polygon_m", list_of(zone.any_eye)}}},
        {"default_eye", {{"area_m2", area_of(zone.default_eye)}, {"polygon_m", list_of(zone.default_eye)}}},
        {"whole", usual_zone_json(settings)}};
}

Json light_json(const Settings& settings) {
    const LightRange range =
        light_range(make_prop(settings.prop), settings.projector.table_from_projector.translation,
                    reach_on_table(settings.prop, settings.table));
    return {{"least_sine", min_sine_of_light},
            {"least", range.least},
            {"most", range.most},
            {"evenness", range.evenness},
            {"reference", even_light(settings)}};
}

Json calibration_json(const Calibration& used, const std::string& name) {
    return {{"file", name},
            {"made", used.made},
            {"method", name_of(used.method)},
            {"places", used.places},
            {"residual_mm", {{"mean", used.mean_mm}, {"worst", used.worst_mm}}},
            {"residual_px", {{"mean", used.mean_px}}}};
}

/// Adds the eye's settings under the names that external checks use.
void add_eye(const Json& eye, Json& json) {
    json["eye_default_m"] = eye.at("default_m");
    json["eye_tracked"] = eye.at("tracked");
    for (const char* key : {"lowest_elevation_deg", "nearest_m", "farthest_m"}) {
        json["eye_zone"][key] = eye.at(key);
    }
}

} // namespace

std::string config_json(const CheckedSettings& checked) {
    Report report;
    all_settings(report, *checked);
    Json json;
    for (const auto& [name, table] : report.json().items()) {
        if (name == "eye") {
            add_eye(table, json);
            json["lit_zone"] = lit_zone_json(*checked);
            json["light"] = light_json(*checked);
        } else if (name == "prop") {
            json[name] = table;
            if (checked->prop.kind != PropKind::Solid) {
                for (const char* key : {"file", "unit", "lit_faces"}) {
                    json[name].erase(key);
                }
            }
            json[name]["faces"] = faces_json(make_prop(checked->prop));
        } else if (name == "screen" && !checked->screen.exists()) {
            continue; // its keys mean nothing
        } else if (name == "calibration") {
            json[name] = table;
            if (checked->calibration.used) {
                json[name]["used"] =
                    calibration_json(*checked->calibration.used, checked->calibration.used_name);
            }
        } else {
            json[name] = table;
        }
    }
    // `replace`: a path's bytes need not be UTF-8, and must not make a report fail.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen::settings
