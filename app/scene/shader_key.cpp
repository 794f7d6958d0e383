#include "app/scene/shader_key.h"

#include "app/torch/content.h"

#include <fmt/format.h>

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
        return fmt::format("torch ({}) on the {}", static_cast<int>(key.content), name_of(lit));
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
    case ShaderKey::Pass::TorchOnSamples:
        return "averaged samples";
    case ShaderKey::Pass::TorchOnPixels:
        return "pixels";
    case ShaderKey::Pass::FarthestDepths:
        return "shadow map of depths";
    }
    return {};
}

std::uint32_t bits_of(const ShaderKey& key) {
    const auto bit = [](bool set, unsigned place) { return static_cast<std::uint32_t>(set) << place; };
    return static_cast<std::uint32_t>(key.pass) << 14U | static_cast<std::uint32_t>(key.content) << 7U |
           bit(key.torch, 6) | bit(key.coloured, 5) | bit(key.blocks, 4) | bit(key.places, 3) |
           bit(key.cut_out, 2) | bit(key.dithered, 1) | bit(key.even_light, 0);
}

ShaderKey places_of(ShaderKey key) {
    key.places = true;
    key.even_light = false;
    key.coloured = false;
    key.torch = false;
    key.content = 0;
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
    both.torches = a.torches;
    both.torches.insert(b.torches.begin(), b.torches.end());
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

RenderNeeds with_torch(RenderNeeds needs, std::uint8_t content) {
    needs.torches.insert(content);
    return needs;
}

RenderNeeds with_torches(RenderNeeds needs) {
    using namespace torch;
    for (const unsigned content : {0U, unsigned{PicturePart}, unsigned{EffectPart}, unsigned{all_parts},
                                   unsigned{LayerPart} | OverPart, unsigned{all_parts} | OverPart}) {
        needs.torches.insert(static_cast<std::uint8_t>(content));
    }
    return needs;
}

ShaderKey torch_of(ShaderKey key, std::uint8_t content) {
    key.torch = true;
    key.coloured = false;
    key.even_light = false;
    key.content = content & 127U;
    return key;
}

namespace {

/// The shaders of torches: their own pictures, and their light on each kind of draw.
void add_torches(const RenderNeeds& needs, std::set<ShaderKey>& shaders) {
    std::set<ShaderKey> lit{{ShaderKey::Pass::TorchOnSamples}, {ShaderKey::Pass::TorchOnPixels}};
    for (const ShaderKey& key : shaders) {
        if (key.pass == ShaderKey::Pass::Surface || key.pass == ShaderKey::Pass::Raster ||
            key.pass == ShaderKey::Pass::RasterInDepth) {
            lit.insert(key);
        }
    }
    shaders.insert({ShaderKey::Pass::FarthestDepths});
    for (ShaderKey key : lit) {
        for (const std::uint8_t content : needs.torches) {
            shaders.insert(torch_of(key, content));
        }
        if (key.pass == ShaderKey::Pass::Surface) {
            key.even_light = key.dithered = key.coloured = false;
            shaders.insert(key); // of their own pictures
        }
    }
}

} // namespace

std::set<ShaderKey> shaders_of(const RenderNeeds& needs) {
    std::set<ShaderKey> shaders = needs.draws;
    shaders.insert({ShaderKey::Pass::Outline});
    if (needs.interlocks || (!needs.torches.empty() && needs.rasterizes)) {
        shaders.insert({ShaderKey::Pass::RasterInDepth});
    }
    if (!needs.torches.empty()) {
        add_torches(needs, shaders);
    }
    if (needs.samples > 1) {
        shaders.insert({ShaderKey::Pass::TileClear});
        shaders.insert({ShaderKey::Pass::TileAverage});
        shaders.insert({ShaderKey::Pass::TileAverageMany}); // slanting views take more samples
    }
    return shaders;
}

} // namespace frustumscreen::scene
