#include "app/pack/torch_sections.h"

#include "app/pack/container/limits.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/world_sections.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen::pack {

namespace {

constexpr std::uint64_t max_items = max_contents * torch::max_stages; ///< pictures
/// Shape of a content that leaves it to the torch.
constexpr std::array<std::string_view, 3> shape_words{"torch", torch::shape_names[0], torch::shape_names[1]};

/// A stage as in the file.
struct StageRecord {
    torch::Stage stage;
    std::array<double, 3> colour{};
    std::array<double, 2> scroll{};
};
struct ContentRecord {
    PackTorchContent packed; ///< without stages
    std::size_t shape = 0;   ///< of shape_words
    std::vector<StageRecord> stages;
};
struct LayerRecord {
    std::string name;
    std::uint32_t textures = 0, reliefs = 0;
};
struct SectionRecord {
    std::vector<ContentRecord> contents;
    std::vector<PackTorchPicture> pictures;
    std::vector<PackFilm> films;
    std::vector<LayerRecord> layers;
};

void stage_fields(auto& fields, auto& record) {
    auto& stage = record.stage;
    fields.choice("source", stage.source, torch::source_names);
    fields.choice("mix", stage.mix, torch::mix_names);
    fields.whole("item", stage.item, max_items);
    fields.numbers("colour", std::span(record.colour));
    fields.number("opacity", stage.opacity);
    fields.number("size", stage.size);
    fields.number("width", stage.width);
    fields.number("magnification", stage.magnification);
    fields.numbers("scroll_per_s", std::span(record.scroll));
    fields.number("turn_rad_per_s", stage.turn_rad_per_s);
    fields.number("pulse_hz", stage.pulse_hz);
    fields.number("pulse_depth", stage.pulse_depth);
}

void content_fields(auto& fields, auto& record) {
    auto& content = record.packed.content;
    fields.text("name", content.name);
    fields.choice("blend", content.blend, torch::blend_names);
    fields.choice("shape", record.shape, shape_words);
    fields.number("height_per_width", content.height_per_width);
    fields.objects("titles", record.packed.titles, max_languages, [](auto& item, auto& title) {
        item.text("language", title.language);
        item.text("text", title.text);
    });
    fields.objects("stages", record.stages, torch::max_stages,
                   [](auto& item, auto& stage) { stage_fields(item, stage); });
}

void section_fields(auto& fields, auto& section) {
    fields.objects("contents", section.contents, max_contents,
                   [](auto& item, auto& content) { content_fields(item, content); });
    fields.objects("pictures", section.pictures, max_items, [](auto& item, auto& picture) {
        item.whole("width", picture.width, max_torch_picture_px);
        item.whole("height", picture.height, max_torch_picture_px);
    });
    fields.objects("films", section.films, max_films, [](auto& item, auto& film) {
        item.whole("width", film.width, max_film_px);
        item.whole("height", film.height, max_film_px);
        item.whole("frames", film.frames, max_film_frames);
        item.number("rate_hz", film.rate_hz);
    });
    fields.objects("layers", section.layers, max_layers, [](auto& item, auto& layer) {
        item.text("name", layer.name);
        item.whole("textures", layer.textures, max_textures);
        item.whole("reliefs", layer.reliefs, max_reliefs);
    });
}

StageRecord record_of(const torch::Stage& stage) {
    const auto few = [](float value) { return in_few_digits(value); };
    return {.stage = stage,
            .colour = {few(stage.colour.x), few(stage.colour.y), few(stage.colour.z)},
            .scroll = {stage.scroll_per_s.x, stage.scroll_per_s.y}};
}

torch::Stage stage_of(const StageRecord& record) {
    torch::Stage stage = record.stage;
    stage.colour = glm::vec3(record.colour[0], record.colour[1], record.colour[2]);
    stage.scroll_per_s = {record.scroll[0], record.scroll[1]};
    return stage;
}

SectionRecord record_of(const PackTorches& torches) {
    SectionRecord section{{}, torches.pictures, torches.films, {}};
    for (const PackTorchContent& packed : torches.contents) {
        ContentRecord& record = section.contents.emplace_back();
        record.packed = packed;
        const std::optional<torch::Shape> shape = packed.content.shape;
        record.shape = shape ? 1 + static_cast<std::size_t>(*shape) : 0;
        for (const torch::Stage& stage : packed.content.stages) {
            record.stages.push_back(record_of(stage));
        }
    }
    for (const PackLayer& layer : torches.layers) {
        section.layers.push_back({layer.name, static_cast<std::uint32_t>(layer.textures.size()),
                                  static_cast<std::uint32_t>(layer.reliefs.size())});
    }
    return section;
}

PackTorchContent content_of(ContentRecord record) {
    PackTorchContent packed = std::move(record.packed);
    if (record.shape > 0) {
        packed.content.shape = static_cast<torch::Shape>(record.shape - 1);
    }
    for (const StageRecord& stage : record.stages) {
        packed.content.stages.push_back(stage_of(stage));
    }
    return packed;
}

/// Gives out the section's parts in their order.
class Parts {
public:
    explicit Parts(const std::vector<std::string>& parts) : parts_(parts) {}

    [[nodiscard]] std::string next() { return used_ < parts_.size() ? parts_[used_++] : too_few(); }
    [[nodiscard]] std::vector<std::string> next(std::size_t count) {
        std::vector<std::string> names;
        for (std::size_t k = 0; k < count && !short_; ++k) {
            names.push_back(next());
        }
        return names;
    }
    [[nodiscard]] bool all_used() const { return !short_ && used_ == parts_.size(); }

private:
    std::string too_few() {
        short_ = true;
        return {};
    }
    const std::vector<std::string>& parts_;
    std::size_t used_ = 0;
    bool short_ = false;
};

Result<PackTorches> torches_from(SectionRecord section, const std::vector<std::string>& names) {
    PackTorches torches{{}, std::move(section.pictures), std::move(section.films), {}};
    for (ContentRecord& record : section.contents) {
        torches.contents.push_back(content_of(std::move(record)));
    }
    Parts parts(names);
    for (PackTorchPicture& picture : torches.pictures) {
        picture.part = parts.next();
    }
    for (PackFilm& film : torches.films) {
        film.parts = parts.next(film.frames);
    }
    for (LayerRecord& record : section.layers) {
        PackLayer& layer = torches.layers.emplace_back();
        layer.name = std::move(record.name);
        layer.textures = parts.next(record.textures);
        layer.reliefs = parts.next(record.reliefs);
    }
    if (!parts.all_used()) {
        return bad_input("torch_section.parts",
                         "the section {} has {} parts, more or fewer than its pictures, films and layers "
                         "need; bake the pack again",
                         torches_section, names.size());
    }
    return torches;
}

} // namespace

Result<PackTorches> read_torch_section(const PackDescription& pack) {
    const PackSection* const section = find_section(pack, torches_section);
    if (section == nullptr) {
        return PackTorches{};
    }
    Refusal refusal;
    SectionRecord record;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, fmt::format("sections.{}.data", torches_section));
        section_fields(fields, record);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    return torches_from(std::move(record), section->parts);
}

std::string write_torches(const PackTorches& torches) {
    JsonWriter fields;
    const SectionRecord section = record_of(torches);
    section_fields(fields, section);
    return nlohmann::json(fields.document()).dump(); // keys in order
}

} // namespace frustumscreen::pack
