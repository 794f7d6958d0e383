#include "assets_baked/artifacts/builtin.h"

#include "assets_baked/artifacts/amphora.h"
#include "assets_baked/artifacts/hall/hall.h"
#include "assets_baked/artifacts/nautilus_cup.h"

#include <fmt/format.h>

#include <string>

namespace frustumscreen::artifacts {
namespace {

constexpr std::int64_t fewest_triangles = 1'000;
constexpr std::int64_t max_triangles = 50'000'000;

} // namespace

std::vector<std::string_view> builtin_names() {
    return {"amphora", "nautilus-cup"};
}

Result<bake::SourceMesh> make_builtin(std::string_view name, std::int64_t triangles) {
    if (triangles < fewest_triangles || triangles > max_triangles) {
        return bad_input("artifact.triangles", "{} triangles are asked for; allowed are {} to {}", triangles,
                         fewest_triangles, max_triangles);
    }
    if (name == "amphora") {
        return make_amphora(triangles);
    }
    if (name == "nautilus-cup") {
        return make_nautilus_cup(triangles);
    }
    std::string names = "amphora, nautilus-cup";
    for (const HallObject& object : hall_objects()) {
        if (object.name == name) {
            return object.make(triangles);
        }
        names += fmt::format(", {}", object.name);
    }
    return bad_input("artifact.no_such", "no built-in artifact is named '{}'; allowed are {}", name, names);
}

std::vector<BuiltinLayer> builtin_layers(std::string_view name) {
    std::vector<BuiltinLayer> layers;
    if (name == "amphora") {
        layers.push_back({"new-colours.png", new_amphora_colours()});
    }
    return layers;
}

} // namespace frustumscreen::artifacts
