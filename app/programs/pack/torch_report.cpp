#include "app/programs/pack/torch_report.h"

#include "app/pack/pack_torches.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;
using torch::Source;

pack::PackTorches known_torches(const pack::PackDescription& pack) {
    return pack::torches_of(pack).value_or(pack::PackTorches());
}

template <typename Names> std::string_view name_in(const Names& names, auto value) {
    return names.at(static_cast<std::size_t>(value));
}

/// The parts of what a stage shows; none for an effect.
std::vector<std::string> parts_of(const torch::Stage& stage, const pack::PackTorches& torches) {
    switch (stage.source) {
    case Source::Picture:
        return {torches.pictures[stage.item].part};
    case Source::Film:
        return torches.films[stage.item].parts;
    case Source::Layer: {
        std::vector<std::string> parts = torches.layers[stage.item].textures;
        const std::vector<std::string>& reliefs = torches.layers[stage.item].reliefs;
        parts.insert(parts.end(), reliefs.begin(), reliefs.end());
        return parts;
    }
    default:
        return {};
    }
}

std::uint64_t stored_bytes(const std::vector<std::string>& names, std::span<const pack::PackPart> parts) {
    std::uint64_t bytes = 0;
    for (const std::string& name : names) {
        const auto found = std::find_if(parts.begin(), parts.end(),
                                        [&](const pack::PackPart& part) { return part.name == name; });
        bytes += found != parts.end() ? found->stored_bytes : 0;
    }
    return bytes;
}

Json stage_json(const torch::Stage& stage, const pack::PackTorches& torches,
                std::span<const pack::PackPart> parts) {
    Json json = {{"source", name_in(torch::source_names, stage.source)},
                 {"mix", name_in(torch::mix_names, stage.mix)},
                 {"opacity", stage.opacity}};
    if (stage.source == Source::Picture) {
        const pack::PackTorchPicture& picture = torches.pictures[stage.item];
        json.update({{"width", picture.width}, {"height", picture.height}});
    } else if (stage.source == Source::Film) {
        const pack::PackFilm& film = torches.films[stage.item];
        json.update({{"width", film.width},
                     {"height", film.height},
                     {"frames", film.frames},
                     {"rate_hz", film.rate_hz}});
    } else if (stage.source == Source::Layer) {
        json["layer"] = torches.layers[stage.item].name;
    }
    if (const std::vector<std::string> its = parts_of(stage, torches); !its.empty()) {
        json["bytes"] = stored_bytes(its, parts);
    }
    return json;
}

std::string stage_text(const torch::Stage& stage, const pack::PackTorches& torches,
                       std::span<const pack::PackPart> parts) {
    std::string text(name_in(torch::source_names, stage.source));
    if (stage.source == Source::Picture) {
        const pack::PackTorchPicture& picture = torches.pictures[stage.item];
        text += fmt::format(" of {} x {} pixels", picture.width, picture.height);
    } else if (stage.source == Source::Film) {
        const pack::PackFilm& film = torches.films[stage.item];
        text += fmt::format(" of {} frames of {} x {} pixels, {:.3g} a second", film.frames, film.width,
                            film.height, film.rate_hz);
    } else if (stage.source == Source::Layer) {
        text += fmt::format(" {}", torches.layers[stage.item].name);
    }
    if (const std::vector<std::string> its = parts_of(stage, torches); !its.empty()) {
        text += fmt::format(" ({:.0f} kB)", std::ceil(static_cast<double>(stored_bytes(its, parts)) / 1e3));
    }
    return text;
}

} // namespace

Json torches_json(const pack::PackDescription& pack, std::span<const pack::PackPart> parts) {
    const pack::PackTorches torches = known_torches(pack);
    Json json = Json::array();
    for (const pack::PackTorchContent& packed : torches.contents) {
        const torch::Content& content = packed.content;
        Json stages = Json::array();
        for (const torch::Stage& stage : content.stages) {
            stages.push_back(stage_json(stage, torches, parts));
        }
        Json titles = Json::object();
        for (const pack::PackLabel& title : packed.titles) {
            titles[title.language] = title.text;
        }
        json.push_back(
            {{"name", content.name},
             {"blend", name_in(torch::blend_names, content.blend)},
             {"shape", content.shape ? Json(name_in(torch::shape_names, *content.shape)) : Json(nullptr)},
             {"height_per_width", content.height_per_width},
             {"stages", std::move(stages)},
             {"titles", std::move(titles)}});
    }
    return json;
}

std::string torches_text(const pack::PackDescription& pack, std::span<const pack::PackPart> parts) {
    const pack::PackTorches torches = known_torches(pack);
    std::string text;
    for (const pack::PackTorchContent& packed : torches.contents) {
        std::vector<std::string> stages;
        for (const torch::Stage& stage : packed.content.stages) {
            stages.push_back(stage_text(stage, torches, parts));
        }
        text += fmt::format("  torch {}: {}; {}", packed.content.name, fmt::join(stages, ", "),
                            name_in(torch::blend_names, packed.content.blend));
        for (const pack::PackLabel& title : packed.titles) {
            text += fmt::format("; {}: {}", title.language, title.text);
        }
        text += "\n";
    }
    return text;
}

} // namespace frustumscreen::programs
