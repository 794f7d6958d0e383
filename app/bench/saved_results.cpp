#include "app/bench/saved_results.h"

#include "app/bench/measures/report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace frustumscreen {

namespace {

using nlohmann::json;

double number(const json& object, const char* key) {
    return object.at(key).get<double>(); // throws for anything else
}

PictureError error_of(const json& object) {
    PictureError error;
    error.silhouette_percent = number(object, "silhouette_percent");
    error.outline_shift_px = number(object, "outline_shift_px");
    error.geometric_mean_mm = number(object, "geometric_mean_mm");
    error.geometric_p95_mm = number(object, "geometric_p95_mm");
    error.one_ray = {number(object, "rmse_1_ray"), number(object, "bad_1_ray_percent")};
    error.sixteen_rays = {number(object, "rmse_16_rays"), number(object, "bad_16_rays_percent")};
    return error;
}

std::optional<TechniqueResult> technique_of(const json& object) {
    const std::optional<TechniqueKind> kind = kind_of(object.at("kind").get<std::string>());
    if (!kind) {
        return std::nullopt;
    }
    TechniqueResult technique;
    technique.kind = *kind;
    technique.name = object.at("name").get<std::string>();
    technique.triangles = object.at("triangles").get<std::uint64_t>();
    technique.times_floor = number(object, "times_floor");
    if (*kind != TechniqueKind::Floor) {
        technique.error.mean = error_of(object.at("mean"));
        technique.error.worst = error_of(object.at("worst"));
    }
    return technique;
}

ArtifactResults results_of(const json& object) {
    ArtifactResults results;
    results.title = object.at("pack").get<std::string>();
    for (const json& set_up : object.at("set_ups")) {
        SetUpResult result;
        result.name = set_up.at("name").get<std::string>();
        for (const json& technique : set_up.at("techniques")) {
            if (std::optional<TechniqueResult> one = technique_of(technique)) {
                result.techniques.push_back(std::move(*one));
            }
        }
        results.set_ups.push_back(std::move(result));
    }
    return results;
}

} // namespace

Result<ArtifactResults> read_results(std::string_view text) {
    try {
        ArtifactResults results = results_of(json::parse(text));
        if (results.set_ups.empty()) {
            return bad_input("holds no set-up; measure again with frustumscreen-bench error-time");
        }
        return results;
    } catch (const json::exception& error) {
        std::string reason = error.what();
        reason = reason.substr(0, reason.find('\n'));
        return bad_input("is not what frustumscreen-bench error-time writes (" + reason + "); measure again");
    }
}

} // namespace frustumscreen
