#include "app/programs/bake/torch_contents.h"

#include "app/image/film_frame.h"
#include "app/programs/bake/torch_layers.h"
#include "assets_baked/bake/loaders/decode_image.h"
#include "assets_baked/bake/loaders/film_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/parallel.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace frustumscreen::programs {

namespace {

using folder::ArtifactTorch;
using folder::ArtifactTorchStage;
using torch::Source;

constexpr std::uintmax_t max_picture_bytes = std::uintmax_t{64} << 20;
constexpr float frame_quality = 80.0F;
constexpr bake::FilmLimits film_limits{.min_side = pack::min_torch_picture_px,
                                       .max_side = pack::max_film_px,
                                       .max_frames = pack::max_film_frames};

/// The size of the curator's files, with its unit.
std::string in_units(const std::vector<std::filesystem::path>& files) {
    std::uint64_t bytes = 0;
    for (const std::filesystem::path& file : files) {
        std::error_code unknown;
        const std::uintmax_t its = std::filesystem::file_size(file, unknown);
        bytes += unknown ? 0 : its;
    }
    return bytes < 1'000'000 ? fmt::format("{} kB", (bytes + 999) / 1000)
                             : fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

std::string name_of(const std::filesystem::path& file) {
    return printable(file.filename().string(), 100);
}

class Reader {
public:
    Reader(const BakeRequest& request, const bake::SourceMesh& mesh, Contents contents)
        : request_(request), mesh_(mesh), contents_(contents) {}

    Result<TorchContents> read() {
        for (const ArtifactTorch& written : request_.torches) {
            TRY_VOID(add(written));
        }
        for (const bake::SourceLayer& layer : mesh_.layers) {
            made_.torches.layers.push_back({.name = layer.name});
        }
        return std::move(made_);
    }

private:
    Result<void> add(const ArtifactTorch& written) {
        pack::PackTorchContent packed;
        packed.content.name = written.name;
        packed.content.blend = written.blend;
        packed.content.shape = written.shape;
        packed.content.height_per_width = written.height_per_width.value_or(1.0);
        packed.titles = written.titles;
        std::vector<std::string> shows;
        for (const ArtifactTorchStage& stage : written.stages) {
            torch::Stage look = stage.look;
            if (look.source == Source::Picture || look.source == Source::Film) {
                TRY(const glm::ivec2 size,
                    look.source == Source::Picture ? picture(stage, look, shows) : film(stage, look, shows));
                follow(size, written, packed.content);
            } else if (look.source == Source::Layer) {
                look.item = static_cast<std::uint32_t>(layer_of(request_, stage));
                shows.push_back(
                    fmt::format("layer {}, {}", mesh_.layers.at(look.item).name, in_units({stage.file})));
            } else {
                shows.emplace_back(torch::source_names.at(static_cast<std::size_t>(look.source)));
            }
            packed.content.stages.push_back(look);
        }
        made_.told.push_back(fmt::format("'{}': {}; {}", printable(written.name, 60), fmt::join(shows, ", "),
                                         torch::blend_names.at(static_cast<std::size_t>(written.blend))));
        made_.torches.contents.push_back(std::move(packed));
        return {};
    }

    /// The beam has the picture's shape, where the file does not say another.
    static void follow(const glm::ivec2& size, const ArtifactTorch& written, torch::Content& content) {
        if (!written.shape) {
            content.shape = torch::Shape::Rectangle;
        }
        if (!written.height_per_width) {
            content.height_per_width = std::clamp(static_cast<double>(size.y) / size.x, 0.05, 20.0);
        }
    }

    Result<glm::ivec2> picture(const ArtifactTorchStage& stage, torch::Stage& look,
                               std::vector<std::string>& shows) {
        const auto known = std::find(picture_files_.begin(), picture_files_.end(), stage.file);
        look.item = static_cast<std::uint32_t>(known - picture_files_.begin());
        if (known == picture_files_.end()) {
            TRY_VOID(at(stage.place, add_picture(stage.file)));
        }
        const pack::PackTorchPicture& picture = made_.torches.pictures[look.item];
        shows.push_back(fmt::format("picture {}, {} x {} pixels, {}", name_of(stage.file), picture.width,
                                    picture.height, in_units({stage.file})));
        return glm::ivec2(picture.width, picture.height);
    }

    Result<void> add_picture(const std::filesystem::path& file) {
        constexpr int side = pack::max_torch_picture_px;
        TRY(const Bytes bytes, read_file(file, max_picture_bytes));
        TRY(const image::Image8 picture,
            at(file.string(), bake::decode_image(bytes, std::int64_t{side} * side)));
        if (std::min(picture.width, picture.height) < pack::min_torch_picture_px ||
            std::max(picture.width, picture.height) > side) {
            return bad_input("torch_contents.picture_size",
                             "{}: it has {} x {} pixels; allowed are {} to {} a side", file.string(),
                             picture.width, picture.height, pack::min_torch_picture_px, side);
        }
        picture_files_.push_back(file);
        made_.torches.pictures.push_back({.width = picture.width, .height = picture.height});
        if (contents_ == Contents::Read) {
            made_.parts.pictures.push_back(packed(picture));
        }
        return {};
    }

    /// Lossless compression keeps labels and drawings small; in a photograph the loss is not visible.
    static Bytes packed(const image::Image8& picture) {
        constexpr std::size_t enough_bytes = 1U << 20;
        constexpr float quality = 90.0F;
        Bytes exact = image::encode_webp(picture);
        return exact.size() <= enough_bytes ? std::move(exact) : image::encode_film_frame(picture, quality);
    }

    Result<glm::ivec2> film(const ArtifactTorchStage& stage, torch::Stage& look,
                            std::vector<std::string>& shows) {
        const auto known = std::find(film_files_.begin(), film_files_.end(), stage.file);
        look.item = static_cast<std::uint32_t>(known - film_files_.begin());
        if (known == film_files_.end()) {
            TRY_VOID(at(stage.place, add_film(stage)));
        }
        const pack::PackFilm& film = made_.torches.films[look.item];
        shows.push_back(fmt::format("film {}, {} frames of {} x {} pixels, {:.3g} a second, {}",
                                    name_of(stage.file), film.frames, film.width, film.height, film.rate_hz,
                                    in_units(bake::files_of_film(stage.file))));
        return glm::ivec2(film.width, film.height);
    }

    Result<void> add_film(const ArtifactTorchStage& stage) {
        if (film_files_.size() == pack::max_films) {
            return bad_input("torch_contents.films", "{}: the torch has more than {} films; take one away",
                             stage.file.string(), pack::max_films);
        }
        TRY(const bake::FilmOutline outline, bake::outline_of_film(stage.file, film_limits));
        film_files_.push_back(stage.file);
        const double usual_hz = outline.rate_hz.value_or(25.0);
        made_.torches.films.push_back({.width = outline.width,
                                       .height = outline.height,
                                       .frames = outline.frames,
                                       .rate_hz = std::clamp(stage.rate_hz.value_or(usual_hz), 0.1, 60.0)});
        if (!outline.is_even && !stage.rate_hz) {
            made_.notes.push_back({bake::SourceNote::Kind::Guessed,
                                   fmt::format("the frames of {} are shown for different times: the film has "
                                               "{:.3g} a second; rate_hz says another",
                                               name_of(stage.file), made_.torches.films.back().rate_hz)});
        }
        return contents_ == Contents::Read ? add_frames(stage.file) : Result<void>();
    }

    /// Frames are encoded some at a time, so that not all of them lie in memory.
    Result<void> add_frames(const std::filesystem::path& film) {
        constexpr std::size_t together = 16;
        std::vector<Bytes>& packed = made_.parts.films.emplace_back();
        std::vector<image::Image8> waiting;
        const auto encode = [&] {
            const std::size_t first = packed.size();
            packed.resize(first + waiting.size());
            parallel_for(waiting.size(), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k) {
                    packed[first + k] = image::encode_film_frame(waiting[k], frame_quality);
                }
            });
            waiting.clear();
        };
        TRY_VOID(bake::read_film(film, film_limits, [&](image::Image8 frame) {
            waiting.push_back(std::move(frame));
            if (waiting.size() == together) {
                encode();
            }
        }));
        encode();
        return {};
    }

    const BakeRequest& request_;
    const bake::SourceMesh& mesh_;
    Contents contents_;
    TorchContents made_;
    std::vector<std::filesystem::path> picture_files_, film_files_;
};

} // namespace

Result<TorchContents> contents_of(const BakeRequest& request, const bake::SourceMesh& mesh,
                                  Contents contents) {
    return Reader(request, mesh, contents).read();
}

} // namespace frustumscreen::programs
