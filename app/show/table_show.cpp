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

namespace frustumscreen::show {

namespace {

/// Fraction of the projector's light. A picture's brightest parts equal those of the artifact in the prop.
constexpr double picture_brightness = 1.0;
constexpr double mark_brightness = 0.5;        ///< relative to a caption's
constexpr double empty_ring_brightness = 0.12; ///< fraction of the projector's light
constexpr int mark_px = 256;
constexpr double inner_margin_m = 0.004; ///< between a title and the square around it

/// The profile across a band: its sides are soft over one texel.
image::Image<std::uint8_t> band_picture() {
    constexpr int texels = 16;
    image::Image<std::uint8_t> band(1, texels, 255);
    band.at(0, 0) = band.at(0, texels - 1) = 60;
    return band;
}

/// The largest rectangle of the shape `size` (in any unit) that fits the square, on its lower side.
typography::TableRectangle fitted(const glm::dvec2& size, const typography::TableRectangle& square) {
    typography::TableRectangle picture = square;
    picture.size_m = size * (square.size_m.x / std::max(size.x, size.y));
    const glm::dvec2 down(0.0, 0.5 * (picture.size_m.y - square.size_m.y));
    picture.centre_m += typography::turned(down, square.quarter_turns);
    return picture;
}

} // namespace

struct TableShow::Loader {
    const settings::Settings& settings;
    const Request& request;
    TableShow& show;
    double texels_per_m;
    std::optional<typography::Typesetter> typesetter = {};

    [[nodiscard]] std::size_t add(image::Image<std::uint8_t> coverage) {
        show.planned_gpu_bytes_ += scene::caption_gpu_bytes(coverage.width, coverage.height);
        show.textures_.push_back({std::move(coverage)});
        return show.textures_.size() - 1;
    }

    void add_marks() {
        show.square_ = add(typography::outlined_square(mark_px));
        show.more_ = add(typography::more_mark(mark_px));
        show.band_ = add(band_picture());
    }

    /// The titles to show; the pack's own title if it has no captions.
    [[nodiscard]] std::vector<pack::PackLabel> titles_of(const pack::PackCard& card) const {
        if (card.titles.empty()) {
            return {{"", card.title}};
        }
        if (request.all_languages) {
            return card.titles;
        }
        std::vector<std::string> languages;
        for (const pack::PackLabel& title : card.titles) {
            languages.push_back(title.language);
        }
        return {card.titles[exhibit::caption_for(settings.exhibit.language, languages)]};
    }

    [[nodiscard]] Result<typography::CaptionImage> set_title(const pack::PackLabel& title,
                                                             const std::vector<pack::SetLanguage>& set) {
        for (const pack::SetLanguage& language : set) {
            const pack::GlyphText* const text = language.runs.find("title");
            if (language.language == title.language && text != nullptr) {
                return typography::make_table_title(language.runs, language.atlas, *text, texels_per_m);
            }
        }
        if (!typesetter) {
            TRY(typesetter, typography::Typesetter::open());
        }
        return typography::make_table_title(*typesetter, title.text, texels_per_m);
    }

