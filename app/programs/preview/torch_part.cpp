#include "app/programs/preview/torch_part.h"

#include "app/image/film_frame.h"
#include "app/programs/preview/html_parts.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

constexpr float quality = 80.0F;

std::string sheet_of(const image::Image8& sheet, std::string_view kind, const std::string& alt) {
    return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"{}\">", kind, alt,
                       data_address("image/webp", image::encode_film_frame(sheet, quality)));
}

/// The part that the script moves with the pointer.
std::string thrown_of(const TorchPictures& torch, const std::string& name) {
    std::string html;
    if (!torch.lit.texels.empty()) {
        html += sheet_of(torch.lit, "lit", name + ": the same in the torch's light");
    }
    if (!torch.picture.texels.empty()) {
        html += sheet_of(torch.picture, "thrown", name + ": what the torch throws");
    }
    for (const torch::Stage& stage : torch.content.content.stages) {
        using enum torch::Source;
        if (stage.source == Plain || stage.source == Ring || stage.source == Grid || stage.source == Ruler) {
            html += fmt::format("<span class=\"thrown {}\"></span>",
                                stage.source == Plain
                                    ? "light"
                                    : torch::source_names.at(static_cast<std::size_t>(stage.source)));
        }
    }
    return html;
}

/// The magnification of its lens, for the script; empty: none.
std::string lens_of(const torch::Content& content) {
    const auto lens =
        std::find_if(content.stages.begin(), content.stages.end(),
                     [](const torch::Stage& stage) { return stage.source == torch::Source::Lens; });
    return lens == content.stages.end() ? std::string()
                                        : fmt::format(" data-lens=\"{:.3g}\"", lens->magnification);
}

std::string pictures_of(const TorchPictures& torch, const std::string& name) {
    const std::string plain = torch.plain.texels.empty()
                                  ? std::string()
                                  : sheet_of(torch.plain, "plain", "the artifact from four sides");
    return fmt::format("<div class=\"beam\"{}>{}{}</div>\n", lens_of(torch.content.content), plain,
                       thrown_of(torch, name));
}

std::string figure_of(const TorchPictures& torch) {
    const std::string name = xml_text(torch.content.content.name);
    std::string told;
    for (const pack::PackLabel& title : torch.content.titles) {
        told += fmt::format("<br>{0}: <span lang=\"{0}\" dir=\"auto\">{1}</span>", xml_text(title.language),
                            xml_text(title.text));
    }
    return fmt::format("<figure class=\"torch\">{}<figcaption><b>{}</b>: {}{}</figcaption></figure>\n",
                       pictures_of(torch, name), name, xml_text(torch.shows), told);
}

} // namespace

std::string torches_part(const std::vector<TorchPictures>& torches) {
    if (torches.empty()) {
        return {};
    }
    std::string figures;
    for (const TorchPictures& torch : torches) {
        figures += figure_of(torch);
    }
    return fmt::format(
        "<h2>What a torch shows</h2>\n<p class=\"soft\">The torch follows the pointer over the "
        "pictures; below them, what the visitor is told.</p>\n{}",
        figures);
}

std::string style_of(const std::vector<TorchPictures>& torches) {
    return torches.empty()
               ? std::string()
               : fmt::format(".scripted .beam {{ aspect-ratio: {} / {}; }}\n",
                             torches.front().frames * torches.front().size.x, torches.front().size.y);
}

} // namespace frustumscreen::programs
