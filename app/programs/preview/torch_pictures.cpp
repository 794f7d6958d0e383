#include "app/programs/preview/torch_pictures.h"

#include "app/pack/pack_file.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace frustumscreen::programs {

namespace {

using torch::Source;

constexpr int frames = 4;

/// The stage that shows a layer.
const torch::Stage* layer_in(const torch::Content& content) {
    const auto found = std::find_if(content.stages.begin(), content.stages.end(),
                                    [](const torch::Stage& stage) { return stage.source == Source::Layer; });
    return found != content.stages.end() ? &*found : nullptr;
}

std::string words_of(const pack::PackTorches& torches, const torch::Content& content) {
    std::vector<std::string> words;
    for (const torch::Stage& stage : content.stages) {
        const std::string source(torch::source_names.at(static_cast<std::size_t>(stage.source)));
        if (stage.source == Source::Layer) {
            words.push_back("the layer " + torches.layers[stage.item].name);
        } else if (stage.source == Source::Film) {
            const pack::PackFilm& film = torches.films[stage.item];
            words.push_back(fmt::format("a film of {} frames, {:.3g} a second", film.frames, film.rate_hz));
        } else {
            words.push_back(stage.source == Source::Plain ? "plain light" : "a " + source);
        }
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

/// A file that is removed again.
class PassingFile {
public:
    explicit PassingFile(std::filesystem::path path) : path_(std::move(path)) {}
    ~PassingFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    PassingFile(const PassingFile&) = delete;
    PassingFile& operator=(const PassingFile&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// The turn of a pack whose textures are under the layer.
Result<image::Image8> lit_sheet(const std::filesystem::path& pack_file, const pack::Pack& pack,
                                const pack::PackTorches& torches, const torch::Content& content,
                                const torch::Stage& stage, const TurnOptions& options) {
    pack::Pack altered = pack;
    altered.sections.clear();
    altered.section_parts.clear();
    for (std::size_t k = 0; k < altered.textures.size(); ++k) {
        TRY(const image::Image8 layer, pack::layer_texture_of(pack, torches.layers[stage.item], k));
        altered.textures[k] = with_layer(pack.textures[k], layer, stage, content.blend);
    }
    TRY(const Bytes bytes, pack::write_pack(altered));
    const PassingFile file(pack_file.string() + ".torch");
    TRY_VOID(write_file(file.path(), bytes));
    TRY(TurnPictures turn, turn_pictures(file.path(), options));
    return std::move(turn.sheet);
}

Result<image::Image8> picture_in(const pack::Pack& pack, const std::filesystem::path& pack_file,
                                 const pack::PackTorches& torches, const torch::Content& content) {
    for (const torch::Stage& stage : content.stages) {
        if (stage.source == Source::Picture) {
            return pack::load_torch_picture(pack_file, torches.pictures[stage.item]);
        }
        if (stage.source == Source::Film) {
            const pack::PackFilm& film = torches.films[stage.item];
            return pack::film_frame_of(film, pack.section_parts.at(film.parts.front()));
        }
    }
    return image::Image8();
}

} // namespace

image::Image8 with_layer(const image::Image8& texture, const image::Image8& layer, const torch::Stage& stage,
                         torch::Blend blend) {
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    image::Image8 made = texture;
    for (std::size_t k = 0; k < made.texels.size(); ++k) {
        const glm::u8vec4& own = texture.texels[k];
        const glm::u8vec4& shown = layer.texels[k];
        const double share = stage.opacity * shown.w / 255.0;
        for (int c = 0; c < 3; ++c) {
            const double base = static_cast<double>(linear[own[c]]);
            const double light = static_cast<double>(linear[shown[c]] * stage.colour[c]);
            const double out =
                blend == torch::Blend::Over ? base + share * (light - base) : base + base * share * light;
            made.texels[k][c] = image::srgb8_from_linear(out);
        }
    }
    return made;
}

Result<std::vector<TorchPictures>> torch_pictures(const std::filesystem::path& pack_file,
                                                  const pack::Pack& pack, const TurnOptions& options) {
    TRY(const pack::PackTorches torches, pack::torches_of(pack));
    TurnOptions smaller = options;
    smaller.columns = frames;
    smaller.rows = 1;
    smaller.size = options.size / 2;
    std::vector<TorchPictures> all;
    for (const pack::PackTorchContent& packed : torches.contents) {
        TorchPictures pictures;
        pictures.content = packed;
        pictures.shows = words_of(torches, packed.content);
        TRY(pictures.picture, picture_in(pack, pack_file, torches, packed.content));
        pictures.frames = frames;
        pictures.size = smaller.size;
        if (all.empty()) {
            TRY(TurnPictures turn, turn_pictures(pack_file, smaller));
            pictures.plain = std::move(turn.sheet);
        }
        if (const torch::Stage* const stage = layer_in(packed.content)) {
            TRY(pictures.lit, lit_sheet(pack_file, pack, torches, packed.content, *stage, smaller));
        }
        all.push_back(std::move(pictures));
    }
    return all;
}

} // namespace frustumscreen::programs
