#include "assets_baked/folder/artifact_torches.h"

#include "app/pack/pack_text.h"
#include "app/pack/torch_limits.h"
#include "assets_baked/folder/artifact_labels.h"
#include "assets_baked/folder/artifact_path.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>

namespace frustumscreen::folder {

namespace {

using torch::Source;
namespace limits = pack::torch_limits;

constexpr std::array<std::string_view, 4> showing{"picture", "film", "layer", "effect"};
/// Words of `effect`, and what they are; the others of torch::Source have a key of their own.
constexpr std::array<std::string_view, 5> effect_words{"plain", "ring", "grid", "ruler", "lens"};
constexpr std::array effects{Source::Plain, Source::Ring, Source::Grid, Source::Ruler, Source::Lens};
/// Keys that stand directly in [[torch]] in place of [[torch.stage]].
constexpr std::array<std::string_view, 15> stage_keys{
    "picture", "film", "layer", "effect",        "rate_hz",  "lit",          "mix",           "colour",
    "opacity", "size", "width", "magnification", "pulse_hz", "scroll_per_s", "turn_deg_per_s"};

struct Kinds {
    std::string_view key;
    std::initializer_list<Source> sources; ///< that use the key
};
constexpr double shares = limits::max_size;

/// Refuses a key that the stage's source does not use, so that nobody wonders why it changes nothing.
void check_used(settings::TableReader& table, Source source) {
    using enum Source;
    const std::array<Kinds, 6> kinds{{{"rate_hz", {Film}},
                                      {"lit", {Layer}},
                                      {"size", {Ring, Grid, Ruler, Lens}},
                                      {"width", {Ring, Grid, Ruler}},
                                      {"magnification", {Lens}},
                                      {"scroll_per_s", {Picture, Film, Ring, Grid, Ruler}}}};
    for (const Kinds& each : kinds) {
        const bool used = std::find(each.sources.begin(), each.sources.end(), source) != each.sources.end();
        table.require("torch_file.unused_key", used || !table.has(each.key), each.key,
                      fmt::format("has no effect on a {}; take it away",
                                  torch::source_names.at(static_cast<std::size_t>(source))));
    }
}

/// The source of the stage: exactly one of four keys.
void read_source(settings::TableReader& table, ArtifactTorchStage& stage) {
    const auto count =
        std::count_if(showing.begin(), showing.end(), [&](std::string_view key) { return table.has(key); });
    std::size_t effect = 0;
    table.choice("effect", effect, effect_words, {});
    for (const auto& [key, source] :
         {std::pair("picture", Source::Picture), {"film", Source::Film}, {"layer", Source::Layer}}) {
        if (table.has(key)) {
            read_path(table, key, stage.file);
            table.require("torch_file.no_file", !stage.file.empty(), key,
                          "is empty; name a file in this folder");
            stage.look.source = source;
            stage.place = table.place(key);
        } else {
            std::filesystem::path none;
            read_path(table, key, none); // so that the key is known
        }
    }
    if (table.has("effect")) {
        stage.look.source = effects.at(effect);
        stage.place = table.place("effect");
    }
    table.require("torch_file.source", count == 1, "effect",
                  count == 0 ? "is missing; write picture, film, layer or effect: what the torch shows"
                             : "is not alone; allowed is one of picture, film, layer and effect: write the "
                               "others as a [[torch.stage]] each");
}

void read_stage(settings::TableReader& table, ArtifactTorchStage& stage) {
    torch::Stage& look = stage.look;
    double rate_hz = 25.0;
    table.number("rate_hz", rate_hz, {limits::min_rate_hz, limits::max_rate_hz, "frames a second"});
    if (table.has("rate_hz")) {
        stage.rate_hz = rate_hz;
    }
    table.flag("lit", stage.lit, {});
    table.choice("mix", look.mix, torch::mix_names, {});
    glm::dvec3 colour(look.colour);
    table.vector("colour", colour, {0.0, limits::colour, "linear light"});
    look.colour = glm::vec3(colour);
    table.number("opacity", look.opacity, {0.0, 1.0, ""});
    table.number("size", look.size, {limits::min_size, shares, "widths of the content"});
    table.number("width", look.width, {limits::min_width, limits::max_width, "widths of the content"});
    table.number("magnification", look.magnification, {1.0, limits::magnification, "times"});
    table.pair("scroll_per_s", look.scroll_per_s,
               {-limits::scroll_per_s, limits::scroll_per_s, "widths and heights a second"});
    double turn_deg_per_s = 0.0;
    const double fastest = glm::degrees(limits::turn_rad_per_s);
    table.number("turn_deg_per_s", turn_deg_per_s, {-fastest, fastest, "degrees a second"});
    look.turn_rad_per_s = glm::radians(turn_deg_per_s);
    table.number("pulse_hz", look.pulse_hz, {0.0, limits::pulse_hz, "Hz, so that it cannot cause a seizure"});
    table.number("pulse_depth", look.pulse_depth, {0.0, 1.0, ""});
}

void read_whole_stage(settings::TableReader& table, ArtifactTorchStage& stage) {
    read_stage(table, stage);
    read_source(table, stage);
    table.finish(); // a misspelt key is reported before one that is missing
    check_used(table, stage.look.source);
}

void read_name(settings::TableReader& table, ArtifactTorch& content,
               const std::vector<ArtifactTorch>& before) {
    table.any_text("name", content.name);
    if (const std::optional<std::string> fault = pack::fault_of_text(content.name, pack::TextShape::Line)) {
        table.refuse("torch_file.name", "name", *fault);
    }
    content.name = std::string(trimmed(content.name));
    content.place = table.place("name");
    table.require("torch_file.no_name", !content.name.empty() && content.name != torch::white_name, "name",
                  fmt::format("is missing, empty or \"{}\", which every artifact has; every [[torch]] has a "
                              "name of its own",
                              torch::white_name));
    const bool is_second = std::any_of(before.begin(), before.end(), [&](const ArtifactTorch& each) {
        return &each != &content && each.name == content.name;
    });
    table.require(
        "torch_file.name_twice", !is_second, "name",
        fmt::format("is \"{}\" a second time; allowed is each name once", printable(content.name, 40)));
}

/// A layer or a lens shows the surface otherwise; all else is light on it.
torch::Blend usual_blend(const std::vector<ArtifactTorchStage>& stages) {
    const bool shows_surface = std::any_of(stages.begin(), stages.end(), [](const ArtifactTorchStage& each) {
        return each.look.source == Source::Layer || each.look.source == Source::Lens;
    });
    return shows_surface ? torch::Blend::Over : torch::Blend::Light;
}

void check_stages(settings::TableReader& table, const std::vector<ArtifactTorchStage>& stages) {
    std::vector<torch::Stage> looks;
    for (const ArtifactTorchStage& stage : stages) {
        looks.push_back(stage.look);
    }
    if (const std::optional<std::string> fault = limits::fault_of_stages(looks)) {
        table.refuse("torch_file.stages", "name", *fault);
    }
}

} // namespace

void read_layer(settings::TableReader& table, ArtifactTorchStage& stage) {
    read_path(table, "layer", stage.file);
    table.require("torch_file.no_layer", !stage.file.empty(), "layer",
                  "is empty; name a file in this folder");
    stage.look.source = Source::Layer;
    stage.place = table.place("layer");
}

void read_torch(settings::TableReader& table, ArtifactTorch& content,
                const std::vector<ArtifactTorch>& before) {
    const bool is_short = std::any_of(stage_keys.begin(), stage_keys.end(),
                                      [&](std::string_view key) { return table.has(key); });
    const bool is_long = table.has("stage");
    table.tables("stage", content.stages, torch::max_stages, read_whole_stage, {});
    if (!is_long) {
        ArtifactTorchStage stage;
        read_stage(table, stage);
        read_source(table, stage);
        content.stages = {std::move(stage)};
    }
    table.require("torch_file.both_forms", !(is_short && is_long), "stage",
                  "stands beside picture, film, layer, effect or what belongs to them; write all of them in "
                  "[[torch.stage]], once for each");
    std::size_t shape = 0;
    table.choice("shape", shape, torch::shape_names, {});
    if (table.has("shape")) {
        content.shape = static_cast<torch::Shape>(shape);
    }
    content.blend = usual_blend(content.stages);
    table.choice("blend", content.blend, torch::blend_names, {});
    double height = 1.0;
    table.number("height_per_width", height,
                 {limits::min_height_per_width, limits::max_height_per_width, "widths"});
    if (table.has("height_per_width")) {
        content.height_per_width = height;
    }
    read_labels(table, "titles", content.titles);
    read_name(table, content, before);
    table.finish(); // as for a stage
    if (!is_long) {
        check_used(table, content.stages.front().look.source);
    }
    check_stages(table, content.stages);
}

} // namespace frustumscreen::folder
