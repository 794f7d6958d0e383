#include "app/pack/check_pack.h"
#include "app/pack/pack_text.h"
#include "app/pack/torch_limits.h"
#include "app/pack/torch_sections.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace frustumscreen::pack {

namespace {

using torch::Source;

struct Allowed {
    std::string_view field;
    double value = 0.0, low = 0.0, high = 0.0;
};

std::array<Allowed, 12> numbers_of(const torch::Stage& stage) {
    return {{{"colour", stage.colour.x, 0.0, torch_limits::colour},
             {"colour", stage.colour.y, 0.0, torch_limits::colour},
             {"colour", stage.colour.z, 0.0, torch_limits::colour},
             {"opacity", stage.opacity, 0.0, 1.0},
             {"size", stage.size, torch_limits::min_size, torch_limits::max_size},
             {"width", stage.width, torch_limits::min_width, torch_limits::max_width},
             {"magnification", stage.magnification, 1.0, torch_limits::magnification},
             {"scroll_per_s", stage.scroll_per_s.x, -torch_limits::scroll_per_s, torch_limits::scroll_per_s},
             {"scroll_per_s", stage.scroll_per_s.y, -torch_limits::scroll_per_s, torch_limits::scroll_per_s},
             {"turn_rad_per_s", stage.turn_rad_per_s, -torch_limits::turn_rad_per_s,
              torch_limits::turn_rad_per_s},
             {"pulse_hz", stage.pulse_hz, 0.0, torch_limits::pulse_hz},
             {"pulse_depth", stage.pulse_depth, 0.0, 1.0}}};
}

Result<void> check_stage(const std::string& place, const torch::Stage& stage, const PackTorches& torches) {
    for (const Allowed& number : numbers_of(stage)) {
        if (!(number.value >= number.low && number.value <= number.high)) { // false for NaN too
            return bad_input("torch_section.number", "{} has {} {}; allowed are {} to {}", place,
                             number.field, number.value, number.low, number.high);
        }
    }
    std::size_t items = 1; // item 0, which nothing uses
    if (stage.source == Source::Picture || stage.source == Source::Film || stage.source == Source::Layer) {
        items = stage.source == Source::Picture ? torches.pictures.size()
                : stage.source == Source::Film  ? torches.films.size()
                                                : torches.layers.size();
    }
    if (stage.item >= items) {
        return bad_input("torch_section.item", "{} uses number {} of {}; bake the pack again", place,
                         stage.item, items);
    }
    return {};
}

Result<void> check_content(const std::string& place, const torch::Content& content,
                           const PackTorches& torches) {
    if (fault_of_text(content.name, TextShape::Line) || content.name.empty() ||
        content.name == torch::white_name) {
        return bad_input("torch_section.name",
                         "{} is called '{}'; allowed is one line that is not empty and not '{}'", place,
                         printable(content.name, 40), torch::white_name);
    }
    if (const std::optional<std::string> fault = torch_limits::fault_of_stages(content.stages)) {
        return bad_input("torch_section.stages", "{} {}", place, *fault);
    }
    if (!(content.height_per_width >= torch_limits::min_height_per_width &&
          content.height_per_width <= torch_limits::max_height_per_width)) {
        return bad_input("torch_section.shape", "{} has height_per_width {}; allowed are {} to {}", place,
                         content.height_per_width, torch_limits::min_height_per_width,
                         torch_limits::max_height_per_width);
    }
    for (std::size_t k = 0; k < content.stages.size(); ++k) {
        TRY_VOID(check_stage(fmt::format("stage {} of {}", k, place), content.stages[k], torches));
    }
    return {};
}

Result<void> check_extent(const std::string& place, int width, int height, int max_px) {
    if (std::min(width, height) < min_torch_picture_px || std::max(width, height) > max_px) {
        return bad_input("torch_section.size", "{} has {} x {} pixels; allowed are {} to {} a side", place,
                         width, height, min_torch_picture_px, max_px);
    }
    return {};
}

Result<void> check_film(const std::string& place, const PackFilm& film) {
    TRY_VOID(check_extent(place, film.width, film.height, max_film_px));
    if (film.frames < 1 || film.frames > max_film_frames || !(film.rate_hz >= torch_limits::min_rate_hz) ||
        !(film.rate_hz <= torch_limits::max_rate_hz)) {
        return bad_input("torch_section.film",
                         "{} has {} frames, {} a second; allowed are 1 to {}, {} to {} a second", place,
                         film.frames, film.rate_hz, max_film_frames, torch_limits::min_rate_hz,
                         torch_limits::max_rate_hz);
    }
    return {};
}

Result<void> check_layers(const std::vector<PackLayer>& layers) {
    std::set<std::string_view> names;
    for (const PackLayer& layer : layers) {
        if (fault_of_text(layer.name, TextShape::Line) || layer.name.empty() ||
            !names.insert(layer.name).second || layer.textures.empty()) {
            return bad_input("torch_section.layer",
                             "a layer is called '{}' and has {} textures; allowed is each name once, not "
                             "empty, with a picture for each texture of the pack",
                             printable(layer.name, 40), layer.textures.size());
        }
    }
    return {};
}

} // namespace

namespace torch_limits {

std::optional<std::string> fault_of_stages(std::span<const torch::Stage> stages) {
    if (stages.empty() || stages.size() > torch::max_stages) {
        return fmt::format("has {} stages; allowed are 1 to {}", stages.size(), torch::max_stages);
    }
    const auto count = [&](Source source) {
        return std::count_if(stages.begin(), stages.end(),
                             [&](const torch::Stage& stage) { return stage.source == source; });
    };
    if (count(Source::Picture) + count(Source::Film) > 1 || count(Source::Layer) > 1 ||
        count(Source::Lens) > 1) {
        return "has more than one picture or film, more than one layer, or more than one lens; allowed is "
               "one "
               "of each: make a second content of the others";
    }
    return std::nullopt;
}

} // namespace torch_limits

Result<void> check_torch_fields(const PackTorches& torches) {
    std::set<std::string_view> names;
    for (std::size_t k = 0; k < torches.contents.size(); ++k) {
        const PackTorchContent& packed = torches.contents[k];
        const std::string place = fmt::format("torch content {}", k);
        TRY_VOID(check_content(place, packed.content, torches));
        if (!names.insert(packed.content.name).second) {
            return bad_input("torch_section.name_twice", "two torch contents are called '{}'; allowed is one",
                             printable(packed.content.name, 40));
        }
        TRY_VOID(check_labels(place, packed.titles));
    }
    for (std::size_t k = 0; k < torches.pictures.size(); ++k) {
        const PackTorchPicture& picture = torches.pictures[k];
        TRY_VOID(check_extent(fmt::format("torch picture {}", k), picture.width, picture.height,
                              max_torch_picture_px));
    }
    for (std::size_t k = 0; k < torches.films.size(); ++k) {
        TRY_VOID(check_film(fmt::format("torch film {}", k), torches.films[k]));
    }
    return check_layers(torches.layers);
}

} // namespace frustumscreen::pack
