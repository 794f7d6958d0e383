// The data of the section torches, and on a second line how many parts it has: refused in one line, or every stage shows
// something that is there, within its limits, and written again it reads equal. The rest after that line is the
// colours of a layer.
#include "app/pack/colours_part.h"
#include "app/pack/torch_sections.h"
#include "tests/fuzz/fuzz.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

using namespace frustumscreen;

namespace {

pack::PackDescription with_section(std::string data, std::size_t parts) {
    pack::PackDescription pack;
    pack.sections = {{std::string(pack::torches_section), std::move(data), {}}};
    for (std::size_t k = 0; k < parts; ++k) {
        pack.sections.back().parts.push_back(fmt::format("p/{}", k));
    }
    return pack;
}

Result<pack::PackTorches> checked(const pack::PackDescription& pack) {
    TRY(pack::PackTorches torches, pack::read_torch_section(pack));
    TRY_VOID(pack::check_torch_fields(torches));
    return torches;
}

void require_usable(const pack::PackTorches& torches) {
    for (const pack::PackTorchContent& packed : torches.contents) {
        fuzz::require(!packed.content.stages.empty() && packed.content.stages.size() <= torch::max_stages,
                      "a content has one to three stages");
        for (const torch::Stage& stage : packed.content.stages) {
            const std::size_t there = stage.source == torch::Source::Picture ? torches.pictures.size()
                                      : stage.source == torch::Source::Film  ? torches.films.size()
                                      : stage.source == torch::Source::Layer ? torches.layers.size()
                                                                             : 1;
            fuzz::require(stage.item < there, "what a stage shows is there");
            const torch::StageAt at = torch::stage_at(stage, packed.content.height_per_width, 3600.0);
            fuzz::require(at.opacity >= 0.0F && at.opacity <= 1.0F, "a stage is not more than opaque");
            fuzz::require(std::isfinite(at.stage_from_content[2].x), "a stage has a place");
        }
    }
    for (const pack::PackFilm& film : torches.films) {
        fuzz::require(film.parts.size() == film.frames && film.frames <= pack::max_film_frames,
                      "a film has a part for each frame");
    }
}

void check_colours(std::string_view text) {
    constexpr std::size_t corners = 2 * 81;
    const auto colours = pack::decode_colours(as_bytes(text), corners);
    if (!colours) {
        fuzz::require_one_line(colours.error().message);
        return;
    }
    const Bytes again = pack::encode_colours(*colours);
    fuzz::require(as_text(again) == text, "colours written again are the same");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(std::min(end + 1, text.size()));
    const std::size_t second = std::min(rest.find('\n'), rest.size());
    std::size_t parts = 0;
    std::from_chars(rest.data(), rest.data() + std::min<std::size_t>(second, 4), parts);
    check_colours(rest.substr(std::min(second + 1, rest.size())));
    const auto torches = checked(with_section(std::string(text.substr(0, end)), parts));
    if (!torches) {
        fuzz::require_one_line(torches.error().message);
        return 0;
    }
    require_usable(*torches);
    const auto again = checked(with_section(pack::write_torches(*torches), parts));
    fuzz::require(again.has_value(), "what was written is read",
                  again ? std::string() : again.error().message);
    fuzz::require(*again == *torches, "torches written again are the same");
    return 0;
}
