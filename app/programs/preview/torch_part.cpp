#include "app/programs/preview/torch_part.h"

#include "app/programs/preview/html_parts.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

constexpr float quality = 80.0F;

std::string sheet_of(const image::Image8& sheet, std::string_view kind, const std::string& alt) {
    return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"{}\">", kind, alt,
                       data_address("image/webp", image::encode_lossy_webp(sheet, quality)));
}

std::string pictures_of(const TorchPictures& torch, const std::string& name) {
    std::string html;
    if (torch.frames > 0) {
        html += fmt::format("<div class=\"beam\">{}{}</div>\n",
                            sheet_of(torch.plain, "plain", "the artifact from four sides"),
                            sheet_of(torch.lit, "lit", name + ": the same in the torch's light"));
    }
    if (!torch.picture.texels.empty()) {
        html += fmt::format("<div class=\"thrown\">{}</div>\n",
                            sheet_of(torch.picture, "picture", name + ": what the torch throws"));
    }
    return html;
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
    const auto drawn = std::find_if(torches.begin(), torches.end(),
                                    [](const TorchPictures& torch) { return torch.frames > 0; });
    return drawn == torches.end() ? std::string()
                                  : fmt::format(".scripted .beam {{ aspect-ratio: {} / {}; }}\n",
                                                drawn->frames * drawn->size.x, drawn->size.y);
}

} // namespace frustumscreen::programs