    /// Loads a pack's card. Parts read before an error stay in the card.
    [[nodiscard]] Result<void> load(const std::filesystem::path& file, Card& card) {
        TRY(pack::PackCard read, pack::load_pack_card(file));
        const image::Image8& picture = read.table_picture;
        if (picture.width > 0 && picture.height > 0) {
            card.picture = {show.textures_.size(), glm::dvec2(picture.width, picture.height)};
            show.planned_gpu_bytes_ += scene::picture_gpu_bytes(picture.width, picture.height);
            show.textures_.push_back({image::light_mips(picture)});
        }
        const std::vector<pack::PackLabel> titles = titles_of(read);
        std::vector<std::string> languages;
        for (const pack::PackLabel& title : titles) {
            languages.push_back(title.language);
        }
        TRY(const std::vector<pack::SetLanguage> set, pack::load_set_texts(file, languages));
        for (const pack::PackLabel& title : titles) {
            TRY(typography::CaptionImage image, set_title(title, set));
            card.languages.push_back(title.language);
            card.titles.push_back({add(std::move(image.coverage)), image.size_m});
        }
        return {};
    }
};

TableShow TableShow::read(const settings::Settings& settings, const Request& request) {
    TableShow show;
    show.picture_outline_m_ = settings::picture_on_table(settings, 0.0);
    show.projector_ = settings.projector.pinhole;
    show.table_from_projector_ = settings.projector.table_from_projector;
    show.text_brightness_ = settings.exhibit.caption_brightness;
    Loader loader{.settings = settings,
                  .request = request,
                  .show = show,
                  .texels_per_m = show.projector_.fx / show.table_from_projector_.translation.z};
    loader.add_marks();
    for (const std::filesystem::path& file : request.packs) {
        if (Result<void> loaded = loader.load(file, show.cards_.emplace_back()); !loaded) {
            show.notes_.push_back("the table shows a square in place of this artifact's picture: " +
                                  loaded.error().message);
        }
    }
    return show;
}

void TableShow::upload(render::GpuStore& store, std::uint64_t max_bytes) {
    std::uint64_t bytes = 0;
    for (; !ready() && bytes < max_bytes; ++uploaded_) {
        Texture& texture = textures_[uploaded_];
        const auto* const coverage = std::get_if<image::Image<std::uint8_t>>(&texture.picture);
        const auto* const light = std::get_if<std::vector<image::Image8>>(&texture.picture);
        bytes += coverage != nullptr ? scene::caption_gpu_bytes(coverage->width, coverage->height)
                                     : scene::picture_gpu_bytes(light->front().width, light->front().height);
        const Result<scene::TextureId> uploaded =
            coverage != nullptr ? store.upload(*coverage) : store.upload_picture(*light);
        texture.id = uploaded.value_or(scene::TextureId::None);
        texture.picture = {};
    }
}

bool TableShow::release_some(render::GpuStore& store) {
    constexpr std::size_t at_once = 16;
    const std::size_t end = std::min(released_ + at_once, uploaded_);
    const bool some = released_ < end;
    for (; released_ < end; ++released_) {
        store.release(std::exchange(textures_[released_].id, scene::TextureId::None));
    }
    return some;
}

void TableShow::place(const exhibit::Presentation& presentation,
                      const std::optional<typography::TablePolygon>& shadow,
                      residency::OnTable& on_table) const {
    if (presentation.table == nullptr) {
        return;
    }
    const exhibit::PresentedTable& table = *presentation.table;
    for (const exhibit::PlacedPicture& placed : table.pictures()) {
        if (placed.artifact && *placed.artifact < cards_.size()) {
            place_card(placed, presentation, on_table);
        } else {
            on_table.add({.corners_m = residency::picture_corners(placed.place.picture),
                          .brightness =
                              mark_brightness * text_brightness_ * presentation.set_share * placed.brightness,
                          .texture = id(placed.artifact ? square_ : more_)});
        }
    }
    if (!table.ring || !shadow) {
        return;
    }
    const int reader = table.pictures()[*table.ring].place.picture.quarter_turns;
    const typography::Ring ring =
        typography::ring_around(*shadow, table.ring_full, reader, picture_outline_m_);
    for (const typography::RingPiece& piece : ring.pieces()) {
        on_table.add({.corners_m = residency::flat_corners(piece.corners_m),
                      .brightness = presentation.set_share * typography::ring_brightness(table.ring_full) *
                                    (piece.filled ? 1.0 : empty_ring_brightness),
                      .texture = id(band_)});
    }
}

/// Artifacts stand on the lower side of their places.
void TableShow::place_placeholder(const exhibit::PresentedPlaceholder& placeholder,
                                  residency::OnTable& on_table) const {
    if (placeholder.artifact >= cards_.size()) {
        return;
    }
    const Picture& picture = cards_[placeholder.artifact].picture;
    if (const scene::TextureId texture = id(picture.texture); texture != scene::TextureId::None) {
        on_table.add({.corners_m = residency::picture_corners(fitted(picture.size, placeholder.rectangle)),
                      .brightness = picture_brightness * placeholder.brightness,
                      .texture = texture,
                      .on_prop = true});
    } else {
        on_table.add({.corners_m = residency::picture_corners(placeholder.rectangle),
                      .brightness = mark_brightness * text_brightness_ * placeholder.brightness,
                      .texture = id(square_),
                      .on_prop = true});
    }
}

void TableShow::place_card(const exhibit::PlacedPicture& placed, const exhibit::Presentation& presentation,
                           residency::OnTable& on_table) const {
    const Card& card = cards_[*placed.artifact];
    const typography::TableRectangle& square = placed.place.picture;
    const double brightness = presentation.set_share * placed.brightness;
    const bool has_picture = id(card.picture.texture) != scene::TextureId::None;
    if (has_picture) {
        on_table.add({.corners_m = residency::picture_corners(fitted(card.picture.size, square)),
                      .brightness = picture_brightness * brightness,
                      .texture = id(card.picture.texture)});
    } else {
        on_table.add({.corners_m = residency::picture_corners(square),
                      .brightness = mark_brightness * text_brightness_ * brightness,
                      .texture = id(square_)});
    }
    if (!card.titles.empty()) {
        place_title(placed, card.titles[exhibit::caption_for(presentation.table_language, card.languages)],
                    !has_picture, text_brightness_ * presentation.title_brightness * brightness, on_table);
    }
}

/// `within`: in the middle of the square, if there is space; otherwise below it.
void TableShow::place_title(const exhibit::PlacedPicture& placed, const Title& title, bool within,
                            double brightness, residency::OnTable& on_table) const {
    const typography::TableRectangle& square = placed.place.picture;
    const typography::TableRectangle& below = placed.place.title;
    typography::TableRectangle rectangle{below.centre_m, title.size_m, below.quarter_turns};
    if (within && title.size_m.x <= square.size_m.x - 2.0 * inner_margin_m) {
        rectangle.centre_m = square.centre_m;
    } else {
        const glm::dvec2 up(0.0, 0.5 * (below.size_m.y - title.size_m.y));
        rectangle.centre_m += typography::turned(up, below.quarter_turns);
    }
    on_table.add({.corners_m = residency::picture_corners(
                      residency::on_pixels(rectangle, projector_, table_from_projector_)),
                  .brightness = brightness,
                  .texture = id(title.texture)});
}

void TableShow::place_samples(const glm::dvec2& at_m, residency::OnTable& on_table) const {
    constexpr double side_m = 0.05;
    for (const Card& card : cards_) {
        if (const scene::TextureId picture = id(card.picture.texture); picture != scene::TextureId::None) {
            on_table.add({.corners_m = residency::picture_corners({at_m, glm::dvec2(side_m)}),
                          .brightness = 1.0,
                          .texture = picture});
            if (!card.titles.empty() && id(card.titles.front().texture) != scene::TextureId::None) {
                on_table.add({.corners_m = residency::picture_corners({at_m, glm::dvec2(side_m)}),
                              .brightness = 1.0,
                              .texture = id(card.titles.front().texture)});
            }
            break;
        }
    }
    if (id(more_) != scene::TextureId::None) {
        on_table.add({.corners_m = residency::picture_corners({at_m, glm::dvec2(side_m)}),
                      .brightness = 1.0,
                      .texture = id(more_)});
    }
}

} // namespace frustumscreen::show
