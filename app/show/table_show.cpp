#include "app/show/table_show.h"

#include "app/exhibit/languages.h"
#include "app/image/light_mips.h"
#include "app/pack/pack_sections.h"
#include "app/pack/pack_texts.h"
#include "app/scene/scene_level.h"
#include "app/settings/lit_zone.h"
#include "app/typography/ring.h"
#include "app/typography/table_title.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

namespace {

/// Fraction of the projector's light. A picture's brightest parts equal those of the artifact in the prop.
constexpr double picture_brightness = 1.0;
constexpr double mark_brightness = 0.5;        ///< relative to a caption's
constexpr double empty_ring_brightness = 0.12; ///< fraction of the projector's light
constexpr int mark_px = 256;
constexpr double inner_margin_m = 0.004; ///< between a title and the square around it

/// The profile across a band: its sides are soft over one texel.
Image<std::uint8_t> band_picture() {
    constexpr int texels = 16;
    Image<std::uint8_t> band(1, texels, 255);
    band.at(0, 0) = band.at(0, texels - 1) = 60;
    return band;
}

/// The largest rectangle of the shape `size` (in any unit) that fits the square, on its lower side.
TableRectangle fitted(const glm::dvec2& size, const TableRectangle& square) {
    TableRectangle picture = square;
    picture.size_m = size * (square.size_m.x / std::max(size.x, size.y));
    const glm::dvec2 down(0.0, 0.5 * (picture.size_m.y - square.size_m.y));
    picture.centre_m += turned(down, square.quarter_turns);
    return picture;
}

} // namespace

struct TableShow::Loader {
    const Settings& settings;
    const Request& request;
    TableShow& show;
    double texels_per_m;
    std::optional<Typesetter> typesetter = {};

    [[nodiscard]] std::size_t add(Image<std::uint8_t> coverage) {
        show.planned_gpu_bytes_ += caption_gpu_bytes(coverage.width, coverage.height);
        show.textures_.push_back({std::move(coverage)});
        return show.textures_.size() - 1;
    }

    void add_marks() {
        show.square_ = add(outlined_square(mark_px));
        show.more_ = add(more_mark(mark_px));
        show.band_ = add(band_picture());
    }

    /// The titles to show; the pack's own title if it has no captions.
    [[nodiscard]] std::vector<PackLabel> titles_of(const PackCard& card) const {
        if (card.titles.empty()) {
            return {{"", card.title}};
        }
        if (request.all_languages) {
            return card.titles;
        }
        std::vector<std::string> languages;
        for (const PackLabel& title : card.titles) {
            languages.push_back(title.language);
        }
        return {card.titles[caption_for(settings.exhibit.language, languages)]};
    }

    [[nodiscard]] Result<CaptionImage> set_title(const PackLabel& title,
                                                 const std::vector<SetLanguage>& set) {
        for (const SetLanguage& language : set) {
            const GlyphText* const text = language.runs.find("title");
            if (language.language == title.language && text != nullptr) {
                return make_table_title(language.runs, language.atlas, *text, texels_per_m);
            }
        }
        if (!typesetter) {
            TRY(typesetter, Typesetter::open());
        }
        return make_table_title(*typesetter, title.text, texels_per_m);
    }

    /// Loads a pack's card. Whatever was read before an error stays in the card.
    [[nodiscard]] Result<void> load(const std::filesystem::path& file, Card& card) {
        TRY(PackCard read, load_pack_card(file));
        const Image8& picture = read.table_picture;
        if (picture.width > 0 && picture.height > 0) {
            card.picture = {show.textures_.size(), glm::dvec2(picture.width, picture.height)};
            show.planned_gpu_bytes_ += picture_gpu_bytes(picture.width, picture.height);
            show.textures_.push_back({light_mips(picture)});
        }
        const std::vector<PackLabel> titles = titles_of(read);
        std::vector<std::string> languages;
        for (const PackLabel& title : titles) {
            languages.push_back(title.language);
        }
        TRY(const std::vector<SetLanguage> set, load_set_texts(file, languages));
        for (const PackLabel& title : titles) {
            TRY(CaptionImage image, set_title(title, set));
            card.languages.push_back(title.language);
            card.titles.push_back({add(std::move(image.coverage)), image.size_m});
        }
        return {};
    }
};

TableShow TableShow::read(const Settings& settings, const Request& request) {
    TableShow show;
    show.room_ = picture_on_table(settings, 0.0);
    show.projector_ = settings.projector.pinhole;
    show.table_from_projector_ = settings.projector.table_from_projector;
    show.text_brightness_ = settings.exhibit.caption_brightness;
    Loader loader{settings, request, show, show.projector_.fx / show.table_from_projector_.translation.z};
    loader.add_marks();
    for (const std::filesystem::path& file : request.packs) {
        if (Result<void> loaded = loader.load(file, show.cards_.emplace_back()); !loaded) {
            show.notes_.push_back("on the table a square lies for this artifact: " + loaded.error().message);
        }
    }
    return show;
}

