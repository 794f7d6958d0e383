// Places all that lies on the table beside the artifact: captions, titles, signs, a site's map, the zone's frame.
#include "app/exhibit/site_places.h"
#include "app/scene/beyond_prop.h"
#include "app/show/artifact_show.h"

#include <utility>

namespace frustumscreen::show {

std::optional<scene::TablePicture>
ArtifactShow::place_advice(const exhibit::Presentation& presentation) const {
    if (!presentation.advice) {
        return std::nullopt;
    }
    const exhibit::PresentedAdvice& advice = *presentation.advice;
    return scene::TablePicture{.corners_m = residency::picture_corners(
                                   residency::on_pixels(advice.rectangle, projector_, table_from_projector_)),
                               .brightness = caption_brightness_ * advice.brightness,
                               .texture = set_->word(advice.word, advice.shape)};
}

void ArtifactShow::place_zone_frame(const exhibit::Presentation& presentation) {
    if (white_ == scene::TextureId::None) {
        return;
    }
    const double brightness = exhibit::zone_brightness * caption_brightness_ * presentation.zone_share;
    for (const typography::TableRectangle& side : presentation.zone_sides) {
        on_table_.add(
            {.corners_m = residency::picture_corners(side), .brightness = brightness, .texture = white_});
    }
}

void ArtifactShow::place_hotspot(const exhibit::Presentation& presentation) {
    if (!presentation.hotspot) {
        return;
    }
    const exhibit::PresentedHotspot& hotspot = *presentation.hotspot;
    const exhibit::CatalogueEntry& entry = catalogue()[hotspot.artifact];
    const residency::LoadedTexts* const texts =
        set_->artifact_cache->texts(hotspot.artifact, residency::TextPart::Narration, hotspot.language);
    if (texts != nullptr) {
        hotspots_.place(hotspot,
                        texts->texture(residency::label_picture(entry, hotspot.language, hotspot.hotspot)),
                        caption_brightness_, projector_, table_from_projector_, on_table_);
    }
}

void ArtifactShow::place_title(const exhibit::Presentation& presentation) {
    if (!presentation.title) {
        return;
    }
    const auto& [artifact, behaviour, language] = presentation.title->title;
    const residency::LoadedTexts* const texts =
        set_->artifact_cache->texts(artifact, residency::TextPart::Caption, language);
    const scene::TextureId texture =
        texts != nullptr
            ? texts->texture(residency::title_picture(catalogue()[artifact], language, behaviour))
            : scene::TextureId::None;
    if (texture != scene::TextureId::None) {
        on_table_.add({.corners_m = residency::picture_corners(residency::on_pixels(
                           presentation.title->rectangle, projector_, table_from_projector_)),
                       .brightness = caption_brightness_ * presentation.title->brightness,
                       .texture = texture});
    }
}

void ArtifactShow::place_state_titles(const exhibit::Presentation& presentation) {
    for (const exhibit::PresentedWindow& window : presentation.windows.windows()) {
        const residency::LoadedTexts* const texts =
            window.state && window.title.size_m.y > 0.0
                ? set_->artifact_cache->texts(window.artifact, residency::TextPart::Caption, window.language)
                : nullptr;
        const scene::TextureId texture =
            texts != nullptr ? texts->texture(residency::state_picture(catalogue()[window.artifact],
                                                                       window.language, *window.state))
                             : scene::TextureId::None;
        if (texture != scene::TextureId::None) {
            on_table_.add({.corners_m = residency::picture_corners(
                               residency::on_pixels(window.title, projector_, table_from_projector_)),
                           .brightness = caption_brightness_ * window.brightness,
                           .texture = texture});
        }
    }
}

void ArtifactShow::place_signs(const exhibit::Presentation& presentation) {
    if (presentation.sign) {
        const exhibit::PlacedSign& sign = *presentation.sign;
        on_table_.add({.corners_m = residency::flat_corners(sign.corners_m),
                       .brightness = caption_brightness_ * sign.brightness,
                       .texture = signs_.at(static_cast<std::size_t>(sign.sign))});
    }
    if (const std::optional<scene::TablePicture> advice = place_advice(presentation)) {
        on_table_.add(*advice);
    }
}

std::optional<scene::TablePicture>
ArtifactShow::place_caption(const exhibit::Presentation& presentation) const {
    if (!presentation.caption) {
        return std::nullopt;
    }
    const exhibit::PresentedCaption& caption = *presentation.caption;
    const residency::LoadedTexts* const texts = set_->artifact_cache->texts(
        presentation.artifact,
        caption.portion ? residency::TextPart::Narration : residency::TextPart::Caption, caption.language);
    const scene::TextureId texture =
        texts != nullptr
            ? texts->texture(residency::portion_picture(caption.portion.value_or(0), caption.shape))
            : scene::TextureId::None;
    if (texture == scene::TextureId::None) {
        return std::nullopt;
    }
    return scene::TablePicture{.corners_m = residency::picture_corners(residency::on_pixels(
                                   caption.rectangle, projector_, table_from_projector_)),
                               .brightness = caption_brightness_ * caption.brightness,
                               .texture = texture};
}

void ArtifactShow::place_site_map(const exhibit::Presentation& presentation) {
    const exhibit::SiteGround& site = catalogue()[presentation.artifact].site;
    if (!presentation.site_map || presentation.site_map->title.behaviour != exhibit::site_map_title ||
        !presentation.site.view || white_ == scene::TextureId::None) {
        return;
    }
    constexpr double ground_light = 0.12, shown_light = 0.8;
    const geometry::Box base = scene::box_around(prop_);
    const exhibit::SiteMap map =
        exhibit::site_map(site, *presentation.site.view, presentation.site_map->rectangle.centre_m,
                          presentation.table_from_prop, 0.5 * glm::dvec2(base.high - base.low));
    const double light = caption_brightness_ * presentation.site_map->brightness;
    const auto add = [&](const exhibit::SiteMap::Corners& corners, double brightness) {
        on_table_.add({.corners_m = residency::flat_corners({corners[3], corners[2], corners[1], corners[0]}),
                       .brightness = light * brightness,
                       .texture = white_});
    };
    add(map.ground, ground_light);
    add(map.shown, shown_light);
}

} // namespace frustumscreen::show
