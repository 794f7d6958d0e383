#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"

#include <fmt/format.h>

#include <cmath>

namespace frustumscreen::pack {

namespace {

template <typename Texel> Result<void> check_size(const std::string& what, const image::Image<Texel>& image) {
    const std::int64_t texels = static_cast<std::int64_t>(image.width) * image.height;
    const bool sides = image.width > 0 && image.height > 0 && image.width <= max_side_texels &&
                       image.height <= max_side_texels;
    if (!sides || texels > max_texels || static_cast<std::size_t>(texels) != image.texels.size()) {
        return bad_input("pack.texture_size", "{} is {} x {} texels; allowed are 1 to {} a side, {} in all",
                         what, image.width, image.height, max_side_texels, max_texels);
    }
    return {};
}

Result<void> check_textures(const Pack& pack, Read read) {
    if (pack.textures.size() > max_textures) {
        return bad_input("pack.texture_count", "the pack has {} textures, allowed are {}",
                         pack.textures.size(), max_textures);
    }
    std::int64_t together = 0;
    for (std::size_t k = 0; k < pack.textures.size(); ++k) {
        if (read == Read::Chosen && pack.textures[k].texels.empty()) {
            continue;
        }
        TRY_VOID(check_size(fmt::format("texture {}", k), pack.textures[k]));
        together += static_cast<std::int64_t>(pack.textures[k].texels.size());
    }
    if (together > max_texels_together) {
        return bad_input("pack.textures_together", "the textures have {} texels in all, allowed are {}",
                         together, max_texels_together);
    }
    return {};
}

/// Every chart must lie inside the atlas, on texels that no other chart has.
Result<void> check_charts(const ReliefAtlas& atlas) {
    std::vector<bool> taken(atlas.relief.texels.size());
    for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
        const ReliefChart& chart = atlas.charts[k];
        if (chart.width == 0 || chart.height == 0 || chart.x + chart.width > atlas.relief.width ||
            chart.y + chart.height > atlas.relief.height) {
            return bad_input(
                "atlas.chart_outside", "chart {} is {} x {} texels at ({}, {}), outside the atlas of {} x {}",
                k, chart.width, chart.height, chart.x, chart.y, atlas.relief.width, atlas.relief.height);
        }
        if (chart.direction > ReliefDirection::MinusZ) {
            return bad_input("atlas.chart_direction", "chart {} has direction {}; allowed are 0 to 5", k,
                             static_cast<int>(chart.direction));
        }
        // A chart's rings may extend a little beyond the box.
        if (!(std::abs(chart.u0_box) <= 2.0F) || !(std::abs(chart.v0_box) <= 2.0F)) {
            return bad_input("atlas.chart_origin", "chart {} begins at ({}, {}), outside the box", k,
                             chart.u0_box, chart.v0_box);
        }
        for (int y = chart.y; y < chart.y + chart.height; ++y) {
            for (int x = chart.x; x < chart.x + chart.width; ++x) {
                const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.relief.width) +
                                static_cast<std::size_t>(x);
                if (taken[at]) {
                    return bad_input("atlas.charts_overlap", "chart {} overlaps another at texel ({}, {})", k,
                                     x, y);
                }
                taken[at] = true;
            }
        }
    }
    return {};
}

Result<void> check_relief(const ReliefAtlas& atlas) {
    if (atlas.relief.texels.empty() && atlas.charts.empty()) {
        return {};
    }
    TRY_VOID(check_size("the relief", atlas.relief));
    if (!(atlas.texel_box > 0.0F) || !(atlas.texel_box <= 1.0F)) {
        return bad_input("atlas.texel", "texel_box is {}; allowed are edges above 0 up to 1",
                         atlas.texel_box);
    }
    if (atlas.charts.empty() || atlas.charts.size() > max_charts) {
        return bad_input("atlas.chart_count", "the relief has {} charts, allowed are 1 to {}",
                         atlas.charts.size(), max_charts);
    }
    return check_charts(atlas);
}

} // namespace

Result<void> check_table_picture(const image::Image8& picture) {
    if (picture.texels.empty()) {
        return {};
    }
    TRY_VOID(check_size("the table's picture", picture));
    if (picture.width > max_table_picture_side || picture.height > max_table_picture_side) {
        return bad_input("pack.table_picture", "the table's picture is {} x {} texels; allowed are {} a side",
                         picture.width, picture.height, max_table_picture_side);
    }
    return {};
}

Result<void> check_pictures(const Pack& pack, Read read) {
    TRY_VOID(check_textures(pack, read));
    return check_relief(pack.relief).and_then([&] { return check_table_picture(pack.table_picture); });
}

} // namespace frustumscreen::pack