void TableShow::upload(GpuStore& store, std::uint64_t max_bytes) {
    std::uint64_t bytes = 0;
    for (; !ready() && bytes < max_bytes; ++uploaded_) {
        Texture& texture = textures_[uploaded_];
        const auto* const coverage = std::get_if<Image<std::uint8_t>>(&texture.picture);
        const auto* const light = std::get_if<std::vector<Image8>>(&texture.picture);
        bytes += coverage != nullptr ? caption_gpu_bytes(coverage->width, coverage->height)
                                     : picture_gpu_bytes(light->front().width, light->front().height);
        const Result<TextureId> uploaded =
            coverage != nullptr ? store.upload(*coverage) : store.upload_picture(*light);
        texture.id = uploaded.value_or(TextureId::None);
        texture.picture = {};
    }
}

bool TableShow::release_some(GpuStore& store) {
    constexpr std::size_t at_once = 16;
    const std::size_t end = std::min(released_ + at_once, uploaded_);
    const bool some = released_ < end;
    for (; released_ < end; ++released_) {
        store.release(std::exchange(textures_[released_].id, TextureId::None));
    }
    return some;
}

void TableShow::place(const Presentation& presentation, const std::optional<TablePolygon>& shadow,
                      OnTable& on_table) const {
    if (presentation.table == nullptr) {
        return;
    }
    const PresentedTable& table = *presentation.table;
    for (const PlacedPicture& placed : table.pictures()) {
        if (placed.artifact && *placed.artifact < cards_.size()) {
            place_card(placed, presentation, on_table);
        } else {
            on_table.add({picture_corners(placed.place.picture),
                          mark_brightness * text_brightness_ * presentation.set_share * placed.brightness,
                          id(placed.artifact ? square_ : more_)});
        }
    }
    if (!table.ring || !shadow) {
        return;
    }
    const int reader = table.pictures()[*table.ring].place.picture.quarter_turns;
    const Ring ring = ring_around(*shadow, table.ring_full, reader, room_);
    for (const RingPiece& piece : ring.pieces()) {
        on_table.add({flat_corners(piece.corners_m),
                      presentation.set_share * ring_brightness(table.ring_full) *
                          (piece.filled ? 1.0 : empty_ring_brightness),
                      id(band_)});
    }
}

/// Artifacts stand on the lower side of their places.
void TableShow::place_placeholder(const PresentedPlaceholder& placeholder, OnTable& on_table) const {
    if (placeholder.artifact >= cards_.size()) {
        return;
    }
    const Picture& picture = cards_[placeholder.artifact].picture;
    if (const TextureId texture = id(picture.texture); texture != TextureId::None) {
        on_table.add({picture_corners(fitted(picture.size, placeholder.rectangle)),
                      picture_brightness * placeholder.brightness, texture, true});
    } else {
        on_table.add({picture_corners(placeholder.rectangle),
                      mark_brightness * text_brightness_ * placeholder.brightness, id(square_), true});
    }
}

void TableShow::place_card(const PlacedPicture& placed, const Presentation& presentation,
                           OnTable& on_table) const {
    const Card& card = cards_[*placed.artifact];
    const TableRectangle& square = placed.place.picture;
    const double brightness = presentation.set_share * placed.brightness;
    const bool has_picture = id(card.picture.texture) != TextureId::None;
    if (has_picture) {
        on_table.add({picture_corners(fitted(card.picture.size, square)), picture_brightness * brightness,
                      id(card.picture.texture)});
    } else {
        on_table.add({picture_corners(square), mark_brightness * text_brightness_ * brightness, id(square_)});
    }
    if (!card.titles.empty()) {
        place_title(placed, card.titles[caption_for(presentation.table_language, card.languages)],
                    !has_picture, text_brightness_ * presentation.title_brightness * brightness, on_table);
    }
}

/// `within`: in the middle of the square, if there is room; otherwise below it.
void TableShow::place_title(const PlacedPicture& placed, const Title& title, bool within, double brightness,
                            OnTable& on_table) const {
    const TableRectangle& square = placed.place.picture;
    const TableRectangle& below = placed.place.title;
    TableRectangle rectangle{below.centre_m, title.size_m, below.quarter_turns};
    if (within && title.size_m.x <= square.size_m.x - 2.0 * inner_margin_m) {
        rectangle.centre_m = square.centre_m;
    } else {
        const glm::dvec2 up(0.0, 0.5 * (below.size_m.y - title.size_m.y));
        rectangle.centre_m += turned(up, below.quarter_turns);
    }
    on_table.add({picture_corners(on_pixels(rectangle, projector_, table_from_projector_)), brightness,
                  id(title.texture)});
}

void TableShow::place_samples(const glm::dvec2& at_m, OnTable& on_table) const {
    constexpr double side_m = 0.05;
    for (const Card& card : cards_) {
        if (const TextureId picture = id(card.picture.texture); picture != TextureId::None) {
            on_table.add({picture_corners({at_m, glm::dvec2(side_m)}), 1.0, picture});
            if (!card.titles.empty() && id(card.titles.front().texture) != TextureId::None) {
                on_table.add(
                    {picture_corners({at_m, glm::dvec2(side_m)}), 1.0, id(card.titles.front().texture)});
            }
            break;
        }
    }
    if (id(more_) != TextureId::None) {
        on_table.add({picture_corners({at_m, glm::dvec2(side_m)}), 1.0, id(more_)});
    }
}

} // namespace frustumscreen
