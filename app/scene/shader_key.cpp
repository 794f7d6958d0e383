#include "app/scene/shader_key.h"

#include "app/scene/torch_plan.h"

#include <algorithm>
#include <string_view>

namespace frustumscreen::scene {

namespace {

std::string name_of_light(const ShaderKey& key) {
    return std::string(key.even_light ? " in even light" : " in plain light") +
           (key.coloured ? " of a colour" : "");
}

std::string name_of_surface(const ShaderKey& key) {
    std::string name = key.dithered ? "fading " : "";
    name += key.blocks ? "relief" : key.cut_out ? "cut-out artifact" : "artifact";
    if (key.places) {
        return "places of the " + name;
    }
    return name.append(name_of_light(key));
}

} // namespace

std::string name_of(const ShaderKey& key) {
    if (key.torch) {
        ShaderKey lit = key;
        lit.torch = false;
        return "torch on: " + name_of(lit);
    }
    switch (key.pass) {
    case ShaderKey::Pass::Outline:
        return "outline of a face";
    case ShaderKey::Pass::Surface:
        return name_of_surface(key);
    case ShaderKey::Pass::Raster:
        return "cast relief";
    case ShaderKey::Pass::EdgeFeather:
        return "edges between faces";
    case ShaderKey::Pass::TablePicture:
        return "caption";
    case ShaderKey::Pass::TileClear:
        return "clearing of tiles";
    case ShaderKey::Pass::TileAverage:
        return "averaging of samples";
    case ShaderKey::Pass::TileAverageMany:
        return "averaging of many samples";
    case ShaderKey::Pass::RasterInDepth:
        return "cast relief among polygons";
    }
    return {};
}

std::uint32_t bits_of(const ShaderKey& key) {
    const auto bit = [](bool set, unsigned place) { return static_cast<std::uint32_t>(set) << place; };
    return static_cast<std::uint32_t>(key.pass) << 7U | bit(key.torch, 6) | bit(key.coloured, 5) |
           bit(key.blocks, 4) | bit(key.places, 3) | bit(key.cut_out, 2) | bit(key.dithered, 1) |
           bit(key.even_light, 0);
}

ShaderKey places_of(ShaderKey key) {
    key.places = true;
    key.even_light = false;
    key.coloured = false;
    return key;
}

ShaderKey raster_shader() {
    return {ShaderKey::Pass::Raster};
}

std::optional<geometry::Pinhole> if_it_bends(const geometry::Pinhole& projector) {
    return projector.lens.is_plain() ? std::nullopt : std::optional(projector);
}

RenderNeeds united(const RenderNeeds& a, const RenderNeeds& b) {
    RenderNeeds both{.samples = std::max(a.samples, b.samples),
                     .draws = a.draws,
                     .rasterizes = a.rasterizes || b.rasterizes};
    if (a.samples <= 1 || b.samples <= 1) { // one sample needs no space
        both.outline = a.samples > 1 ? a.outline : b.outline;
    } else if (a.outline && b.outline) {
        both.outline = united(*a.outline, *b.outline);
    }
    both.interlocks = a.interlocks || b.interlocks;
    both.torches = a.torches || b.torches;
    both.bent_by = b.bent_by ? b.bent_by : a.bent_by;
    both.draws.insert(b.draws.begin(), b.draws.end());
    return both;
}

RenderNeeds with_cells(RenderNeeds needs) {
    const std::set<ShaderKey> plain = needs.draws;
    for (ShaderKey key : plain) {
        if (key.pass == ShaderKey::Pass::Surface) {
            key.coloured = true;
            needs.draws.insert(key);
        }
    }
    needs.interlocks = needs.rasterizes;
    return needs;
}

RenderNeeds with_torches(RenderNeeds needs) {
    needs.torches = true;
    return needs;
}

std::set<ShaderKey> shaders_of(const RenderNeeds& needs) {
    std::set<ShaderKey> shaders = needs.draws;
    shaders.insert({ShaderKey::Pass::Outline});
    // A torch's own picture holds reliefs by their depth.
    if (needs.interlocks || (needs.torches && needs.rasterizes)) {
        shaders.insert({ShaderKey::Pass::RasterInDepth});
    }
    if (needs.torches) {
        for (const ShaderKey& key : std::set<ShaderKey>(shaders)) {
            if (key.pass == ShaderKey::Pass::Surface) {
                ShaderKey depth = key; // of the torch's own picture
                depth.even_light = depth.dithered = depth.coloured = false;
                shaders.insert({depth, torch_of(key)});
            }
            if (key.pass == ShaderKey::Pass::Raster || key.pass == ShaderKey::Pass::RasterInDepth) {
                shaders.insert(torch_of(key));
            }
        }
    }
    if (needs.samples > 1) {
        shaders.insert({ShaderKey::Pass::TileClear});
        shaders.insert({ShaderKey::Pass::TileAverage});
        shaders.insert({ShaderKey::Pass::TileAverageMany}); // slanting views take more samples
    }
    return shaders;
}

} // namespace frustumscreen::scene
